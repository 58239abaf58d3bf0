"""The dense search against outcomes that are known beforehand, without any solver."""

import numpy as np
import pytest
from studies.accuracy.dense import dense

from yade_scripts.commands.search import drive

SETTINGS = {"level_ratio": 0.02, "beyond": 1.35, "max_pga_g": 2.0}
SETTINGS |= {"amplitude_spread": 0.01, "fine_step": 0.002}


def test_a_dense_search_ends_where_all_within_its_window_fall():
    """Fine steps from below the first fall of the climb to one window past the lowest fall."""
    asked = []

    def run(ask):
        asked.append((ask.realisations, np.array(ask.pga_g)))
        return ["overturned" if 0.30 < g < 0.33 or g > 0.5 else "ok" for g in ask.pga_g]

    drive(dense(0.1, SETTINGS), run)
    fine = np.concatenate([pga_g for realisations, pga_g in asked if realisations])
    assert np.diff(np.log(fine)).max() == pytest.approx(np.log(1.002))
    assert fine.min() < 0.30
    assert 0.30 * 1.01 / 0.99 < fine.max() < 0.33
