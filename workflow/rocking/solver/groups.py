"""Groups of nodes: which go together, what they remember, and the closed form of a group.

A group that touches with all its nodes, none sliding, is summed: each resultant follows from
Σ kn·(1, s, s²), and its slips from one line that is added to those that were stored.
"""

import itertools
from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import inlined

from .vectors import alone, choose, like, lone, put, put_where, some, take

LEVEL_M = 1e-9  # nodes of one group lie this close to one line, their planes to one plane


class Touch(NamedTuple):
    """What nodes remember, in rows: one a group, of the last two one a node."""

    summed: np.ndarray  # 1 in closed form: slips are then the stored ones + more0 + more1·s
    bonds: np.ndarray  # that are left
    most: np.ndarray  # largest stored slip of a summed group
    more0: np.ndarray
    more1: np.ndarray
    sum0: np.ndarray  # Σ kn·slip of a summed group
    sum1: np.ndarray  # Σ kn·slip·s
    sum2: np.ndarray  # Σ kn·slip²
    depth0: np.ndarray  # penetration at the last step, depth0 + depth1·s
    depth1: np.ndarray
    slip: np.ndarray  # since a node closed [m]
    intact: np.ndarray  # 1 where its bond holds; without rows where none is bonded


def grouped(nodes, centre):
    """Node numbers by group: whole joints where they are straight and uniform, else single."""
    groups = []
    for joint in np.unique(nodes.joint):
        mine = np.flatnonzero(nodes.joint == joint)
        place, line = line_of(nodes, centre, mine)
        level = np.einsum("ni,ni->n", nodes.normal[mine], nodes.position_m[mine])
        level = level - nodes.gap_m[mine]
        straight = np.abs(place[:, None] * line[1] + line[0] - _points(nodes, centre, mine))
        laws = (nodes.beta_s, nodes.friction_rad, nodes.ks_n_m / nodes.kn_n_m, nodes.a, nodes.b)
        alike = all(np.ptp(law[mine]) <= 1e-12 * np.abs(law[mine]).max() for law in laws)
        one_normal = np.ptp(nodes.normal[mine], axis=0).max() < 1e-12
        if alike and one_normal and straight.max() < LEVEL_M and np.ptp(level) < LEVEL_M:
            groups.append(mine[np.argsort(place, kind="stable")])
        else:
            groups.extend(mine[:, None])
    return groups


def _points(nodes, centre, mine):
    return nodes.position_m[mine, 1:] - centre


def line_of(nodes, centre, mine):
    """Place of nodes along the line through the first and the farthest, its origin, direction."""
    points = _points(nodes, centre, mine)
    far = points[np.argmax(np.linalg.norm(points - points[0], axis=1))] - points[0]
    length = np.linalg.norm(far)
    direction = far / length if length > 0.0 else np.array([1.0, 0.0])
    return (points - points[0]) @ direction, (points[0], direction)


def law_of(nodes, i):
    """ks/kn, β [s] and tan φ of a node, and so of the joint that it is of, by their names."""
    return {
        "shear_ratio": nodes.ks_n_m[i] / nodes.kn_n_m[i],
        "beta_s": nodes.beta_s[i],
        "friction": np.tan(nodes.friction_rad[i]),
    }


def untouched(p):
    """Rows of nodes that have not met their planes yet, and what stays of their groups.

    The latter has a row a group: Σ kn·(1, s, s²) of all its nodes, and its largest |s|.
    """
    first, k, s = p.first[:-1], p.kn_n_m, p.place_m
    left = np.add.reduceat(p.bonded, first, dtype=float)
    rows = np.zeros(10 * first.size)
    rows[first.size : 2 * first.size] = left
    nodes = np.zeros(s.size), p.bonded[: s.size * p.bonded.any()]
    ends = itertools.pairwise(p.first)
    sums = [[np.cumsum(row[a:b])[-1] for row in (k, k * s, k * s * s)] for a, b in ends]
    return np.concatenate((rows, *nodes)), np.c_[sums, np.maximum.reduceat(abs(s), first)]


@inlined
def touched(p, rows):
    """`Touch` in the rows of `untouched`."""
    g, n = p.level_m.size, p.place_m.size
    nodes = rows[10 * g :]
    return Touch(
        *(rows[:g], rows[g : 2 * g], rows[2 * g : 3 * g], rows[3 * g : 4 * g]),
        *(rows[4 * g : 5 * g], rows[5 * g : 6 * g], rows[6 * g : 7 * g], rows[7 * g : 8 * g]),
        *(rows[8 * g : 9 * g], rows[9 * g : 10 * g]),
        *(nodes[:n], nodes[n:]),
    )


