"""Even joints of blocks that stand on each other, in closed form, whatever of them is open.

A joint whose springs are spread evenly along a line has a penetration δ(s) = d₀ + d₁ s and a rate
q₀ + q₁ s. So it presses where both δ and δ + β δ̇ are above nothing, from one place to another, and

    N = k ∫ (δ + β δ̇) ds,   M = k ∫ s (δ + β δ̇) ds

follow from the two places: what nodes across the joint converge to, without their steps. Along the
joint it is parts, shorter towards its ends, each with a spring that slides at μN and no dashpot
(YADE's law would not bound one by friction). Each has a slip of its own, the mean of what is
pressed of it: what closes anew starts without any. With one slip for all a wall that rocks would
creep along its beds, since what opens last has borne longest; with eight parts a bed that rocks on
its last hundredth is still 1.4 % off.
"""

import math
from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import inlined

from .faces import act, met, moving, withstand, withstand_slip
from .groups import law_of
from .rubbing import COUNTED, DEPTH, HIGH, LOW, MEMORY, PARTS, SOME, WHOLE, rubbed
from .vectors import choose, every, like, minus, plus, put, some, take

SIDE = 0.5 / math.sqrt(3.0)  # two springs there have the moments of an even line of length 1
TWELFTH = 1.0 / 12.0  # a division is dear
SURE = 1.0 + 1e-9  # times what a line's end adds: all of it is open or shut, whatever rounding does


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
    edge_m: np.ndarray  # (lines, parts + 1) ends of the parts of friction from the middle
    second_m3: np.ndarray  # (lines, groups) of each `rubbing.SOME` parts Σ length·place²


def in_parts(lines, parts):
    """`Lines` with friction told in so many parts, a multiple of `rubbing.SOME` up to `PARTS`.

    Their ends are half way between those of one length, which are too long at the ends of the line,
    and those of a cosine, too long in its middle.
    """
    even = np.linspace(-1.0, 1.0, parts + 1)
    edges = 0.5 * (even + np.sin(0.5 * math.pi * even))
    return lines._replace(**friction_parts(lines.half_m[:, None] * edges))


