"""The threshold that falls as often in a year, by hand and by counting earthquakes."""

import numpy as np
import pandas as pd
import pytest
from rocking.collapse import probability
from rocking.collapse.equivalent import equivalent, thresholds

GRID = np.geomspace(0.05, 3.0, 8001)
TWICE = np.where((GRID > 0.2) & (GRID < 0.3) | (GRID > 0.5), 1.0, 0.0)


@pytest.mark.parametrize("slope", [1.0, 2.0, 3.5])
def test_a_curve_that_falls_once_has_its_threshold(slope):
    share = (GRID > 0.4).astype(float)
    assert equivalent(GRID, share, slope) == pytest.approx(0.4, rel=1e-3)
    assert np.isnan(equivalent(GRID, 0.0 * GRID, slope))


def test_two_distant_runs_meet_at_their_geometric_middle():
    """0.1 g stands and 0.4 g falls: a threshold at 0.2 g, as a first crossing has it."""
    assert equivalent([0.1, 0.4], [0.0, 1.0]) == pytest.approx(0.2)


@pytest.mark.parametrize("slope", [1.0, 2.0, 3.5])
def test_two_ranges_of_collapse_by_hand(slope):
    """c⁻ᵏ = 0.2⁻ᵏ − 0.3⁻ᵏ + 0.5⁻ᵏ; where 40 % fall in the lower range, 0.4 of its part."""
    parts = [0.2**-slope - 0.3**-slope, 0.5**-slope]
    for lower in (1.0, 0.4):
        share = np.where(GRID < 0.4, lower, 1.0) * TWICE
        by_hand = (lower * parts[0] + parts[1]) ** (-1.0 / slope)
        assert equivalent(GRID, share, slope) == pytest.approx(by_hand, rel=1e-3)


def test_earthquakes_that_fall_are_as_many_as_by_the_threshold():
    """A million of a hazard ∝ x⁻²: those that fell it by P(x), and those above c."""
    rng = np.random.default_rng(4)
    pga_g = 0.05 * rng.random(1_000_000) ** (-1.0 / 2.0)
    share = np.clip((GRID - 0.2) / 0.3, 0.0, 1.0) * np.where((GRID > 0.3) & (GRID < 0.4), 0.2, 1.0)
    fell = rng.random(pga_g.size) < np.interp(pga_g, GRID, share)
    above = np.count_nonzero(pga_g > equivalent(GRID, share))
    assert above == pytest.approx(fell.sum(), rel=0.02)


def test_realisations_of_a_curve_fall_as_often_as_the_curve():
    """The mean of the −k-th powers of their thresholds is that of the curve's, by any slope."""
    share = np.clip((GRID - 0.2) / 0.3, 0.0, 1.0) * np.where((GRID > 0.3) & (GRID < 0.4), 0.2, 1.0)
    levels = (np.arange(400) + 0.5) / 400
    for slope in (1.5, 3.0):
        low, high = thresholds(GRID, share, levels, slope)
        assert low == pytest.approx(high)
        mean = np.mean(low**-slope) ** (-1.0 / slope)
        assert mean == pytest.approx(equivalent(GRID, share, slope), rel=1e-3)


def test_what_was_not_run_is_left_open():
    """A range from 0.2 to 0.3 g alone, run to 3 g: it may fall from there on, or never again."""
    share = np.where((GRID > 0.2) & (GRID < 0.3), 0.6, 0.0)
    (low, none), (high, never) = thresholds(GRID, share, [0.5, 0.7])
    assert high == pytest.approx((0.2**-2 - 0.3**-2) ** -0.5, rel=1e-3)
    assert low == pytest.approx((0.2**-2 - 0.3**-2 + 3.0**-2) ** -0.5, rel=1e-3)
    assert (none, never) == (pytest.approx(3.0), np.inf)


def test_tables_carry_it_and_curves_are_compared_by_it():
    table = pd.DataFrame(
        {"pga_g": GRID, "collapsed": TWICE.astype(int), "d_over_b": 0.5, "status": "ok"}
    )
    table.loc[table["collapsed"] == 1, "status"] = "overturned"
    by_hand = (0.2**-2 - 0.3**-2 + 0.5**-2) ** -0.5
    found = probability.summary(table, (), (), 0.01)
    assert found["pga_equivalent_g"] == pytest.approx(by_hand, rel=2e-3)
    assert found["pga_median_g"] == pytest.approx(0.2, rel=0.01)
    steeper = probability.summary(table, (), (), 0.01, slope=3.0)["pga_equivalent_g"]
    assert steeper < found["pga_equivalent_g"]  # weak shaking counts for more
    rows = pd.DataFrame([found, {**found, "pga_equivalent_g": np.nan}])
    assert probability.one_number(rows).to_list() == pytest.approx([by_hand, 0.2], rel=0.01)
    dense = pd.DataFrame({"pga_g": GRID, "probability": TWICE, "realisations": 9.0})
    dense = dense.assign(realisations_yade=np.nan, probability_yade=np.nan)
    low, high, weight = np.array(probability.brackets(dense, found, slope=2.0)).T
    assert np.all((low < by_hand) & (by_hand < high))
    assert high / low == pytest.approx(1.0, abs=0.01)
    assert weight.sum() == pytest.approx(1.0)
    first = np.array(probability.brackets(dense, found))[:, 1]
    assert first == pytest.approx(0.2, rel=0.01)
