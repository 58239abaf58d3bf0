"""How stiffly a façade stands on its base: the joint's stiffness, and where across it that sits.

`study`: the whole wall's compressibility in one even joint, jkn = E/h (the study's section 3.1).

`column`: the same block on the base for which its static curve λ(d) is that of the wall itself, a
column that is elastic along its height, carries no tension and feels P-Δ
(`rocking.mechanics.column`). As the wall leans, compression gathers at the toe and the part of it
that yields shrinks, so that its base seems to stiffen: stiffness at its edges stands for that,

    2.2 E/h spread evenly, and 0.3 E b/h along either edge.

The first of the two follows from the second, by the stiffness of the uncracked column: its top
moves by a quarter of what the block on E/h does, Σ k y² = 4 (E/h) b³/12, so 4 − 6·0.3 = 2.2. The
other was chosen for its static curve; the study base_compliance says how far it holds. Being linear
and without tension, the joint scales with the load on it, as the column does.
"""

import itertools

import numpy as np

from yade_scripts.model.facades import STUDY, Facade

BASE = "base"  # name of the block that a façade stands on
EDGE = 0.3  # stiffness along either edge, over E b/h
SPREAD = 4.0 - 6.0 * EDGE  # stiffness spread evenly, over E/h


def base_jkn(facade):
    """Joint stiffness of the base [Pa/m]: as stated; E/h; of courses E over half a course."""
    facade = Facade.of(facade)
    if facade.base_stiffness_pa_m:
        return facade.base_stiffness_pa_m
    length = 0.5 * course_tops(facade)[0] if facade.courses else facade.height_m
    return facade.e_mpa * 1e6 / length


def course_tops(facade):
    """Heights of the tops of `facade.courses`, from the lowest up, the façade's own the last [m].

    Each is `courses_growth` times as high as the one below it.
    """
    facade = Facade.of(facade)
    growth = facade.courses_growth or 1.0
    sums = list(itertools.accumulate(growth**k for k in range(facade.courses)))
    return [facade.height_m * (each / sums[-1]) for each in sums]


def parts(facade):
    """Stiffness spread evenly [Pa/m], and along either edge [Pa] per width."""
    facade = Facade.of(facade)
    jkn = base_jkn(facade)
    if facade.base == STUDY:
        return jkn, 0.0
    return SPREAD * jkn, EDGE * jkn * facade.thickness_m


def total(facade):
    """Stiffness of the whole base over jkn·b·w."""
    return 1.0 if facade.base == STUDY else SPREAD + 2.0 * EDGE


def shares(facade, weights):
    """Stiffness of the base's nodes over jkn·b·w, from their weights.

    The weights sum to 1; the first node and the last stand on the edges.
    """
    if facade.base == STUDY:
        return np.asarray(weights, float)
    share = SPREAD * np.asarray(weights, float)
    share[[0, -1]] += EDGE
    return share