def friction_parts(edge_m):
    """Fields of `Lines` by the ends of the parts of friction, shape (lines, parts + 1)."""
    length, middle = np.diff(edge_m), 0.5 * (edge_m[:, :-1] + edge_m[:, 1:])
    groups = (length * middle**2).reshape(len(edge_m), length.shape[1] // SOME, SOME)
    return {"edge_m": edge_m, "second_m3": groups.sum(axis=2)}


def lines_of(scene, even, number, column):
    """`Lines` of the joints that a scene calls even, and the mask of their nodes.

    Parameters
    ----------
    scene : Scene
    even : collection of str
        Names of the joints; one that is bonded, or has dashpots along it, stays with its nodes.
    number : ndarray of int
        Of every block of the scene among those that are free; −1: a support.
    column : dict of str to int
        Of each motion.
    """
    nodes, blocks = scene.nodes, scene.blocks
    by_field: dict[str, list] = {name: [] for name in Lines._fields}
    taken = np.zeros(len(nodes), bool)
    for j, name in enumerate(scene.joints):
        at = np.flatnonzero(nodes.joint == j)
        alike = at.size and not (nodes.bonded[at].any() or nodes.drag[at].any())
        if name not in even or not alike:
            continue
        taken[at] = True
        kn, first, places = nodes.kn_n_m[at], at[0], nodes.position_m[at, 1:]
        ends = np.lexsort(places.T)[[0, -1]]
        (low, high), gap_m = places[ends], nodes.gap_m[at[ends]]
        length, middle = np.linalg.norm(high - low), 0.5 * (low + high)
        normal = nodes.normal[first, 1:]
        block, other = blocks[nodes.a[first]], blocks[nodes.b[first]]
        stands = number[nodes.b[first]] < 0
        from_b = 0.0 if stands else np.array(other.centre_m[1:])
        row = {
            "body_a": number[nodes.a[first]],
            "body_b": number[nodes.b[first]],
            "support": column.get(other.motion, -1) if stands else -1,
            "origin_m": middle - block.centre_m[1:],
            "along": (high - low) / length,
            "normal": normal,
            "level_m": normal @ (middle - from_b) - 0.5 * gap_m.sum(),
            "half_m": 0.5 * length,
            "k_n_m2": kn.sum() / length,
            **law_of(nodes, first),
            "edge_m": (),  # `in_parts` has them
            "second_m3": (),
        }
        for key, values in by_field.items():
            values.append(row[key])
    whole = ("body_a", "body_b", "support")
    columns = {key: np.array(v, np.int64 if key in whole else float) for key, v in by_field.items()}
    for key in ("origin_m", "along", "normal"):
        columns[key] = columns[key].reshape(-1, 2)
    return in_parts(Lines(**columns), PARTS), taken


def elements(lines, centre):
    """(line, place (y, z), stiffness) of two springs that are each line's, all of it closed."""
    for i, half in enumerate(lines.half_m):
        for side in (-2.0 * SIDE, 2.0 * SIDE):
            place = lines.origin_m[i] + side * half * lines.along[i] + centre[lines.body_a[i]]
            yield i, place, lines.k_n_m2[i] * half


@inlined
def _reach(f0, f1, low, high):
    """The part of a line from `low` to `high` where f0 + f1·s > 0; of nothing high <= low."""
    if every(abs(f0) > SURE * abs(f1) * max(high, -low)):  # a division is dear
        return low, choose(f0 > 0.0, high, low)
    steep = abs(f1) > 0.0
    at = -f0 / choose(steep, f1, 1.0)
    rises, falls = f1 > 0.0, f1 < 0.0
    low = choose(rises, max(low, at), low)
    high = choose(falls, min(high, at), high)
    return low, choose(steep | (f0 > 0.0), high, low)


@inlined
def _closing(depths, before, shut, press, half):
    """What a line presses beyond the force now, whose end has closed within this step; over k.

    A force stands for half a step on either side of now. What closed a share of the step ago has
    pressed for that share and the half that follows, so it counts 1/2 + share. Along what rolls
    shut the shares have a mean of one half; an end that shuts cuts them off.

    Parameters
    ----------
    depths, before : tuple of 2 numbers
        Penetration along the line, now and at the last step, as a0 + a1·s.
    shut : tuple of 2 numbers
        From where to where it touches now.
    press : tuple of 2 numbers
        Normal force over k along the line.
    half : float
        Half its length.

    Returns
    -------
    normal, moment : number
    """
    (d0, d1), (p0, p1), (h0, h1) = depths, before, press
    lower = (d0 - d1 * half > 0.0) & ~(p0 - p1 * half > 0.0)
    upper = (d0 + d1 * half > 0.0) & ~(p0 + p1 * half > 0.0)
    ends = lower | upper
    none = like(0.0, d0)
    if not some(ends):
        return none, none
    was = _reach(p0, p1, like(-half, d0), like(half, d0))
    open_before = ~(was[1] > was[0])
    low = choose(lower, -half, max(shut[0], choose(open_before, -half, was[1])))
    high = choose(lower, min(shut[1], choose(open_before, half, was[0])), half)
    at_low, at_high = d0 + d1 * low, d0 + d1 * high
    gain_low, gain_high = at_low - (p0 + p1 * low), at_high - (p0 + p1 * high)
    more_low = choose(gain_low > 0.0, at_low / choose(gain_low > 0.0, gain_low, 1.0), 0.5) - 0.5
    more_high = choose(gain_high > 0.0, at_high / choose(gain_high > 0.0, gain_high, 1.0), 0.5)
    more_high = more_high - 0.5
    of_low, of_high = max(h0 + h1 * low, 0.0), max(h0 + h1 * high, 0.0)
    length = choose(ends, max(high - low, 0.0), 0.0)
    low_part, both, high_part = (
        more_low * of_low,
        more_low * of_high + more_high * of_low,
        more_high * of_high,
    )
    normal = length * (2.0 * low_part + both + 2.0 * high_part) / 6.0
    first = length * length * (low_part + both + 3.0 * high_part) / 12.0
    return normal, low * normal + first


@inlined
def _open(rows, first, reach, depths, back, row):
    """What a line remembers of a step in which it does not press."""
    for m, value in enumerate((*reach, *depths)):
        put(rows, first + m, value)
    put(rows, first + WHOLE, like(0.0, depths[0]))
    for m in range(3):
        put(back, row + m, like(0.0, depths[0]))


@inlined
def press(p, parts, rows, back, time, alive, counts):
    """What the lines do to their blocks; energy stored, and taken by friction [J]; see `march`.

    `rows`: `MEMORY` of them a line. `back` gets three a line, see `faces.withstand`.
    """
    _, past, dt = time
    lines = p.lines
    elastic = spent = like(0.0, take(parts.place, 0))
    for i in range(lines.half_m.size):
        ends, arms, direction, along, (d0, d1) = met(p, lines, i, parts, alive)
        half, k, beta, first = lines.half_m[i], lines.k_n_m2[i], lines.beta_s[i], MEMORY * i
        ratio, friction = lines.shear_ratio[i], lines.friction[i]
        shut = _reach(d0, d1, like(-half, d0), like(half, d0))
        if not counts and not some(shut[1] > shut[0]):
            _open(rows, first, shut, (d0, d1), back, 3 * i)
            continue
        turns, (q0, q1, _, _, g0, g1) = moving(parts, ends, arms, direction, along, past)
        h0, h1 = plus(d0, beta, q0), plus(d1, beta, q1)
        low, high = _reach(h0, h1, *shut)
        length = max(high - low, 0.0)
        was = take(rows, first + LOW), take(rows, first + HIGH)
        before = take(rows, first + DEPTH), take(rows, first + DEPTH + 1)
        if past == 0.0:  # what touches at first has not just closed
            before = d0, d1
        acts = length > 0.0
        if not counts and not some(acts):
            _open(rows, first, (low, high), (d0, d1), back, 3 * i)
            continue
        for m, value in enumerate((low, high, d0, d1)):
            put(rows, first + m, value)
        middle, second = 0.5 * (low + high), TWELFTH * (length * length)
        mean = max(plus(h0, h1, middle), 0.0)
        normal = length * mean
        moment = length * plus(mean * middle, h1, second)
        law, reach = (ratio, friction, p.lead > 0.0), (low, high, was[0], was[1])
        moves = (h0, h1), (g0, g1), (d0, d1), before
        shear, turned, stuck, grip, loss = rubbed(
            lines, i, rows, first, reach, moves, law, acts, counts
        )
        more, more_moment = _closing((d0, d1), before, shut, (h0, h1), half)
        whole = normal + more
        counted = like(1.0, d0)
        if some(abs(more) > 0.0):
            counted = choose(normal > 0.0, whole / choose(normal > 0.0, normal, 1.0), counted)
        force = k * whole, k * counted * shear
        couple = k * minus(turns[0] * (moment + more_moment), turns[1], counted * turned)
        act(parts, ends, arms, direction, force, couple)
        dashpot = (p.late * beta + p.lead * dt) * k * counted * length
        sums = dashpot, dashpot * middle, dashpot * plus(second, middle, middle)
        withstand(parts, ends, arms, direction, turns[0], sums, back, 3 * i)
        if p.lead > 0.0:
            spring, (ny, nz) = p.lead * dt * k * ratio * stuck, direction
            withstand_slip(parts, ends, arms, (-nz, ny), spring, back, 3 * i)
        if counts:
            put(rows, first + COUNTED, counted)
            elastic += _stored(k, (d0, d1), shut)[0] + 0.5 * k * ratio * grip
            spent += k * loss
    return elastic, spent


@inlined
def taken(p, parts, rows):
    """Power [W] that the dashpots of the lines take at the rates `parts.now`; of one history.

    What is shut but no longer presses, since it opens fast, gives its springs' energy to them.
    """
    lines, total = p.lines, 0.0
    for i in range(lines.half_m.size):
        ends, arms, direction, along, depths = met(p, lines, i, parts, True)
        _, (q0, q1, _, _, _, _) = moving(parts, ends, arms, direction, along, 0.0)
        half, k, beta, first = lines.half_m[i], lines.k_n_m2[i], lines.beta_s[i], MEMORY * i
        shut = _reach(*depths, -half, half)
        pressed = take(rows, first + LOW), take(rows, first + HIGH)
        _, (force, moment) = _stored(k, depths, pressed)
        _, (held, turned) = _stored(k, depths, shut)
        dashpots, _ = _stored(k, (q0, q1), pressed)
        total += 2.0 * beta * take(rows, first + COUNTED) * dashpots
        total += (force - held) * q0 + (moment - turned) * q1
    return total


@inlined
def _stored(k, depths, shut):
    """Energy of the springs that are pressed [J], and the resultants of their penetration."""
    (d0, d1), (low, high) = depths, shut
    length, middle = max(high - low, 0.0), 0.5 * (low + high)
    at, second, stiff = d0 + d1 * middle, length * length / 12.0, k * length
    kept = 0.5 * stiff * (at * at + d1 * d1 * second)
    return kept, (stiff * at, stiff * (at * middle + d1 * second))
