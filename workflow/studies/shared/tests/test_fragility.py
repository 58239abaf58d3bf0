"""Fragility: the fit recovers what made the data, censoring does not bias it, measures convert."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from record_samples import harmonic
from scipy import stats
from scipy.optimize import minimize
from scipy.special import ndtr
from studies.shared import fragility
from studies.shared.sufficiency import properties, slope

MEDIAN, DISPERSION = 0.35, 0.45


def climb(capacity, start=0.03, growth=1.35, top=3.0, halvings=2):
    """Brackets as an IDA finds them: a climb by a factor, then bisection."""
    grid = start * growth ** np.arange(int(np.ceil(np.log(top / start) / np.log(growth))))
    grid = np.r_[0.0, grid, top]
    low, high = [], []
    for c in capacity:
        i = int(np.searchsorted(grid, c))
        if i == len(grid):
            low.append(top)
            high.append(np.inf)
            continue
        a, b = grid[i - 1], grid[i]
        for _ in range(halvings):
            middle = 0.5 * (a + b)
            a, b = (a, middle) if c <= middle else (middle, b)
        low.append(a)
        high.append(b)
    return np.array(low), np.array(high)


def draws(n, seed):
    return MEDIAN * np.exp(DISPERSION * np.random.default_rng(seed).standard_normal(n))


def test_parameters_are_recovered_from_many_brackets():
    low, high = climb(draws(20000, 1))
    found = fragility.fit(low, high)
    # standard errors of the mean and standard deviation of ln: 0.45/√20000 and /√40000
    assert np.log(found.median / MEDIAN) == pytest.approx(0.0, abs=4 * 0.0032)
    assert found.dispersion == pytest.approx(DISPERSION, abs=4 * 0.0023)


def test_wide_brackets_and_censoring_do_not_bias_the_fit_but_dropping_curves_does():
    capacity = draws(20000, 2)
    low, high = climb(capacity, growth=3.0, top=0.5, halvings=0)  # a fifth never collapses
    open_ended = np.isinf(high)
    assert 0.15 < open_ended.mean() < 0.3
    found = fragility.fit(low, high)
    assert found.median == pytest.approx(MEDIAN, rel=0.02)
    assert found.dispersion == pytest.approx(DISPERSION, rel=0.04)
    dropped = fragility.fit(low[~open_ended], high[~open_ended])
    assert dropped.median < 0.9 * MEDIAN


def test_stripes_agree_with_the_binomial_likelihood():
    """Baker (2015), eq. 11: counts of collapses at common intensities, another parametrisation."""
    levels = np.geomspace(0.08, 1.2, 9)
    rng = np.random.default_rng(3)
    runs, collapses = 40, rng.binomial(40, ndtr(np.log(levels / MEDIAN) / DISPERSION))
    stood = runs - collapses
    low = np.concatenate([np.repeat(0.0, collapses.sum()), np.repeat(levels, stood)])
    high = np.concatenate([np.repeat(levels, collapses), np.repeat(np.inf, stood.sum())])

    def negative(theta):
        p = ndtr((np.log(levels) - theta[0]) / np.exp(theta[1]))
        return -stats.binom.logpmf(collapses, runs, p).sum()

    best = minimize(
        negative, [-1.0, -1.0], method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12}
    ).x
    found = fragility.fit(low, high)
    assert found.median == pytest.approx(np.exp(best[0]), rel=1e-6)
    assert found.dispersion == pytest.approx(np.exp(best[1]), rel=1e-6)


def test_agrees_with_scipys_fit_of_censored_data():
    low, high = climb(draws(25, 4), top=0.5)
    with np.errstate(divide="ignore"):
        data = stats.CensoredData(
            interval=np.log(np.c_[low, high][np.isfinite(high)]), right=np.log(low[np.isinf(high)])
        )
    mean, sd = stats.norm.fit(data)
    found = fragility.fit(low, high)
    assert found.median == pytest.approx(np.exp(mean), rel=2e-4)
    assert found.dispersion == pytest.approx(sd, rel=5e-4)


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.floats(-1.5, 1.5), min_size=3, max_size=20),
    st.floats(1e-3, 1e3),
    st.floats(0.3, 3.0),
)
def test_units_only_scale_the_median(logs, factor, top):
    low, high = climb(MEDIAN * np.exp(logs), top=top)
    one, other = fragility.fit(low, high), fragility.fit(factor * low, factor * high)
    if np.isnan(one.median):
        assert np.isnan(other.median)
        return
    assert other.median == pytest.approx(factor * one.median, rel=1e-6)
    assert other.dispersion == pytest.approx(one.dispersion, rel=1e-6)


@pytest.mark.parametrize(("below", "above"), [(1, 1), (1, 2), (4, 1)])
def test_brackets_that_meet_in_one_point_have_the_smallest_dispersion(below, above):
    """As β falls the likelihood rises to its bound; the median is the likeliest one there."""
    low = np.r_[np.full(below, 0.18), np.full(above, 0.2), 0.1]
    high = np.r_[np.full(below, 0.2), np.full(above, 0.21), np.inf]
    found = fragility.fit(low, high)
    assert found.dispersion == fragility.MIN_DISPERSION
    medians = np.linspace(0.19, 0.21, 4001)
    p = ndtr(np.log(high[:, None] / medians) / found.dispersion) - ndtr(
        np.log(low[:, None] / medians) / found.dispersion
    )
    likeliest = medians[np.argmax(np.log(p).sum(axis=0))]
    assert found.median == pytest.approx(likeliest, abs=1.1e-5)
    shifted = fragility.fit(low * (1.0 + 1e-13), high)
    assert shifted.median == pytest.approx(found.median, rel=1e-9)
    assert shifted.dispersion == found.dispersion


@settings(max_examples=60, deadline=None)
@given(st.lists(st.floats(-1.5, 1.5), min_size=4, max_size=20), st.floats(-0.3, 0.3))
def test_no_neighbour_is_likelier_than_the_fit(logs, shift):
    low, high = climb(MEDIAN * np.exp(logs))
    found = fragility.fit(low, high)

    def likelihood(median, dispersion):
        p = np.diff(ndtr(np.log(np.stack([low, high]) / median) / dispersion), axis=0)
        return np.log(np.maximum(p, 1e-300)).sum()

    with np.errstate(divide="ignore"):
        best = likelihood(found.median, found.dispersion)
        assert likelihood(found.median * np.exp(shift), found.dispersion) <= best + 1e-6
        assert likelihood(found.median, found.dispersion * np.exp(abs(shift))) <= best + 1e-6


def test_what_cannot_be_fitted_is_blank_and_bad_brackets_are_refused():
    assert np.isnan(fragility.fit([0.3, 0.3], [np.inf, np.inf]).median)  # nothing collapsed
    assert np.isnan(fragility.fit([0.0, 0.0], [0.3, 0.3]).median)  # nothing stood
    assert np.isnan(fragility.fit([0.1], [0.2]).median)  # one curve has no dispersion
    same = fragility.fit([0.30, 0.31], [0.33, 0.34])  # overlapping brackets: the floor is kept
    assert same.dispersion == pytest.approx(fragility.MIN_DISPERSION)
    with pytest.raises(ValueError, match=r"bracket 2: 0.4 to 0.3"):
        fragility.fit([0.1, 0.4], [0.2, 0.3])
    with pytest.raises(ValueError, match="at least one"):
        fragility.fit([], [])


def coverage(records, trials=120):
    """Share of 90 % intervals of the median that hold the true one."""
    hits = 0
    for trial in range(trials):
        low, high = climb(draws(records, 1000 + trial), top=0.6)
        found = fragility.bootstrap(low, high, np.arange(records), 300, trial)
        a, b = found.interval(found.median, 0.9)
        hits += a <= MEDIAN <= b
    return hits / trials


def test_interval_covers_the_median_as_often_as_it_says_with_a_suite_of_records():
    # binomial standard error of 120 trials: 0.027
    assert 0.82 <= coverage(44) <= 0.97


def test_stations_are_drawn_whole():
    """The same curve twice at one station must not narrow the interval."""
    low, high = climb(draws(15, 7))
    names = np.arange(15)
    once = fragility.bootstrap(low, high, names, 400, 5)
    twice = fragility.bootstrap(np.tile(low, 2), np.tile(high, 2), np.tile(names, 2), 400, 5)
    np.testing.assert_allclose(twice.median, once.median, rtol=1e-5)
    for name in ("median", "dispersion"):
        one, other = (draws.interval(getattr(draws, name), 0.9) for draws in (once, twice))
        np.testing.assert_allclose(other, one, rtol=1e-4)
    as_if_apart = np.concatenate([names, 15 + names])
    apart = fragility.bootstrap(np.tile(low, 2), np.tile(high, 2), as_if_apart, 400, 5)
    width = [np.ptp(np.log(draws.interval(draws.median, 0.9))) for draws in (once, apart)]
    assert width[1] / width[0] == pytest.approx(1 / np.sqrt(2), abs=0.12)  # what it would feign


def test_six_stations_give_neither_interval_nor_band_however_many_curves():
    low, high = climb(draws(48, 7))
    few, enough = (fragility.bootstrap(low, high, np.arange(48) % n, 100, 5) for n in (6, 7))
    assert np.isnan(few.interval(few.median, 0.9)).all()
    assert np.isnan(few.band([0.1, 0.3], 0.9)).all()
    assert np.isfinite(enough.interval(enough.median, 0.9)).all()
    assert np.isfinite(enough.band([0.1, 0.3], 0.9)).all()


def test_band_holds_the_curve_and_widens_with_fewer_stations():
    low, high = climb(draws(40, 8))
    x = np.geomspace(0.1, 1.0, 20)
    curve = fragility.fit(low, high).probability(x)
    lower, upper = fragility.bootstrap(low, high, np.arange(40), 500, 1).band(x, 0.9)
    assert np.all(lower <= curve)
    assert np.all(curve <= upper)
    few = fragility.bootstrap(low[:7], high[:7], np.arange(7), 500, 1).band(x, 0.9)
    assert np.mean(few[1] - few[0]) > 1.5 * np.mean(upper - lower)


def test_sufficiency_finds_the_slope_that_is_there_and_holds_zero_where_none_is():
    """Intervals of 60 samples of 40 stations: as often right as they say, and as wide as theory."""
    rng = np.random.default_rng(11)
    names = np.repeat(np.arange(40), 2)
    held, widths = 0, []
    for trial in range(60):
        x = np.repeat(rng.standard_normal(40), 2)
        noise = np.repeat(0.3 * rng.standard_normal(40), 2)  # of the station, in both directions
        found = slope(x, 0.5 * x + noise, names, 0.9, 300, trial)
        assert found.value == pytest.approx(np.polyfit(x, 0.5 * x + noise, 1)[0])
        held += found.low < 0.5 < found.high
        # standard error of a slope, s/(σ_x √n), by stations and not by curves
        widths.append((found.high - found.low) / (2 * 1.645 * 0.3 / (np.std(x) * np.sqrt(40))))
    assert 0.75 <= held / 60 <= 0.98
    assert np.mean(widths) == pytest.approx(1.0, abs=0.12)
    assert np.isnan(slope(x[:4], noise[:4], names[:4], 0.9, 100, 1).value)
    few = slope(x[:12], noise[:12], names[:12], 0.9, 100, 1)  # a slope of six, and no interval
    assert np.isfinite(few.value)
    assert np.isnan([few.low, few.high]).all()


def test_properties_of_a_motion_do_not_change_with_its_scale():
    one, other = properties(harmonic(0.1)), properties(harmonic(0.7))
    for name, value in one.items():
        assert other[name] == pytest.approx(value, rel=1e-9), name
    assert one["pgv_over_pga_s"] == pytest.approx(1.0 / np.pi, rel=1e-3)
    assert one["significant_duration_s"] == pytest.approx(36.0, rel=0.01)
