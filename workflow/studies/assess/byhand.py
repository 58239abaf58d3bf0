"""One mechanism as a reader with a pocket calculator checks it: parts, holds, sums, results.

Every part is a band of masonry between two heights at which the façade changes, or a load. With δ
the virtual displacement of its centroid at a unit rotation of the lowest block, outward δ_x and
upward δ_z, κ = dδ_x/dz of the block it is on and r² the mean square of its masses' height about
their centroid (a²/12 of a rectangle a high), a part's mean square of δ_x is δ_x² + κ² r².
"""

import itertools
import math
from typing import NamedTuple

from rocking.mechanics.closed_forms import GRAVITY_M_S2
from rocking.mechanics.mechanism import rate
from rocking.records import G_M_S2

from studies.assess import checks, repertory
from studies.assess.family import NEAR_M


class Part(NamedTuple):
    """A band of masonry or a load: weight, centroid, virtual displacements of the whole of it.

    Its name is a key of `hand.part` in the catalogue, with the values that it names.
    """

    key: str
    about: dict
    weight_n: float
    y_m: float
    z_m: float
    out: float
    up: float
    square: float


class Pulled(NamedTuple):
    """A hold that a mechanism passes: force, height, reach, virtual displacement of its point.

    Its name is a key of `hand.hold` in the catalogue.
    """

    key: str
    force_n: float
    height_m: float
    slack_m: float
    reach_m: float
    out: float


class Sums(NamedTuple):
    """Σ P, Σ P δ_x, Σ P δ_z, Σ P δ_x² and Σ F δ_x; Σ P of what moves sideways alone beside."""

    weight_n: float
    out_n: float
    up_n: float
    square_n: float
    pull_n: float
    moving_n: float


def bands(masonry, low_m, high_m):
    """Bands of masonry between two heights: (low, high, [(weight_n, y_m, z_m)])."""
    cuts = [low_m, *(z for z in masonry.edges_m if low_m + NEAR_M < z < high_m - NEAR_M), high_m]
    rows = [(a, b, masonry.masses(a, b)) for a, b in itertools.pairwise(cuts)]
    return [row for row in rows if row[2]]


def _band(masonry, low_m, high_m, masses, move, held):
    """`Part` of one band; what is held moves up alone."""
    weight = sum(w for w, *_ in masses)
    rates = [(w, *rate(move((y, z)), 0.0)) for w, y, z in masses]
    out = 0.0 if held else sum(w * x for w, x, _ in rates) / weight
    up = sum(w * v for w, _, v in rates) / weight
    square = 0.0 if held else sum(w * x**2 for w, x, _ in rates) / weight
    middle = 0.5 * (low_m + high_m)
    back, front = masonry.faces(middle)
    key, about = "band", {"low_m": low_m, "high_m": high_m, "thick_m": front - back}
    if masonry.gable_m > NEAR_M and low_m >= masonry.top_m - masonry.gable_m - NEAR_M:
        key = "gable"
    else:
        about["width_m"] = masonry.width(middle)
    y = sum(w * y for w, y, _ in masses) / weight
    z = sum(w * z for w, _, z in masses) / weight
    return Part(key, about, weight, y, z, out, up, square)


def parts(family, candidate):
    """Every `Part` of a plane mechanism, from below."""
    of_masonry, masonry = [], family.masonry
    pieces = family.pieces(candidate)
    for low, high, move in pieces:
        rows = bands(masonry, low, high)
        of_masonry += [_band(masonry, a, b, masses, move, False) for a, b, masses in rows]
    top, move = pieces[-1][1], pieces[-1][2]
    if candidate.held_m is not None and top < masonry.top_m - NEAR_M:
        rows = bands(masonry, top, masonry.top_m)
        of_masonry += [_band(masonry, a, b, masses, move, True) for a, b, masses in rows]
    if candidate.crack_deg:
        of_masonry.append(
            _wedges(repertory.wedge_masses(family, candidate.foot_m, candidate.crack_deg), move)
        )
    return of_masonry + _loads(family, candidate)


