"""Histories end where what is left of a motion no longer tells; brief curves begin late too."""

import dataclasses

import numpy as np
import pytest
from rocking import Motion
from rocking.collapse import scan
from rocking.collapse.building import DRIFT, FELL
from rocking.collapse.curve import collapse_curves, run_by
from rocking.collapse.scan import together
from rocking.solver import runs
from rocking.solver.motions import Motions
from study_cases import study_case

DAMPING = {"law": "value", "beta_s": 2e-3}
BUILDING = {"return_wall": {"building_mass_kg": 77000.0}}
DT = 0.01


def pulses(second, late_s=20.0, coda=0.02):
    """Ground motion [m/s²]: a pulse at 1 s, another so many times as high, and a coda to 60 s."""
    t = np.arange(0.0, 60.0, DT)

    def pulse(begin):
        own = (t >= begin) & (t < begin + 0.8)
        return np.where(own, np.sin(2.0 * np.pi * (t - begin) / 0.8), 0.0)

    a = pulse(1.0) + second * pulse(late_s) + coda * np.sin(2.0 * np.pi * 1.3 * t)
    return Motion.sampled(a, DT, "m/s2", name="two")


def late(quiet_s=10.0, size=0.004):
    """A pulse of 1 m/s² after seconds of a motion as small as stated; no coda."""
    t = np.arange(0.0, quiet_s + 12.0, DT)
    own = (t >= quiet_s) & (t < quiet_s + 0.8)
    before = np.where(t < quiet_s, size * np.cos(2.0 * np.pi * 1.3 * t), 0.0)
    a = np.where(own, np.sin(2.0 * np.pi * (t - quiet_s) / 0.8), before)
    return Motion.sampled(a, DT, "m/s2", name="late")


def whole_motions(screen):
    """The screen, whose histories go on to the end of their motions."""
    for one in filter(None, (screen, screen.carrying)):
        one.numerics = {**one.numerics, "brief": None}
    return screen


def outcomes(model, motion, whole, levels=(0.05, 0.1, 0.2, 0.3, 0.5), **building):
    case = study_case(model, {"damping": DAMPING, **BUILDING, "smdof": building})
    screen = run_by("planar", case, motion, "pos")
    screen = whole_motions(screen) if whole else screen
    (table,) = together([(screen, np.array(levels), False)])
    (motions, *_), factors = screen.shaking(levels)
    ends = runs.limits(screen.planes[0], motions, screen.numerics, factors, screen.steps_s[0])
    return table, ends[:, 3] * screen.steps_s[0]


@pytest.mark.parametrize("model", ["W1", "W2", "W2m"])
@pytest.mark.parametrize("second", [0.0, 0.5, 1.4])
def test_outcomes_are_those_of_whole_histories_also_of_a_later_pulse(model, second):
    whole, last_s = outcomes(model, pulses(second), True)
    brief, end_s = outcomes(model, pulses(second), False)
    assert list(brief["status"]) == list(whole["status"])
    stood = (whole["status"] == "ok").to_numpy()
    assert stood.any()
    np.testing.assert_array_equal(brief["d_over_b"][stood], whole["d_over_b"][stood])
    assert np.all(last_s > 60.0)
    assert np.all(end_s < (30.0 if second else 12.0))
    assert np.all(end_s > (20.8 if second else 1.8))


@pytest.mark.parametrize("loops", ["bilinear", "peak_oriented"])
@pytest.mark.parametrize("model", ["W2", "W2m"])
def test_behind_a_building_that_yields_outcomes_are_those_of_whole_histories(model, loops):
    """The second pulse makes it yield; W1 has no building and ends as soon as ever."""
    strength = {"base_shear_ratio": 0.1, "loops": loops}
    whole, _ = outcomes(model, pulses(1.4), True, **strength)
    brief, end_s = outcomes(model, pulses(1.4), False, **strength)
    assert list(brief["status"]) == list(whole["status"])
    stood = (whole["status"] == "ok").to_numpy()
    np.testing.assert_array_equal(brief["d_over_b"][stood], whole["d_over_b"][stood])
    assert np.all(end_s < 40.0)
    elastic = outcomes(model, pulses(1.4), False, base_shear_ratio=None)[1]
    assert np.all(end_s >= elastic + 2.9)
    assert np.all(outcomes("W1", pulses(0.0), False, **strength)[1] < 12.0)


@pytest.mark.parametrize("model", ["W1", "W2", "W2m"])
def test_what_comes_before_a_motion_is_left_out_of_curves_and_tells_nothing(model, monkeypatch):
    """Ten quiet seconds; the pulse exceeds half a per cent within its first sample."""
    case = study_case(model, {"damping": DAMPING, **BUILDING})
    how = {"search": "list", "settings": {"pga_g": np.geomspace(0.03, 0.6, 12)}}
    ends, peaks = [], scan.peaks

    def watched(*given, **more):
        found = peaks(*given, **more)
        ends.extend(found.end_s)
        return found

    monkeypatch.setattr(scan, "peaks", watched)
    tables = []
    for motion, brief in ((late(), False), (late(), True), (late(size=0.006), True)):
        ends.clear()
        (curve,) = collapse_curves(case, [(motion, "pos")], brief=brief, **how)
        tables.append((curve.table, max(ends)))
    (whole, _), (brief, end_s), (_, later_s) = tables
    assert {"ok", "overturned"} <= set(whole["status"])
    assert list(brief["status"]) == list(whole["status"])
    stood = (whole["status"] == "ok").to_numpy()
    found, wanted = (table["d_over_b"][stood].to_numpy() for table in (brief, whole))
    assert found == pytest.approx(wanted, rel=0.02)
    assert later_s - end_s == pytest.approx(10.0, abs=1.5)


