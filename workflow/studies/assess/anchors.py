"""What one anchor plate of a tie holds before it punches through the wall or crushes it.

A square plate of side a on a wall of thickness t, that below
the row. Punching shears the masonry off along a truncated
pyramid that opens at 45° through the wall; its lateral area is taken at mid-thickness, and the
vertical stress that would add friction is left out:

    R_p = f_vd · 4 (a + t) t,      f_vd = τ0/(γ_M FC)

Crushing under the plate, without the spread of the stress:

    R_c = f_d a²,                  f_d = f_m/(γ_M FC)

The least of the two counts. Both were read at second hand (`sources`): punching of a round plate,
π (D + t) t f_vd, in a worked example of a design office, for a square one derived from it. What
a single rod's steel takes is the tie's own (`yade_scripts.model.holds`).
"""

import math
from dataclasses import replace
from typing import NamedTuple

from yade_scripts.model.facades import Facade
from yade_scripts.model.shape import shape_of

FULL = 0.999  # of what an anchor holds that a rod may take: the rod yields first
PARTIAL = 2.0  # γ_M of existing masonry, NTC 2018, 7.8.1.1
PUNCHING, CRUSHING, STATED = "punching", "crushing", "stated"
SIDE_M = 1e-6


class Anchor(NamedTuple):
    """What one anchor holds [N], and by what: PUNCHING, CRUSHING or STATED."""

    force_n: float
    by: str


def anchor(assessment, thickness_m):
    """`Anchor` on a wall of a thickness, by section assessment."""
    side, factor = assessment["anchor_plate_m"], PARTIAL * assessment["confidence_factor"]
    shear = 1e6 * assessment["masonry_shear_mpa"] / factor
    crush = 1e6 * assessment["masonry_compression_mpa"] / factor
    punching = shear * 4.0 * (side + thickness_m) * thickness_m
    crushing = crush * side**2
    return Anchor(punching, PUNCHING) if punching <= crushing else Anchor(crushing, CRUSHING)


def thickness_at(facade, height_m):
    """Thickness of the wall below a row of ties [m]; of a `Facade` or its section."""
    shape = shape_of(replace(Facade.of(facade), courses=0))
    back, front = shape.faces_at(min(max(height_m - SIDE_M, 0.0), shape.storeys[-1][1]))
    return front - back


def most_in_a_row(assessment, facade, height_m):
    """Anchors side by side in a row whose pyramids do not meet; at least one."""
    apart = assessment["anchor_plate_m"] + 2.0 * thickness_at(facade, height_m)
    return max(1, math.floor(Facade.of(facade).width_m / apart))


def completed(facade, assessment):
    """Section facade whose ties all have a capacity of anchors: the stated one or `anchor`."""

    def held_kn(row):
        if row["anchor_kn"] is not None:
            return row["anchor_kn"]
        return 1e-3 * anchor(assessment, thickness_at(facade, row["height_m"])).force_n

    ties = [{**row, "anchor_kn": held_kn(row)} for row in facade["ties"]]
    return {**facade, "ties": ties}


def completed_settings(settings):
    """Sections of a configuration whose façade is `completed` by its section assessment."""
    return {**settings, "facade": completed(settings["facade"], settings["assessment"])}