def _wedges(masses, move):
    """`Part` of the return walls' wedges, all together."""
    weight = sum(w for w, *_ in masses)
    y, z = (sum(row[0] * row[k] for row in masses) / weight for k in (1, 2))
    rates = [(w, *rate(move((y, z)), 0.0)) for w, y, z in masses]
    out, up, square = (
        sum(w * value for w, value in rows) / weight
        for rows in zip(*(((w, x), (w, v), (w, x**2)) for w, x, v in rates), strict=True)
    )
    return Part("wedges", {}, weight, y, z, out, up, square)


def _loads(family, candidate):
    """Loads of floors and roof, and what pushes without bearing."""
    loads, foot, held = [], candidate.foot_m, candidate.held_m
    pieces = family.pieces(candidate)
    for weight, y, z in family.loads:
        if z < foot + (NEAR_M if foot else 0.0) or not weight:
            continue
        fixed = held is not None and z >= held - NEAR_M
        move = next((m for _, high, m in pieces if z <= high + NEAR_M), pieces[-1][2])
        out, up = rate(move((y, z)), 0.0)
        out = 0.0 if fixed else out
        loads.append(Part("load", {"height_m": z}, weight, y, z, out, up, out**2))
    last = pieces[-1][2]
    if held is None:
        for weight, z in family.pushes:
            if weight and z > foot + NEAR_M:
                out, _ = rate(last((last((0.0, z))(0.0)[0].real, z)), 0.0)
                about = {"height_m": z}
                loads.append(Part("pushes", about, weight, math.nan, z, out, 0.0, out**2))
    return loads


def pulled(candidate):
    """Holds that a mechanism passes, from below."""
    holds = []
    for pull in candidate.mechanism.pulls:
        height = pull.path(0.0)[1].real
        key = "courses" if pull.fades else "tie" if pull.force_n > 0.0 else "thrust"
        out = rate(pull.path, 0.0)[0]
        holds.append(Pulled(key, pull.force_n, height, pull.slack_m, pull.reach_m, out))
    return sorted(holds, key=lambda row: row.height_m)


def sums(rows, holds):
    """`Sums` of parts and holds at rest; what pulls from a slack on does not at rest."""
    return Sums(
        sum(p.weight_n for p in rows),
        sum(p.weight_n * p.out for p in rows),
        sum(p.weight_n * p.up for p in rows),
        sum(p.weight_n * p.square for p in rows),
        sum(h.force_n * h.out for h in holds if not h.slack_m),
        sum(p.weight_n for p in rows if abs(p.out) > 1e-12),
    )


def turned(candidate, share):
    """Rotation and control displacement at a share of d0, and Σ P δ_x, Σ P δ_z, Σ F δ_x there.

    A link's failure before that share goes first.
    """
    mechanism = candidate.mechanism
    control = mechanism.limit(share)[0]
    theta = mechanism.rotation(control)
    out = sum(p * rate(path, theta)[0] for p, path in mechanism.weights)
    up = sum(p * rate(path, theta)[1] for p, path in mechanism.weights)
    return theta, control, out, up, mechanism.multiplier(theta) * out - up


def results(candidate, total, confidence_factor):
    """Rows (symbol, key of how, value, unit) of a mechanism's capacity, from its sums and FC."""
    g = GRAVITY_M_S2
    alpha = (total.up_n + total.pull_n) / total.out_n
    mass = total.out_n**2 / (g * total.square_n)
    share = g * mass / total.moving_n
    mechanism = candidate.mechanism
    theta0, d0 = mechanism.ultimate()
    theta, control, out, up, pull = turned(candidate, checks.LIMITS["SLV"][0])
    per = mechanism.participation()[2]
    why = "dc_share" if abs(control - 0.4 * d0) < 1e-9 else "dc_link"
    at = (up + pull) / out
    acceleration = at * G_M_S2 / (share * confidence_factor)
    return [
        ("α0", "alpha", alpha, ""),
        ("M*", "mass", mass, "kg"),
        ("e*", "e_star", share, ""),
        ("θ0", "theta0", theta0, "rad"),
        ("d0", "d0" if candidate.held_m is None else "d0_joint", d0, "m"),
        ("dC", why, control, "m"),
        ("θ", "theta", theta, "rad"),
        ("α(dC)", "alpha_dc", at, ""),
        ("d*/dC", "per", per, ""),
        ("d_SLV", "slv", control * per, "m"),
        ("a", "a", acceleration, "m/s²"),
    ]
