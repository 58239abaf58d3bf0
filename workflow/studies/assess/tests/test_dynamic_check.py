"""The code's dynamic check: choice of motions, and the verdict by its rule."""

import math

import numpy as np
import pandas as pd
import pytest
from rocking import Motion
from studies.assess import dynamic_check
from studies.assess.dynamic_check import Limits, limits_of, verdict
from studies.assess.family import Family
from studies.assess.selection import Selection, choose, periods
from study_cases import study_case, study_settings

PERIODS = periods(0.15, 3.0)
LIMITS = Limits(0.40, 0.16, 0.24)


def candidates(count=40, seed=1):
    """Spectra that scatter about 1/T by smooth bumps, two components a station."""
    rng = np.random.default_rng(seed)
    x = np.log(PERIODS)
    bumps = rng.normal(0.0, 0.4, (count, 6))
    shapes = np.array([np.cos(k * np.pi * (x - x[0]) / (x[-1] - x[0])) for k in range(6)])
    scale = rng.uniform(0.2, 2.0, count)
    return scale[:, None] * np.exp(bumps @ shapes) / PERIODS


def test_the_mean_of_the_chosen_fits_and_factors_stay_in_bounds():
    spectra = candidates()
    names = [f"m{i}" for i in range(40)]
    stations = [f"s{i // 2}" for i in range(40)]
    found = choose(names, stations, spectra, PERIODS, 0.3 / PERIODS, 11, (0.25, 4.0))
    assert found.fits
    deviations = found.mean_g / found.target_g - 1.0
    assert -0.10 <= deviations.min() <= 0.0 <= deviations.max() <= 0.30
    assert len(set(found.names)) == 11
    of = dict(zip(names, stations, strict=True))
    assert len({of[name] for name in found.names}) == 11  # one component a station
    assert found.factors.min() >= 0.25
    assert found.factors.max() <= 4.0
    mean = np.mean(
        [f * spectra[names.index(n)] for f, n in zip(found.factors, found.names, strict=True)],
        axis=0,
    )
    assert found.mean_g == pytest.approx(mean, rel=1e-12)
    again = choose(names, stations, spectra, PERIODS, 0.3 / PERIODS, 11, (0.25, 4.0))
    assert again.names == found.names


def test_a_target_out_of_the_bounds_reach_is_said_not_to_fit():
    found = choose(
        [f"m{i}" for i in range(20)],
        [f"s{i}" for i in range(20)],
        candidates(20),
        PERIODS,
        1e-3 / PERIODS,
        11,
        (0.25, 4.0),
    )
    assert not found.fits


@pytest.mark.parametrize(
    ("share", "fits"), [(0.89, False), (0.91, True), (1.0, True), (1.29, True), (1.31, False)]
)
def test_no_period_may_lie_a_tenth_below_or_three_tenths_above(share, fits):
    """NTC 2018, 3.2.3.6: one period out of forty is enough to be refused."""
    target = 0.3 / PERIODS
    mean = target.copy()
    mean[7] *= share
    assert Selection(["m"], np.ones(1), PERIODS, target, mean).fits == fits


def test_too_few_stations_are_refused():
    with pytest.raises(ValueError, match="3 stations; expected at least"):
        choose(list("abc"), list("abc"), candidates(3), PERIODS, 0.3 / PERIODS, 7, (0.25, 4.0))


def table(d_m, realisations=None, fallen=()):
    """Histories: one row a motion, or realisations beside it."""
    rows = []
    for i, own in enumerate(d_m):
        for k, d in enumerate([own, *(realisations[i] if realisations else ())]):
            status = "overturned" if (i, k) in fallen else "ok"
            rows.append(("W2", f"m{i}", "pos", k, 0.2, d / 0.41, d, status))
    names = ["model", "record", "direction", "realisation", "pga_g", "d_over_b", "d_m", "status"]
    return pd.DataFrame(rows, columns=names)


def test_the_mean_decides_where_none_exceeds():
    """Mean of 0.10, 0.15, 0.20 is 0.15 ≤ d_SLV = 0.16; with 0.26 for the last 0.17 > 0.16."""
    held = verdict(table([0.10, 0.15, 0.20]), LIMITS, 1)
    assert held["slv"]
    assert held["mean_d_m"] == pytest.approx(0.15)
    assert held["worst"] == "m2"
    assert held["nearest"] == "m1"
    lost = verdict(table([0.10, 0.15, 0.26]), LIMITS, 1)
    assert not lost["slv"]
    assert lost["slc"]
    assert lost["agree"] == 1.0


def test_what_a_link_that_breaks_early_leaves_out_is_told_beside():
    """Mean 0.15: beyond the 0.01 at which the link breaks, within 0.16 without it."""
    early = LIMITS._replace(slv_m=0.01, bare_m=LIMITS.slv_m)
    said = verdict(table([0.10, 0.15, 0.20]), early, 1)
    assert (said["slv"], said["slv_bare"]) == (False, 1.0)
    assert verdict(table([0.10, 0.15, 0.26]), early, 1)["slv_bare"] == 0.0
    assert math.isnan(verdict(table([0.10, 0.15, 0.20]), LIMITS, 1)["slv_bare"])


