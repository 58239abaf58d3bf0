"""Code against dynamics: ratios, censoring, shares and their intervals."""

import math

import numpy as np
import pandas as pd
import pytest
from studies.assess.comparison import intervals, share_interval, summary, unsafe


def table(ratio, dynamic=0.5, most=3.0, stations=None):
    ratio = np.asarray(ratio, float)
    names = stations if stations is not None else [f"s{i}" for i in range(len(ratio))]
    return pd.DataFrame(
        {
            "pga_fails_g": ratio * dynamic,
            "pga_dynamic_g": dynamic,
            "pga_max_g": most,
            "station": names,
            "run": "a",
        }
    )


def test_a_lognormal_sample_gives_back_its_median_scatter_and_share():
    rng = np.random.default_rng(7)
    ratio = 0.7 * np.exp(0.4 * rng.standard_normal(4000))
    found = summary(table(ratio), 200, 1)
    assert found["median_ratio"] == pytest.approx(0.7, rel=0.03)
    assert found["log_scatter"] == pytest.approx(0.4, rel=0.04)
    expected = 0.5 * math.erfc(math.log(1.0 / 0.7) / 0.4 / math.sqrt(2.0))
    assert found["ci_low"] < expected < found["ci_high"]


def test_a_façade_that_never_fell_keeps_its_check_on_the_safe_side():
    low, high = intervals(np.array([1.0, np.nan, 4.0]), np.array([np.nan, 0.5, np.nan]), 3.0)
    assert low[:2].tolist() == [0.0, 6.0]
    assert high[:2] == pytest.approx([1.0 / 3.0, math.inf])  # at most 1/3; at least 6
    assert unsafe(low, high).tolist()[:2] == [0.0, 1.0]
    assert math.isnan(unsafe(low, high)[2])  # check beyond what was run: not known


def test_stations_are_drawn_together():
    """Twenty copies of one station's flags are no more evidence than one."""
    flags = np.tile([1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], 20)
    stations = np.tile(list("abcdefg"), 20)
    _, low, high = share_interval(flags, stations, 2000, 1)
    alone = share_interval(flags[:7], stations[:7], 2000, 1)
    assert (low, high) == pytest.approx(alone[1:])
    assert high - low > 0.5
    _, tight_low, tight_high = share_interval(flags, np.arange(140).astype(str), 2000, 1)
    assert tight_high - tight_low < 0.25


def test_an_interval_stays_open_where_all_agree():
    share, low, high = share_interval(np.zeros(40), np.repeat(list("abcdefgh"), 5), 100, 1)
    assert (share, low) == (0.0, 0.0)
    assert high == pytest.approx(1.0 - 0.025 ** (1.0 / 8.0))


def test_fewer_than_seven_stations_give_a_share_and_no_interval():
    share, low, high = share_interval([1.0, 0.0, 1.0, 1.0, 1.0, 1.0], list("abcdef"), 100, 1)
    assert share == pytest.approx(5.0 / 6.0)
    assert math.isnan(low)
    assert math.isnan(high)
