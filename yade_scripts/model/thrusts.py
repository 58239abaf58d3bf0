"""Static thrusts of roofs and vaults on a façade: horizontal, outward, constant.

A thrust F acts on the middle of the thickness at its height and does not grow with the shaking.
What pushes stands between the façade and the return wall behind it, which it pushes back by as
much. In a scene it is a tie to a point FAR_M outward that is stretched by PRESTRETCH_M from the
start, with the stiffness F/PRESTRETCH_M: as its point moves outward by u it loses u/PRESTRETCH_M of
F, a thousandth at 0.5 m.

At rest F takes F z/W from the arm of the weight (`leaning`), so that the façade starts where the
base carries both.
"""

from yade_scripts.model.bars import Tie
from yade_scripts.model.floors import loaded, wall_behind

FAR_M, PRESTRETCH_M = 2e3, 5e2
ENDS = 2.0  # of the prestretch: never reached, neither by force nor by lengthening


def thrust_ties(rows, walls, blocks, shape):
    """Ties that stand for thrusts, `Facade.thrusts`; arguments as of `ties.facade_ties`."""
    ties = []
    for number, row in enumerate(rows, 1):
        force, z = row.force_n, row.height_m
        carrier = wall_behind(f"thrusts[{number}].height_m", z, walls, blocks)
        y = 0.5 * sum(shape.faces_at(z))
        ties.append(
            Tie(
                f"thrust {number}",
                1 + shape.piece_at(z),
                carrier,
                (0.0, y, z),
                (0.0, y + FAR_M, z),
                force / PRESTRETCH_M,
                ENDS * force,
                -PRESTRETCH_M,
                ENDS * PRESTRETCH_M,
            )
        )
    return ties


def leaning(floors, thrusts, shape):
    """Weight with loads [N], and the lever at which it would do what thrusts do with it at rest.

    As `floors.loaded`, with the arm less Σ F z/W.
    """
    weight, (arm, height) = loaded(floors, shape)
    moment = sum(row.force_n * row.height_m for row in thrusts)
    return weight, (arm - moment / weight, height)
