"""Between which amplitudes a probability first reaches a level, and how often it does so there."""

import numpy as np
import pandas as pd
import pytest
from rocking.collapse import probability
from rocking.collapse.crossing import between, wilson

GRID = np.exp(np.arange(np.log(0.2), np.log(0.6), 0.02 / 11))  # eleven within ± 1 %


def run(rise, seed):
    """Outcomes of a façade that falls with the probability `rise` of amplitude."""
    fell = np.random.default_rng(seed).random(GRID.size) < rise(GRID)
    status = np.where(fell, "overturned", "ok")
    table = pd.DataFrame({"pga_g": GRID, "status": status, "collapsed": fell.astype(int)})
    return probability.summary(table.assign(d_over_b=0.5), (), (), 0.01)


def test_the_interval_of_a_share_is_that_of_its_score():
    """Of n draws at either end of it the seen share lies 1.645 standard errors off."""
    for share, count in ((0.0, 11.0), (0.3, 20.0), (1.0, 5.0)):
        ends = np.array(wilson(share, count))
        errors = 1.645 * np.sqrt(ends * (1.0 - ends) / count)
        assert np.abs(share - ends) == pytest.approx(errors, abs=1e-9)
        assert ends[0] <= share + 1e-12
        assert share <= ends[1] + 1e-12


def test_a_threshold_is_known_to_the_spread():
    """Its level is reached within the scatter of eleven: the width of the window at most."""
    found = run(lambda g: g > 0.4, 0)
    for name in ("p10", "median", "p90"):
        low, middle, high = (found[f"pga_{name}{end}_g"] for end in ("_low", "", "_high"))
        assert low <= middle <= high
        assert high / low < 1.0 + 0.02
    assert np.isnan(run(lambda g: 0.0 * g, 0)["pga_median_low_g"])


def test_a_plateau_near_a_level_is_a_wide_range():
    """Half fall from 0.3 to 0.5 g: somewhere there one half is crossed first, chance says where."""
    for seed in range(20):
        found = run(lambda g: np.where(g < 0.3, 0.0, np.where(g < 0.5, 0.5, 1.0)), seed)
        assert found["pga_median_low_g"] < 0.31
        assert found["pga_median_high_g"] > found["pga_median_g"]
        assert found["pga_p10_high_g"] < 0.31


def test_the_true_crossing_lies_in_the_stated_range():
    """Probability that rises over a fifth of amplitude: in nine of ten curves, by level."""
    levels = {"p10": 0.1, "median": 0.5, "p90": 0.9}
    inside = {name: [] for name in levels}
    for seed in range(150):
        found = run(lambda g: np.clip((np.log(g / 0.35)) / 0.2, 0.0, 1.0), seed)
        for name, level in levels.items():
            true = 0.35 * np.exp(0.2 * level)
            low, high = found[f"pga_{name}_low_g"], found[f"pga_{name}_high_g"]
            inside[name].append(low * 0.99 <= true <= high * 1.01)
    assert all(np.mean(held) > 0.9 - 2.0 * np.sqrt(0.09 / 150) for held in inside.values()), inside


def test_what_is_never_sure_has_no_upper_end():
    """Two of four fall at the last amplitudes: half is reached, but not by more than its error."""
    pga_g = 0.3 * 1.005 ** np.arange(8)
    fell = [0, 0, 0, 0, 1, 0, 1, 0]
    low, high = between(pga_g, fell, np.full(8, 0.005), 0.01, 0.5)
    assert 0.3 < low <= pga_g[4]
    assert np.isnan(high)
    assert np.isfinite(between(pga_g, [0, 0, 0, 0, 1, 1, 1, 1], np.full(8, 0.005), 0.01, 0.9)[1])
