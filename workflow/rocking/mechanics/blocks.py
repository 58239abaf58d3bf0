"""Rigid blocks that turn: a block about its toe, two blocks between held levels.

See `mechanism` for the virtual work. Forces in N, lengths in m, on the whole width of the façade;
y is outward, z upward.
"""

import cmath
import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from rocking.mechanics.closed_forms import GRAVITY_M_S2
from rocking.mechanics.mechanism import (
    Mechanism,
    Pull,
    Weight,
    cos_sin,
    spread_weight,
    turning,
)
from yade_scripts.model.facades import Facade
from yade_scripts.model.floors import lever_of


class Held(NamedTuple):
    """What holds a block horizontally at a height, rigid up to its capacity.

    It pulls from an outward displacement of its point, the slack, up to another, the reach; one
    that fades falls linearly to zero there.
    """

    force_n: float
    height_m: float
    reach_m: float
    fades: bool = False
    slack_m: float = 0.0


def thrusting(rows, move, y_m):
    """`Pull`s of static thrusts (force_n, height_m), horizontal, outward, on a vertical at y.

    They do not grow with the shaking: their work is on the side of what holds, with its sign.
    """
    return tuple(Pull(-force, move((y_m, z))) for force, z in rows if force)


def toppling(name, masses, hinge, top, loads=(), pulls=(), pushes=(), thrusts=()):
    """One rigid block that turns outward about a hinge (y, z); its control point is `top`.

    Masses and loads, what it carries, are (weight_n, y_m, z_m); pulls are `Held`; pushes (weight_n,
    height_m) are masses that push horizontally and do not bear on it; thrusts see `thrusting`.

    """

    def move(point):
        return turning(point, hinge)

    carried = [*masses, *loads]
    weights = [Weight(w, move((y, z))) for w, y, z in carried if w > 0.0]
    pushing = [Weight(w, _part(move((hinge[0], z)), 0)) for w, z in pushes if w > 0.0]
    pieces = ((hinge[1], top[1], move),)
    held = _pulls(pulls, move, hinge, top) + thrusting(thrusts, move, hinge[0])
    lumped = (*_lump(carried, move), *pushing)
    given = name, (*weights, *pushing), move(top), held
    return Mechanism(*given, pieces=pieces, lumped=lumped)


def leaned(mechanism, lean_rad):
    """One block of a wall that leans outward by an angle at rest: it has turned by it already.

    α(θ) is that of the upright wall at θ + lean, tan(θ₀ − lean − θ) of weights alone.
    """
    if not lean_rad:
        return mechanism

    def shifted(path):
        return lambda theta: path(theta + lean_rad)

    def on(rows):
        return tuple(row._replace(path=shifted(row.path)) for row in rows)

    pieces = tuple(
        (low, high, lambda point, move=move: shifted(move(point)))
        for low, high, move in mechanism.pieces
    )
    moved = {"pieces": pieces, "control": shifted(mechanism.control), "_rotations": {}}
    moved |= {key: on(getattr(mechanism, key)) for key in ("weights", "pulls", "lumped")}
    return replace(mechanism, **moved)


def _lump(masses, move):
    """Masses of one block, (weight_n, y_m, z_m), as one `Weight` at their centroid; () of none."""
    total = sum(w for w, *_ in masses)
    if not total > 0.0:
        return ()
    y, z = (sum(row[0] * row[k] for row in masses) / total for k in (1, 2))
    return (Weight(total, move((y, z))),)


def _pulls(rows, move, low, high):
    """`Pull`s of what holds between two points, on the vertical through the lower."""
    held = []
    for row in rows:
        force, height, reach, fades, slack = Held(*row)
        if not (force >= 0.0 and low[1] < height <= high[1] and reach > slack >= 0.0):
            raise ValueError(
                f"tie: expected a force of at least 0, a height from {low[1]:g} to {high[1]:g} m "
                f"and a reach beyond its slack, got {force:g} N, {height:g} m, {reach:g} m"
            )
        held.append(Pull(force, move((low[0], height)), reach, fades, slack))
    return tuple(held)


class Edges(NamedTuple):
    """Points (y, z) about which two blocks turn between levels that hold [m].

    The lower block turns outward about `base`, the upper one back about `joint`, the inner edge of
    the opening between them; `top`, where it is held, moves vertically only.
    """

    base: tuple
    joint: tuple
    top: tuple


