"""Searches for collapse against outcomes that are known beforehand, without any solver."""

import numpy as np
import pytest
from rocking.collapse import search

from yade_scripts.studies.search import drive

SETTINGS = {"level_ratio": 0.02, "beyond": 1.35, "max_pga_g": 2.0}
SETTINGS |= {"realisations": 6, "amplitude_spread": 0.01, "fine_step": 0.002}


def searched(strategy, falls):
    """All that a search asked for, by ascending amplitude, and what it found."""
    seen = []

    def run(ask):
        assert np.all(np.diff(ask.pga_g) > 0.0)
        seen.extend(ask.pga_g)
        return ["overturned" if falls(g) else "ok" for g in ask.pga_g]

    found = drive(strategy, run)
    return np.sort(seen), found


def separate_range(g):
    return 0.30 < g < 0.33 or g > 0.5


def test_a_scan_sees_every_change_of_outcome_finely():
    """A separate range wider than a level is found, its edges within a sixth of the window."""
    pga_g, _ = searched(search.scan(0.1, SETTINGS), separate_range)
    fell = np.array([separate_range(g) for g in pga_g])
    assert np.count_nonzero(np.diff(fell)) == 3
    for edge in (0.30, 0.33, 0.5):
        low, high = pga_g[pga_g <= edge].max(), pga_g[pga_g > edge].min()
        assert high / low <= 1.0 + 2.0 * 0.01 / 6.0 + 1e-12
    assert pga_g.max() >= 1.35 * 0.5
    assert pga_g.max() < 2.0


def test_a_façade_that_never_falls_is_climbed_to_the_end_and_no_further():
    pga_g, _ = searched(search.scan(0.1, SETTINGS), lambda g: False)
    assert pga_g[-1] == 2.0
    assert np.diff(np.log(pga_g)).max() <= np.log(1.02) + 1e-12


def test_a_façade_that_falls_at_once_is_scanned_below_the_start():
    pga_g, _ = searched(search.scan(0.4, SETTINGS), lambda g: g > 0.36)
    assert pga_g.min() == pytest.approx(0.85 * 0.4)


def test_a_dense_search_ends_where_all_within_its_window_fall():
    """Fine steps from below the first fall of the climb to one window past the lowest fall."""
    asked = []

    def run(ask):
        asked.append((ask.realisations, np.array(ask.pga_g)))
        return ["overturned" if separate_range(g) else "ok" for g in ask.pga_g]

    drive(search.dense(0.1, SETTINGS), run)
    fine = np.concatenate([pga_g for realisations, pga_g in asked if realisations])
    assert np.diff(np.log(fine)).max() == pytest.approx(np.log(1.002))
    assert fine.min() < 0.30
    assert 0.30 * 1.01 / 0.99 < fine.max() < 0.33


def test_crossings_of_a_threshold_are_the_threshold():
    """Every realisation above falls: 10 and 50 % are crossed within half a window of it."""
    for ratio in (1.03, 1.12):
        _, found = searched(search.crossings(0.1, 2.0, ratio), lambda g: g > 0.4)
        assert found == pytest.approx((0.4, 0.4), rel=search.SPREAD)
        assert found[0] < found[1]
    assert np.isnan(searched(search.crossings(0.1, 2.0, 1.12), lambda g: False)[1]).all()


def test_a_short_climb_looks_below_its_first_fall():
    """A separate range that lies between the levels of the climb's last two steps is found."""
    assert not any(0.30 < 0.1 * 1.12**k < 0.31 for k in range(20))
    _, found = searched(search.crossings(0.1, 2.0, 1.12), lambda g: 0.295 < g < 0.311 or g > 0.313)
    assert found[0] < 0.30


def test_the_first_of_ascending_levels():
    levels = [0.1, 0.2, 0.3, 0.4]
    for block in (1, 3):
        assert searched(search.first(levels, block), lambda g: g > 0.15)[1] == 0.2
    assert np.isnan(searched(search.first(levels), lambda g: g > 1.0)[1])
