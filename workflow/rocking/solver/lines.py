"""Even joints of blocks that stand on each other, in closed form, whatever of them is open.

A joint whose springs are spread evenly along a line has a penetration δ(s) = d₀ + d₁ s and a rate
q₀ + q₁ s. So it presses where both δ and δ + β δ̇ are above nothing, from one place to another, and

    N = k ∫ (δ + β δ̇) ds,   M = k ∫ s (δ + β δ̇) ds

follow from the two places: what nodes across the joint converge to, without their steps. Along the
joint it is `BINS` parts, shorter towards its ends. Each has a slip of its own, the mean of what is
pressed of it: what closes anew starts without any. With one slip for all a wall that rocks would
creep along its beds, since what opens last has borne longest.
"""

import math
from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import inlined

from .faces import act, answered, met, moving, resist
from .groups import law_of
from .law import bounded, rub
from .vectors import choose, every, like, lone, put, some, take

BINS = 8
ENDS = tuple(-math.cos(math.pi * k / BINS) for k in range(BINS + 1))  # of the parts, over half
MEMORY = BINS + 2  # rows a line
SIDE = 0.5 / math.sqrt(3.0)  # two springs there have the moments of an even line of length 1


class Lines(NamedTuple):
    """Beds between pieces and under the lowest, and their joints with what is behind them."""

    body_a: np.ndarray  # (lines,), int: the block above, see `stack.Stack`
    body_b: np.ndarray  # the one below
    support: np.ndarray
    origin_m: np.ndarray  # (lines, 2) the middle from the centroid of its block
    along: np.ndarray  # (lines, 2) turns with a
    normal: np.ndarray  # (lines, 2) from b into a; turns with b
    level_m: np.ndarray  # of the plane: normal·r of its points, r from the centroid of b
    half_m: np.ndarray  # (lines,) half the length
    k_n_m2: np.ndarray  # stiffness over length
    shear_ratio: np.ndarray
    beta_s: np.ndarray
    friction: np.ndarray


def lines_of(scene, even, number, column):
    """`Lines` of the joints that a scene calls even, and the mask of their nodes.

    Parameters
    ----------
    scene : Scene
    even : collection of str
        Names of the joints; a bonded one stays with its nodes.
    number : ndarray of int
        Of every block of the scene among those that are free; −1: a support.
    column : dict of str to int
        Of each motion.
    """
    nodes, blocks = scene.nodes, scene.blocks
    found: dict[str, list] = {name: [] for name in Lines._fields}
    taken = np.zeros(len(nodes), bool)
    for j, name in enumerate(scene.joints):
        at = np.flatnonzero(nodes.joint == j)
        if name not in even or not at.size or nodes.bonded[at].any():
            continue
        taken[at] = True
        kn, first, places = nodes.kn_n_m[at], at[0], nodes.position_m[at, 1:]
        low, high = places[np.lexsort(places.T)[[0, -1]]]
        length, middle = np.linalg.norm(high - low), 0.5 * (low + high)
        normal = nodes.normal[first, 1:]
        own, other = blocks[nodes.a[first]], blocks[nodes.b[first]]
        stands = number[nodes.b[first]] < 0
        from_b = 0.0 if stands else np.array(other.centre_m[1:])
        row = {
            "body_a": number[nodes.a[first]],
            "body_b": number[nodes.b[first]],
            "support": column.get(other.motion, -1) if stands else -1,
            "origin_m": middle - own.centre_m[1:],
            "along": (high - low) / length,
            "normal": normal,
            "level_m": normal @ (middle - from_b) - nodes.gap_m[first],
            "half_m": 0.5 * length,
            "k_n_m2": kn.sum() / length,
            **law_of(nodes, first),
        }
        for key, values in found.items():
            values.append(row[key])
    whole = ("body_a", "body_b", "support")
    columns = {key: np.array(v, np.int64 if key in whole else float) for key, v in found.items()}
    for key in ("origin_m", "along", "normal"):
        columns[key] = columns[key].reshape(-1, 2)
    return Lines(**columns), taken


def elements(lines, centre):
    """(line, place (y, z), stiffness) of two springs that are each line's, all of it closed."""
    for i, half in enumerate(lines.half_m):
        for side in (-2.0 * SIDE, 2.0 * SIDE):
            place = lines.origin_m[i] + side * half * lines.along[i] + centre[lines.body_a[i]]
            yield i, place, lines.k_n_m2[i] * half


@inlined
def _reach(f0, f1, low, high):
    """The part of a line from `low` to `high` where f0 + f1·s > 0; of nothing high <= low."""
    steep = abs(f1) > 0.0
    at = -f0 / choose(steep, f1, 1.0)
    rises, falls = f1 > 0.0, f1 < 0.0
    low = choose(rises, max(low, at), low)
    high = choose(falls, min(high, at), high)
    return low, choose(steep | (f0 > 0.0), high, low)


