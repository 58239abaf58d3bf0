"""Shake-table tests of a wall: one run for each motion, scale, direction and β, and its peaks."""

import copy
import math

import numpy as np
from rocking.records import measures

SECTIONS = ("facade", "return_wall", "smdof", "numerics")
ABOUT = ("record", "source", "scale", "pga_g", "direction", "tilt_deg", "law")
COLUMNS = (*ABOUT, "beta_s", "rest_mm", "peak_mm", "lowest_mm", "end_mm", "overturned", "status")


def tests_of(wall, record, motion, tilt, scales, laws):
    """Yield the tests of a wall (resolved configuration) under one motion, as YADE takes them.

    `tilt` is its inclination [°]; scales are factors on the motion; laws have β [s] by name.
    """
    config = copy.deepcopy(wall)
    config["facade"]["tilt_deg"] = tilt
    for scale in scales:
        for direction, sign in (("pos", 1.0), ("neg", -1.0)):
            for law, beta in laws.items():
                yield {
                    "id": f"{record.name} ×{scale:g} {direction} {law}",
                    "config": {key: config[key] for key in SECTIONS},
                    "model": "W1" if config["facade"]["sides"] == "one" else "free",
                    "beta_s": beta,
                    "motion": motion,
                    "factor": sign * scale,
                    "about": {
                        "record": record.name,
                        "source": record.source,
                        "scale": scale,
                        "direction": direction,
                        "law": law,
                        "tilt_deg": tilt,
                        "pga_g": scale * measures(record)["pga_g"],
                    },
                }


def rest_mm(test):
    """Top displacement of the tilted wall at rest [mm]."""
    facade = test["config"]["facade"]
    return 1e3 * facade["height_m"] * math.sin(math.radians(facade["tilt_deg"]))


def relative_mm(test, done):
    """Top displacement over time, relative to the table and to the tilted rest position [mm]."""
    return 1e3 * done["d_m"] - rest_mm(test)


def largest_mm(test, done):
    """Largest outward displacement [mm]; the thickness where it fell, NaN where it failed."""
    ends = {"overturned": 1e3 * test["config"]["facade"]["thickness_m"], "failed": np.nan}
    return ends[done["status"]] if done["status"] in ends else relative_mm(test, done).max()


def row_of(test, done):
    """Row of a test, see COLUMNS; what a run did not reach is blank."""
    d = relative_mm(test, done)
    failed, fallen = (done["status"] == status for status in ("failed", "overturned"))
    return {
        **{key: test["about"][key] for key in ABOUT},
        "beta_s": test["beta_s"],
        "rest_mm": f"{rest_mm(test):.2f}",
        "peak_mm": "" if failed or fallen else f"{d.max():.2f}",
        "lowest_mm": "" if failed else f"{d.min():.2f}",
        "end_mm": "" if failed or fallen else f"{d[-1]:.2f}",
        "overturned": "" if failed else int(fallen),
        "status": done["status"],
    }