def test_one_history_beyond_d0_is_enough():
    """Mean 0.14 would do, but the third exceeds 0.40, or has fallen."""
    assert not verdict(table([0.01, 0.01, 0.405]), LIMITS, 1)["slv"]
    found = verdict(table([0.01, 0.01, 0.02], fallen={(2, 0)}), LIMITS, 1)
    assert not found["slv"]
    assert found["exceed_d0"] == 1


def test_realisations_tell_what_hangs_on_the_numerics():
    """Of two motions one falls in one of four realisations: a quarter of the draws disagrees."""
    realisations = [[0.05, 0.05, 0.05], [0.10, 0.11, 0.41]]
    found = verdict(table([0.05, 0.10], realisations, fallen={(1, 3)}), LIMITS, 1)
    assert found["slv"]
    assert found["agree"] == pytest.approx(0.75, abs=0.03)


@pytest.mark.parametrize(
    ("own", "again", "wanted"),
    [
        ({"m1": 0.5, "m2": 0.5}, {"m1": 0.3}, ["m1", "m2"]),  # m1 does not always, m2 does
        ({"m1": 0.5}, {"m1": 0.3}, ["m1", "m0", "m2"]),
        ({}, {}, ["m0", "m1", "m2"]),
    ],
)
def test_a_motion_that_always_exceeds_d0_settles_what_all_realisations_would_say(
    monkeypatch, own, again, wanted
):
    """The verdict's agreement is that of all realisations of all motions, to the last draw."""
    d = {name: own.get(name, 0.13) for name in ("m0", "m1", "m2")}
    limits, asked = Limits(0.40, 0.16, 0.24), []

    def rows(name, values, first):
        found = table([0.0] * len(values)).assign(record=name, d_m=values)
        return found.assign(realisation=np.arange(first, first + len(values)))

    def run(job, turns, fraction=None, realisations=0):
        names = [name for (name, _), _ in turns]
        if not realisations:
            return [rows(name, [d[name]], 0) for name in names]
        asked.extend(names)
        last = [again.get(name, d[name]) for name in names]
        every = [[d[n]] * (realisations - 1) + [end] for n, end in zip(names, last, strict=True)]
        return [rows(name, values, 1) for name, values in zip(names, every, strict=True)]

    monkeypatch.setattr(dynamic_check, "histories", run)
    found = dynamic_check.checked({}, [(name, 0.2) for name in d], ["pos"], limits, 5)
    assert asked == wanted
    others = [((name, 0.2), "pos") for name in d if name not in asked]
    every = pd.concat([found, *run({}, others, realisations=5)])
    said, full = verdict(found, limits, 1), verdict(every, limits, 1)
    for key in ("slv", "slc", "exceed_d0", "mean_d_m", "agree"):
        assert said[key] == full[key]


def test_a_failed_history_is_no_collapse():
    rows = table([0.05, 0.10, 0.15])
    rows.loc[1, ["d_m", "status"]] = [np.nan, "failed"]
    found = verdict(rows, LIMITS, 1)
    assert found["failed"] == 1
    assert found["motions"] == 2
    assert found["slv"]


def test_limits_are_those_of_the_facades_top():
    """h = 6, b = 0.6: d0 = 6 sin(atan 0.1) = 0.597, d_SLV = 0.4 of it, d_SLC = 0.6."""
    plain = {"height_m": 6.0, "thickness_m": 0.6, "width_m": 4.4, "density_kg_m3": 1800.0}
    whole = Family(study_settings({"facade": plain})).part(0.0, "whole")
    found = limits_of(whole.mechanism)
    assert found[:3] == pytest.approx((0.5970, 0.2388, 0.3582), rel=1e-3)


def test_displacements_of_a_wall_that_leans_count_from_where_it_stands():
    """As d_SLV and d0 do: what hardly shakes moves it by nothing, and d/b has its lean."""
    facade = {"facade.height_m": 5.0, "facade.thickness_m": 0.4, "facade.tilt_deg": 0.5}
    case = study_case("W1", {**facade, "facade.courses": 4})
    lean_m = 5.0 * math.sin(math.radians(0.5))
    assert dynamic_check.leans_by(case["facade"]) == pytest.approx(lean_m, rel=1e-3)
    motion = Motion.sampled(1e-3 * np.sin(np.arange(0.0, 2.0, 0.01)), 0.01, name="hardly")
    (found,) = dynamic_check.histories(case.sections, [((motion, 1e-4), "pos")])
    assert 0.0 < found["d_m"].item() < 0.05 * lean_m
    assert 0.4 * found["d_over_b"].item() == pytest.approx(lean_m, rel=0.05)
