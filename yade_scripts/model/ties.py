"""Ties of a façade: steel rods at stated heights, anchored behind the return walls.

A row of `count` equal rods of diameter φ and free length L pulls with

    k = n E A/L, A = πφ²/4,  F = n min(A f_y, F_a)

where f_y is the yield stress and F_a what an anchor plate holds before it punches through the
masonry or pulls out. Where the steel is the weaker it yields at F and snaps at the strain
`elongation`; where the anchor is the weaker the tie is lost as soon as it pulls F. The rod runs
horizontally from the back face into the return wall behind it, the block of the wall at its
height, and moves with that; what a rod weighs is left out.
"""

import math

from yade_scripts.model.bars import Tie
from yade_scripts.model.floors import wall_behind


def rod(row):
    """Stiffness, capacity and elongation of a row of ties.

    Parameters
    ----------
    row : dict
        An entry of section ties: count, diameter_mm, length_m, e_mpa, yield_mpa, elongation,
        anchor_kn (of one rod; None: it holds whatever the steel does).

    Returns
    -------
    stiffness_n_m, capacity_n, elongation_m : float
    """
    area = math.pi / 4.0 * (1e-3 * row["diameter_mm"]) ** 2
    stiffness = row["count"] * row["e_mpa"] * 1e6 * area / row["length_m"]
    steel = row["count"] * row["yield_mpa"] * 1e6 * area
    anchor = math.inf if row["anchor_kn"] is None else row["count"] * row["anchor_kn"] * 1e3
    if anchor <= steel:
        return stiffness, anchor, anchor / stiffness
    return stiffness, steel, max(row["elongation"] * row["length_m"], steel / stiffness)


def facade_ties(rows, walls, blocks, shape):
    """Ties between the façade and its return walls.

    Parameters
    ----------
    rows : list of dict
        Section ties: height_m, slack_mm and what `rod` takes.
    walls : sequence of int
        Indices of the return walls' blocks.
    blocks : list of Block
        Block 1 and those after it are the façade's, as `shape` numbers its pieces.
    shape : Shape

    Returns
    -------
    list of Tie

    Raises
    ------
    ValueError
        One line, if a tie lies above the façade or meets no return wall.
    """
    ties = []
    for number, row in enumerate(rows, 1):
        z = row["height_m"]
        behind = wall_behind(f"ties[{number}].height_m", z, walls, blocks)
        stiffness, capacity, elongation = rod(row)
        ties.append(
            Tie(
                f"tie {number}",
                1 + shape.piece_at(z),
                behind,
                (0.0, 0.0, z),
                (0.0, -row["length_m"], z),
                stiffness,
                capacity,
                1e-3 * row["slack_mm"],
                elongation,
            )
        )
    return ties