@inlined
def _rubbed(rows, first, half, reach, moves, law, acts, counts, spent):
    """Friction along a line, part by part.

    Parameters
    ----------
    rows, first
        The slip of each part from that row on.
    reach : tuple of 4 numbers
        From where to where it is pressed, now and at the last step.
    moves : tuple of 4 numbers
        Normal force over k along the line, h0 + h1·s; rate of slip, and slip of this step.
    law : tuple of 4 floats
        Stiffness over length, ks/kn, tan φ, β.
    acts : mask
        Where it is pressed at all.
    spent : number
        Energy taken so far [J]; what parts lose that open is added, of one history.

    Returns
    -------
    shear, stuck, grip, spent : number
        Force over k, length whose dashpot acts, Σ length·slip², and that energy.
    """
    (low, high, low_then, high_then), (h0, h1, speed, step) = reach, moves
    k, ratio, friction, beta = law
    shear = stuck = grip = like(0.0, h0)
    # pressed over all its length, now and at the last step: each part keeps its slip as it is
    throughout = (max(low, low_then) <= -half) & (min(high, high_then) >= half)
    even = not counts and every(throughout | ~acts)
    for part in range(BINS):
        at = first + part
        one, two = half * ENDS[part], half * ENDS[part + 1]
        had = take(rows, at)
        if even:
            start, stop = like(one, h0), like(two, h0)
            shut, share = acts, choose(acts, two - one, 0.0)
        else:
            start, stop = max(low, one), min(high, two)
            share = max(stop - start, 0.0)
            shut = share > 0.0
            before = max(min(high_then, two) - max(low_then, one), 0.0)
            if counts:
                spent += 0.5 * k * ratio * lone(before) * (lone(had) * lone(had))
            if not some(shut):
                put(rows, at, 0.0)
                continue
            had = had * (min(before, share) / choose(shut, share, 1.0))
        limit = max(h0 + h1 * (0.5 * (start + stop)), 0.0)
        spring, slip, _, sticks = rub(had + step, limit, ratio, friction, had)
        bound, within = bounded(spring + ratio * beta * speed, friction * limit)
        shear += share * choose(sticks, bound, spring)
        stuck += choose(sticks & within, share, 0.0)
        put(rows, at, choose(shut, slip, 0.0))
        grip += share * slip * slip
    return shear, stuck, grip, spent


@inlined
def press(p, parts, rows, back, time, alive, counts):
    """What the lines do to their blocks; energy stored, and taken in this step [J]; see `march`.

    `rows`: from where to where each was pressed at the last step, and the slip of each part.
    """
    _, past, dt = time
    lines = p.lines
    elastic = spent = like(0.0, take(parts.place, 0))
    for i in range(lines.half_m.size):
        ends, arms, direction, along, (d0, d1) = met(p, lines, i, parts, alive)
        turns, moves = moving(parts, ends, arms, direction, along, past)
        q0, q1, speed, _, step, _ = moves
        half, k, beta = lines.half_m[i], lines.k_n_m2[i], lines.beta_s[i]
        ratio, friction = lines.shear_ratio[i], lines.friction[i]
        h0, h1 = d0 + beta * q0, d1 + beta * q1
        shut = _reach(d0, d1, like(-half, d0), like(half, d0))
        low, high = _reach(h0, h1, *shut)
        length, first = max(high - low, 0.0), MEMORY * i
        was = take(rows, first), take(rows, first + 1)
        put(rows, first, low)
        put(rows, first + 1, high)
        acts = length > 0.0
        if not counts and not some(acts):
            for m in range(3):
                put(back, 3 * i + m, like(0.0, d0))
            continue
        middle, whole = 0.5 * (low + high), k * length
        mean = max(h0 + h1 * middle, 0.0)
        normal = whole * mean
        moment = whole * (mean * middle + h1 * (length * length / 12.0))
        law, reach = (k, ratio, friction, beta), (low, high, was[0], was[1])
        slides = h0, h1, speed, step
        shear, stuck, grip, spent = _rubbed(
            rows, first + 2, half, reach, slides, law, acts, counts, spent
        )
        shear = k * shear
        act(parts, ends, arms, direction, (normal, shear), turns[0] * moment)
        ahead, joint = p.late * beta + p.lead * dt, (ends, arms, direction, along)
        pressed = whole, whole * middle, whole * (middle * middle + length * length / 12.0)
        sticking = k * stuck, 0.0 * stuck, 0.0 * stuck
        resist(parts, joint, turns, (pressed, sticking), (ahead, ratio))
        if ends[0] < 0 or ends[1] < 0:
            answered(back, 3 * i, joint, turns, (pressed, sticking), (ahead, ratio))
        if counts:
            kept, held = _stored(k, (d0, d1), shut)
            gripped = 0.5 * k * ratio * grip
            elastic += kept + gripped
            spent += dt * ((normal - held[0]) * q0 + (moment - held[1]) * q1)
            spent += shear * step - gripped
    return elastic, spent


@inlined
def _stored(k, depths, shut):
    """Energy of the springs that are pressed [J], and the resultants of their penetration."""
    (d0, d1), (low, high) = depths, shut
    length, middle = max(high - low, 0.0), 0.5 * (low + high)
    at, second, stiff = d0 + d1 * middle, length * length / 12.0, k * length
    kept = 0.5 * stiff * (at * at + d1 * d1 * second)
    return kept, (stiff * at, stiff * (at * middle + d1 * second))