def bending(name, lower, upper, edges, loads=(), held=(), pulls=(), thrusts=()):
    """Two blocks between held levels: vertical bending.

    What bears on their top lifts and does not move sideways. Masses of both blocks, loads that move
    with the block they stand on, and what is held and bears on the upper one are (weight_n, y_m,
    z_m); pulls are `Held`, thrusts as of `thrusting`.
    """
    base, joint, top = edges
    first = turning(joint, base)
    dy, dz = top[0] - joint[0], top[1] - joint[1]
    length, angle = math.hypot(dy, dz), math.atan2(dz, dy)

    def below(point):
        return turning(point, base)

    def above(point):
        ry, rz = point[0] - joint[0], point[1] - joint[1]

        def path(theta):
            y, z = first(theta)
            acos = np.arccos if isinstance(y, np.ndarray) else cmath.acos
            cos, sin = cos_sin(acos((top[0] - y) / length) - angle)  # the top stays in y
            return y + ry * cos - rz * sin, z + ry * sin + rz * cos

        return path

    def move(point):
        return (above if point[1] > joint[1] else below)(point)

    weights = [Weight(w, below((y, z))) for w, y, z in lower if w > 0.0]
    weights += [Weight(w, above((y, z))) for w, y, z in upper if w > 0.0]
    weights += [Weight(w, move((y, z))) for w, y, z in loads if w > 0.0]
    weights += [Weight(w, _part(above((y, z)), 1)) for w, y, z in held if w > 0.0]
    rise = joint[1] - base[1]
    largest = math.asin(min(0.95 * length / rise, 0.95))  # the joint stays within its reach
    pieces = ((base[1], joint[1], below), (joint[1], top[1], above))
    low, high = ([row for row in loads if (row[2] > joint[1]) is up] for up in (False, True))
    lumped = (*_lump([*lower, *low], below), *_lump([*upper, *high], above))
    lumped += _lump(held, lambda point: _part(above(point), 1))
    forces = _pulls(pulls, move, base, top) + thrusting(thrusts, move, base[0])
    return Mechanism(name, tuple(weights), first, forces, largest, pieces, lumped=lumped)


def _part(path, which):
    """Horizontal (0) or vertical (1) part of a path."""

    def only(theta):
        y, z = path(theta)
        return (y, 0.0 * z) if which == 0 else (0.0 * y, z)

    return only


def interlocking(height_m, bricks, unit_weight_n_m3):
    """Friction of `Interlocked` walls by the Circolare's C8.7.1.2, as one `Held`.

    F = 0.4 n(n + 1) Φ μ l² t_s W a wall, Φ = h_b/l, n = h/h_b, at a third of the height h above the
    hinge. The code does not say how it fades as the blocks slide off each other; here it falls
    linearly to zero as its point moves by the overlap l.
    """
    overlap = bricks.overlap_m
    n, phi = height_m / bricks.course_height_m, bricks.course_height_m / overlap
    force_n = 0.4 * n * (n + 1.0) * phi * bricks.friction * overlap**2 * bricks.return_thickness_m
    return Held(bricks.return_walls * force_n * unit_weight_n_m3, height_m / 3.0, overlap, True)


def weakest_hinge(section):
    """Height of the hinge with the least α0 of a plain façade whose top is held [m].

    It opens there and bends, see `bending`. The floors of section facade stand at its top, N in all
    at the mean arm s from the inner face; a held load does no work against the shaking. Small
    rotations, b₁ = b, W₁ = W h₁/h, W₂ = W h₂/h, r = h₁/h₂ (rotation of the upper block per lower
    one):

        α0 = [W₁ b/2 + (W₂ + N) b + r (W₂ b/2 + N s)]/[(W₁ + W₂) h₁/2]
    """
    facade = replace(Facade.of(section), hinges_m=(), courses=0)
    facade.refuse("the weakest hinge")
    h, b = facade.height_m, facade.thickness_m
    loads = [row.load_n for row in facade.floors]
    arms = [lever_of(row, b) for row in facade.floors]
    total = sum(loads)
    arm = sum(p * s for p, s in zip(loads, arms, strict=True)) / total if total else 0.0
    weight = facade.density_kg_m3 * GRAVITY_M_S2 * h * b * facade.width_m
    per_metre = weight / h

    def multiplier(z):
        lower = [(p, 0.5 * b, at) for p, at in spread_weight(per_metre * z, 0.0, z)]
        upper = [(p, 0.5 * b, at) for p, at in spread_weight(per_metre * (h - z), z, h)]
        edges = Edges((b, 0.0), (0.0, z), (b, h))
        return bending("vertical bending", lower, upper, edges, held=[(total, arm, h)]).multiplier()

    hinge = minimize_scalar(multiplier, bounds=(0.02 * h, 0.98 * h), method="bounded")
    return float(hinge.x)
