"""A façade before a building that yields, for tests."""

import numpy as np
from study_cases import study_case

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