def test_a_motion_begins_where_any_component_does_and_keeps_its_peak():
    whole = late()
    cut = whole.begun
    assert len(whole.record) - len(cut.record) == pytest.approx(10.0 / DT, abs=1)
    assert np.abs(cut.record.acceleration_m_s2).max() == 1.0
    up = np.zeros(len(whole.record))
    up[300] = -0.5
    both = Motion(dataclasses.replace(whole.record, vertical_m_s2=up)).begun.record
    assert len(both) == len(both.vertical_m_s2) == len(whole.record) - 299
    assert both.vertical_m_s2[1] == -0.5
    floors = Motion(floors=(whole.record.time_s, {"ground": whole.record.acceleration_m_s2}))
    assert floors.begun is floors
    after = dataclasses.replace(whole, first=whole, first_pga_g=0.1)
    assert after.begun is after


def test_a_brief_curve_asks_nothing_of_the_building_alone():
    """Its storeys' drifts take a seventh of such curves' time, and a climb reads none of them."""
    case = study_case("W2", {"damping": DAMPING, **BUILDING, "smdof": {"base_shear_ratio": 0.2}})
    how = {"search": "list", "settings": {"pga_g": [0.1, 0.2]}, "fraction": 0.3}
    (whole,) = collapse_curves(case, [(pulses(0.5), "pos")], **how)
    (brief,) = collapse_curves(case, [(pulses(0.5), "pos")], brief=True, **how)
    assert {DRIFT, FELL} <= set(whole.table)
    assert not {DRIFT, FELL} & set(brief.table)
    assert list(brief.table["status"]) == list(whole.table["status"])


def test_a_history_goes_on_while_what_carries_the_supports_still_moves():
    """By the ground alone it would end 3 s after 1 s; its floor shakes on to 9 s."""
    t = np.arange(0.0, 20.0, DT)
    ground = np.where(t <= 1.0, np.sin(2.0 * np.pi * t), 0.0)
    floor = np.where(t <= 9.0, 2.0 * np.sin(2.0 * np.pi * t), 0.0)
    case = study_case("W1", {"damping": DAMPING})
    plane = run_by("planar", case, pulses(0.0), "pos").planes[0]
    numerics = {**case["numerics"], "brief": runs.Brief()}
    given = numerics, np.array([3.0]), 1e-3
    alone = runs.limits(plane, Motions(t, ground), *given)[0, 3]
    carried = runs.limits(plane, Motions(t, ground, (), None, [floor]), *given)[0, 3]
    assert 1e-3 * alone == pytest.approx(4.0, abs=0.1)
    assert 1e-3 * carried == pytest.approx(12.0, abs=0.1)


def test_a_history_with_its_series_goes_on_to_the_end_of_its_motion():
    """What is left of a façade after a first shock is read from its last sample."""
    screen = run_by("planar", study_case("W1", {"damping": DAMPING}), pulses(0.0, coda=0.1), "pos")
    (motions,), (factor,) = screen.shaking([0.08])
    series = runs.history(screen.planes[0], motions, screen.numerics, factor)
    assert series.time_s[-1] > 60.0
    ended = screen.run([0.08], False)["d_over_b"].iloc[0]
    assert series.peak_d_over_b == pytest.approx(ended, rel=1e-12)


def test_what_is_far_from_rest_at_its_end_is_run_as_a_whole(monkeypatch):
    """Cut half a second after a pulse that all but fells it, the façade is still out."""
    monkeypatch.setattr(scan, "Brief", lambda: runs.Brief(after_s=0.5))
    levels = np.geomspace(0.04, 0.4, 32)
    whole, _ = outcomes("W1", pulses(0.0, coda=0.0), True, levels)
    brief, _ = outcomes("W1", pulses(0.0, coda=0.0), False, levels)
    assert {"ok", "overturned"} <= set(whole["status"])
    assert list(brief["status"]) == list(whole["status"])
    monkeypatch.setattr(scan, "Brief", lambda: runs.Brief(after_s=0.5, still=np.inf, swings=np.inf))
    cut, _ = outcomes("W1", pulses(0.0, coda=0.0), False, levels)
    assert list(cut["status"]) != list(whole["status"])  # what the rule is there for


def test_what_swings_with_more_than_half_of_its_peak_at_its_end_is_run_as_a_whole():
    """The largest |d|/b of three seconds, of 2.5 that were run; what fell or failed is done."""
    spans = np.array(
        [
            [0.30, 0.16, 0.14],  # more than half of 0.30 in one of the last two seconds
            [0.30, 0.14, 0.14],  # less
            [0.12, 0.05, 0.07],  # more, of a smaller one
            [0.04, 0.03, 0.03],  # small
            [0.90, 0.24, 0.26],  # beyond a quarter
            [0.90, 0.24, 0.26],
            [0.90, 0.24, 0.26],
        ]
    )
    fell, failed = np.arange(7) == 5, np.arange(7) == 6
    ends = np.full(7, 2.5)
    found = runs.Peaks(np.ones(7), spans.max(axis=1), fell, failed, ends, 0.01, spans)
    expected = [True, False, True, False, True, False, False]
    assert list(runs._lingers(found, runs.Brief())) == expected
    assert list(runs._lingers(found, runs.Brief(swings=0.2)))[:4] == [False] * 4
