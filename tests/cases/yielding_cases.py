"""A façade before a building that yields, for tests."""

import numpy as np
from rocking import Motion
from study_cases import study_case

from yade_scripts.model import floor_motions
from yade_scripts.model.motion import amplitude

KEYS = {"return_wall.building_mass_kg": 65e3}


def case(model="W2", ratio=0.25, loops="bilinear", **more):
    """Case of the study's block whose building has a base-shear coefficient; `more` of smdof."""
    smdof = {"base_shear_ratio": ratio, "loops": loops, **more}
    return study_case(model, KEYS | {f"smdof.{key}": value for key, value in smdof.items()})


def ground(seconds=8.0, dt=0.001, seed=3, peak=3.0):
    """Smoothed noise under an envelope, which ends at rest [m/s²]."""
    coarse = 0.01 * np.arange(int(seconds / 0.01))
    draw = np.random.default_rng(seed).standard_normal(coarse.size)
    noise = np.convolve(draw, np.hanning(9), "same")
    a = noise * np.exp(-(((coarse - 0.4 * seconds) / (0.2 * seconds)) ** 2))
    fine = np.interp(dt * np.arange(int(seconds / dt)), coarse, a)
    return peak * fine / np.abs(fine).max()


def write_floors_by_pga(folder, levels_g):
    """Floors of a building that yields under RRS228, a file a PGA and `by_pga.csv` that names them.

    Returns case and motion.
    """
    weak, motion = case("W2", 0.1, "peak_oriented"), Motion.named("RRS228")
    time_s, columns = motion.columns(weak)
    rows = ["pga_g,file"]
    for level in levels_g:
        moved = columns.at(amplitude(columns["ground"], "pos", level))
        floor_motions.write_columns(folder / f"at_{level:g}.csv", time_s, moved, digits=12)
        rows.append(f"{level:g},at_{level:g}.csv")
    (folder / "by_pga.csv").write_text("\n".join(rows) + "\n")
    return weak, motion
