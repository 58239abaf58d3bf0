"""Ties of a façade: steel rods at stated heights, anchored behind the return walls.

A row of `count` equal rods of diameter φ and free length L pulls with

    k = n E A/L, A = πφ²/4,  F = n min(A f_y, F_a)

where f_y is the yield stress and F_a what an anchor plate holds before it punches through the
masonry or pulls out. Where the steel is the weaker it yields at F and snaps at the strain
`elongation`; where the anchor is the weaker the tie is lost as soon as it pulls F. The rod runs
horizontally from the back face into the return wall behind it, the block of the wall at its
height, and moves with that; what a rod weighs is left out.

The anchors of a floor without a mass are a tie too, so long that it stays horizontal: they only
pull, slide at what they hold and are lost at their reach. A free-standing façade, which may move
either way, has one to each side.
"""

from yade_scripts.model.bars import Tie
from yade_scripts.model.floors import place_of, wall_behind
from yade_scripts.model.holds import ANCHOR, of_floor, of_tie

REACH = 0.8  # of half the width: outermost rods of a row whose places are not stated
FAR_M = 1e3  # length of an anchor's tie: as its point lifts by 0.1 m it lengthens by 5 µm


def rods_at(row, width_m):
    """Places of the rods of a `Rods` along a façade, from its middle [m].

    Those stated (`x_m`), or evenly over the middle four fifths of its width.
    """
    if row.x_m is not None:
        return list(row.x_m)
    count = row.count
    reach = REACH * 0.5 * width_m
    return [0.0] if count == 1 else [reach * (2.0 * k / (count - 1) - 1.0) for k in range(count)]


def facade_ties(rows, walls, blocks, shape):
    """Ties between the façade and its return walls, by indices of their blocks.

    `rows` are `Facade.ties`; block 1 and those after it are the façade's, as `shape` numbers
    its pieces. ValueError of one line, if a tie lies above the façade or meets no return wall.
    """
    ties = []
    for number, row in enumerate(rows, 1):
        z = row.height_m
        behind = wall_behind(f"ties[{number}].height_m", z, walls, blocks)
        far = (0.0, -row.length_m, z)
        ties.append(_tie(f"tie {number}", shape, behind, (0.0, 0.0, z), far, of_tie(row)))
    return ties


def anchor_ties(rows, walls, blocks, shape):
    """Ties that stand for the anchors of floors without a mass; arguments as `facade_ties`.

    Without walls the base carries the floors, and each has a second tie to the other side.
    """
    ties = []
    for number, row in enumerate(rows, 1):
        anchors = [hold for hold in of_floor(row) if hold.kind == ANCHOR]
        if row.mass_t or not anchors:
            continue
        carrier = wall_behind(f"floors[{number}].height_m", row.height_m, walls, blocks)
        x, y, z = place_of(row, shape)
        sides = ((f"anchor {number}", -FAR_M), (f"anchor {number} inward", FAR_M))
        for name, way in sides[: 1 if walls else 2]:
            ties.append(_tie(name, shape, carrier, (x, y, z), (x, y + way, z), anchors[0]))
    return ties


def _tie(name, shape, carrier, near_m, far_m, hold):
    """Tie of a hold, between a point of the façade and one of its carrier."""
    return Tie(
        name,
        1 + shape.piece_at(hold.height_m),
        carrier,
        near_m,
        far_m,
        hold.stiffness_n_m,
        hold.capacity_n,
        hold.slack_m,
        hold.reach_m - hold.slack_m,
    )
