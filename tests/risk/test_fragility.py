"""Fragility: the fit recovers what made the data, censoring does not bias it, measures convert."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rocking.mechanics.closed_forms import block
from rocking.records import Record
from rocking.records.intensity_measures import (
    HOUSNER_S,
    MEASURES,
    incremental_velocity,
    per_pga,
    record_measures,
)
from rocking.risk import fragility
from rocking.risk.sufficiency import properties, slope
from scipy import stats
from scipy.optimize import minimize
from scipy.special import ndtr

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


# Intensity measures


def harmonic(amplitude_g=0.3, period_s=1.0, cycles=40, dt_s=0.005):
    """A sine of acceleration from rest: v = (aT/2π)(1 − cos), so PGV = aT/π."""
    t = np.arange(0.0, cycles * period_s + dt_s / 2, dt_s)
    return Record(
        "harmonic", amplitude_g * 9.80665 * np.sin(2 * np.pi * t / period_s), dt_s, "surrogate"
    )


def test_measures_of_a_harmonic_are_those_of_the_closed_forms():
    p = block(6.48, 0.375).p_rad_s
    found = record_measures(harmonic(), 1.0, 0.05, p)
    assert found["pga_g"] == pytest.approx(0.3, rel=1e-6)
    assert found["pgv_cm_s"] == pytest.approx(100 * 0.3 * 9.80665 / np.pi, rel=1e-3)
    assert found["sa_t1_g"] == pytest.approx(0.3 / (2 * 0.05), rel=0.02)  # resonance, 1/2ζ
    assert found["p_pgv_over_g"] == pytest.approx(p * 0.3 / np.pi, rel=1e-3)
    # between two zeros the velocity changes by aT/π
    assert found["miv_cm_s"] == pytest.approx(100 * 0.3 * 9.80665 / np.pi, rel=1e-3)
    # far above resonance Sa is the static a, so AvgSa about a period of 0.01 s is the PGA
    assert record_measures(harmonic(), 0.01, 0.05, p)["sa_avg_g"] == pytest.approx(0.3, rel=0.01)
    stiff = record_measures(harmonic(), 0.01, 0.05, p)
    assert stiff["sa_t1_g"] == pytest.approx(0.3, rel=0.01)  # a rigid oscillator sees the PGA


def test_measures_scale_with_the_record_so_the_factors_do_not():
    p = 1.5
    one = per_pga(record_measures(harmonic(0.1), 0.27, 0.05, p))
    other = per_pga(record_measures(harmonic(0.7), 0.27, 0.05, p))
    assert set(one) == set(MEASURES)
    for name, value in one.items():
        assert other[name] == pytest.approx(value, rel=1e-9), name
    assert one["pga_g"] == 1.0


def test_spectrum_intensity_of_a_slow_step_is_that_of_a_plateau():
    """A constant acceleration from rest: Sd = 2a/ω² undamped, so PSV = 2aT/2π; less by damping."""
    record = Record("step", np.full(4000, 1.0), 0.005, "surrogate")
    decay = 1.0 + np.exp(-np.pi * 0.05 / np.sqrt(1 - 0.05**2))  # first overshoot at 5 %
    expected = np.trapezoid(decay * HOUSNER_S / (2 * np.pi), HOUSNER_S)
    found = record_measures(record, 0.27, 0.05, 1.5)["housner_cm"]
    assert found == pytest.approx(100 * expected, rel=0.01)


def test_average_acceleration_after_a_blow_is_the_geometric_mean():
    """A blow of velocity v: PSA = f(ζ) 2πv/T, so AvgSa has the geometric mean of its periods."""
    values, dt_s, zeta = np.zeros(8000), 0.001, 0.05
    values[2] = 10.0
    speed, root = 10.0 * dt_s, np.sqrt(1.0 - zeta**2)
    peak = np.exp(-zeta / root * np.arctan(root / zeta))  # of ω u over v
    found = record_measures(Record("blow", values, dt_s, "surrogate"), 1.0, zeta, 1.5)
    periods = np.linspace(0.2, 3.0, 10)
    expected = peak * 2.0 * np.pi * speed / np.exp(np.mean(np.log(periods))) / 9.80665
    assert found["sa_avg_g"] == pytest.approx(expected, rel=5e-3)


def test_incremental_velocity_takes_the_largest_lobe_exactly():
    # triangles between the zeros: 1/2·1·1, −1/2·2·2 (its zeros half way between samples), 1/2
    a = np.array([0.0, 1.0, 0.0, -1.0, -2.0, -1.0, 1.0, 0.0])
    lobe = 0.5 * 1 + 1.5 + 1.5 + 0.5 * 0.5 * 1
    assert incremental_velocity(a, 1.0) == pytest.approx(lobe)
    assert incremental_velocity(-a, 0.5) == pytest.approx(0.5 * lobe)


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
