"""Façades of the tests of wedges, parts of the width and horizontal bending."""

from studies.assess.code_spectrum import CodeDemand
from studies.assess.family import Family
from study_cases import study_settings

GAMMA = 1800.0 * 9.81
PLAIN = {"height_m": 6.0, "thickness_m": 0.5, "width_m": 5.0, "density_kg_m3": 1800.0}
WALLS = {"count": 2, "thickness_m": 0.4}
SHAPED = {
    **PLAIN,
    "gable_height_m": 1.5,
    "thickness_steps": [{"z_m": 3.0, "thickness_m": 0.4}],
    "openings": [{"x_m": -1.0, "z_m": 3.5, "width_m": 1.0, "height_m": 1.4}],
    "floors": [{"height_m": 3.0, "load_kn": 20.0, "anchor_kn": 5.0}],
    "ties": [{"height_m": 5.0, "count": 2, "diameter_mm": 16.0}],
}
BRICKS = {"interlocking_course_m": 0.25, "interlocking_overlap_m": 0.15}
DEMAND = CodeDemand(0.2, 2.45, 0.32, "B")


def resolved(facade=PLAIN, **own):
    return study_settings(
        {
            "facade": facade,
            "return_wall": WALLS,
            "smdof": {"n_dof": 2, "period_s": 0.25},
            "assessment": own,
        }
    )


def family(facade=PLAIN, **own):
    return Family(resolved(facade, **own))
