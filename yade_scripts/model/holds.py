"""What holds a façade back: its ties, and the anchors and friction of its floors.

One description, which hand calculation and both dynamic models read. A hold pulls inward with k on
what its point has moved past its slack, at most with its capacity, and is lost at its reach.

    tie       a row of rods, see `Rods.rod`; its reach is slack + elongation
    anchor    of a floor: F_a (`anchor_kn`), lost at `anchor_reach_m`
    friction  of a floor under its load: μ P, without an end

Friction and the anchors of a floor with a mass of its own hold the façade to that mass, one behind
the other with its spring m (2π/T)², and slide without an end: what the mass does says how far they
follow. They share the stiffness of the two springs by their capacities.
"""

import math
from typing import NamedTuple

from yade_scripts.model.facades import Facade

TIE, ANCHOR, FRICTION = "tie", "anchor", "friction"


class Hold(NamedTuple):
    """One thing that holds a façade back at a height above its base.

    Its point moves by `slack_m` outward from the upright before it pulls (less than nothing: it
    pulls from the start), and loses it at `reach_m`
    from the upright, slack included; inf: never.
    """

    kind: str
    height_m: float
    stiffness_n_m: float
    capacity_n: float
    slack_m: float
    reach_m: float


def of_tie(row):
    """`Hold` of a `Rods`.

    A pretension N (`pretension_kn`, of one rod) is a slack of −N/k: the rod pulls N from the start.
    """
    stiffness, capacity, elongation = row.rod
    slack = 1e-3 * row.slack_mm - 1e3 * row.count * row.pretension_kn / stiffness
    return Hold(TIE, row.height_m, stiffness, capacity, slack, slack + elongation)


def of_floor(row):
    """What holds at a `FloorRow`: friction, anchors, if they hold at all.

    No anchor is lost before it pulls F_a.
    """
    capacities = 1e3 * row.friction * row.load_kn, 1e3 * row.anchor_kn
    stiffness, mass = 1e3 * row.stiffness_kn_m, 1e3 * row.mass_t
    reach, shares = max(row.anchor_reach_m, capacities[1] / stiffness), (1.0, 1.0)
    if mass:
        spring = mass * (2.0 * math.pi / row.period_s) ** 2
        stiffness = stiffness * spring / (stiffness + spring)
        reach = math.inf
        shares = tuple(force / (sum(capacities) or 1.0) for force in capacities)
    kinds = zip((FRICTION, ANCHOR), capacities, shares, (math.inf, reach), strict=True)
    return [
        Hold(kind, row.height_m, share * stiffness, force, 0.0, end)
        for kind, force, share, end in kinds
        if force > 0.0
    ]


def holds(facade):
    """All that holds a façade back: its ties, then its floors, row by row."""
    facade = Facade.of(facade)
    ties = [of_tie(row) for row in facade.ties]
    return ties + [hold for row in facade.floors for hold in of_floor(row)]