@inlined
def let_go(p, touch, g, before, now):
    """What nodes that touched at the last step, and do not now, have lost [J]; of one history.

    `before`, `now`: penetrations along the line, as a0 + a1·s.
    """
    low, high, lost = p.first[g], p.first[g + 1], 0.0
    ends = p.place_m[low], p.place_m[high - 1]
    if max(before[0] + before[1] * ends[0], before[0] + before[1] * ends[1]) <= 0.0:
        return lost  # none touched
    for i in range(low, high):
        s = p.place_m[i]
        opens = before[0] + before[1] * s > 0.0 and now[0] + now[1] * s <= 0.0
        if opens and (len(touch.intact) == 0 or lone(take(touch.intact, i)) <= 0.0):
            lost += 0.5 * p.kn_n_m[i] * p.shear_ratio[g] * lone(take(touch.slip, i)) ** 2
    return lost


@inlined
def spread(p, touch, g, mask):
    """Give the nodes of a summed group their slips back."""
    put_where(touch.summed, g, mask, 0.0)
    more0, more1 = take(touch.more0, g), take(touch.more1, g)
    for i in range(p.first[g], p.first[g + 1]):
        slip = take(touch.slip, i)
        put(touch.slip, i, choose(mask, slip + (more0 + more1 * p.place_m[i]), slip))


@inlined
def close(p, touch, g, mask, most):
    """Bring a group into closed form where all its slips are less than `most`."""
    low, high = p.first[g], p.first[g + 1]
    top = none = like(0.0, most)
    for i in range(low, high):
        top = max(top, abs(take(touch.slip, i)))
    mask = mask & (top < most)
    if not some(mask):
        return
    sum0 = sum1 = sum2 = none
    for i in range(low, high):
        slip = take(touch.slip, i)
        stored = p.kn_n_m[i] * slip
        sum0 += stored
        sum1 += stored * p.place_m[i]
        sum2 += stored * slip
    put_where(touch.summed, g, mask, 1.0)
    put_where(touch.most, g, mask, top)
    put_where(touch.more0, g, mask, none)
    put_where(touch.more1, g, mask, none)
    put_where(touch.sum0, g, mask, sum0)
    put_where(touch.sum1, g, mask, sum1)
    if alone(most):
        put(touch.sum2, g, sum2)


@inlined
def in_closed_form(p, touch, g, mask, whole, lines, dt, counts):
    """Resultants of summed groups, as of nodes one by one; nothing where the mask is not true."""
    d0, d1, q0, q1, s0, s1, g0, g1 = lines
    beta, ratio = p.beta_s[g], p.shear_ratio[g]
    k0, k1, k2 = whole[g, 0], whole[g, 1], whole[g, 2]
    had0, had1 = take(touch.sum0, g), take(touch.sum1, g)
    sum0, sum1 = had0 + (g0 * k0 + g1 * k1), had1 + (g0 * k1 + g1 * k2)
    put_where(touch.sum0, g, mask, sum0)
    put_where(touch.sum1, g, mask, sum1)
    put_where(touch.more0, g, mask, take(touch.more0, g) + g0)
    put_where(touch.more1, g, mask, take(touch.more1, g) + g1)
    h0, h1 = d0 + beta * q0, d1 + beta * q1
    normal = choose(mask, h0 * k0 + h1 * k1, 0.0), choose(mask, h0 * k1 + h1 * k2, 0.0)
    shear = (
        choose(mask, ratio * (sum0 + beta * (s0 * k0 + s1 * k1)), 0.0),
        choose(mask, ratio * (sum1 + beta * (s0 * k1 + s1 * k2)), 0.0),
    )
    acts = choose(mask, k0, 0.0), choose(mask, k1, 0.0), choose(mask, k2, 0.0)
    elastic = spent = like(0.0, d0)
    if counts:
        gain = g0 * (2.0 * had0 + g0 * k0 + 2.0 * g1 * k1)
        sum2 = take(touch.sum2, g) + (gain + g1 * (2.0 * had1 + g1 * k2))
        put(touch.sum2, g, sum2)
        stored = d0 * (d0 * k0 + 2.0 * d1 * k1) + d1 * d1 * k2
        drag = q0 * (q0 * k0 + 2.0 * q1 * k1) + q1 * q1 * k2
        drag += ratio * (s0 * (s0 * k0 + 2.0 * s1 * k1) + s1 * s1 * k2)
        elastic, spent = 0.5 * (stored + ratio * sum2), dt * beta * drag
    return normal, shear, acts, acts, elastic, spent, like(0.0, d0)
