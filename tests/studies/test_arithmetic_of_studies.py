"""Arithmetic of studies by hand: what is run where, over what, and what stands in the table."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from rocking.formula import classes, fit, groups, law
from rocking.records import Record
from rocking.studies import (
    base_compliance,
    claims,
    limits,
    predictions,
    strengthening,
    two_components,
)

GABLES = Path(__file__).resolve().parents[2] / "config" / "predictions" / "gables"


class TwoComponents(two_components.Comparison):
    """A façade that falls from stated amplitudes on, alone, in the repetition and under both."""

    def __init__(self, alone_g, again_g, both_g):
        self.falls = {False: alone_g, True: again_g}
        self.settings = {"level_ratio": 0.05, "start_ratio": 0.8}
        self.start_g, self.max_g, self.asked = 0.05, 1.0, []
        self.yade = SimpleNamespace(run=self.run)
        self.both_g = both_g

    def one(self, pga_g, again=False):
        return 1.0 if pga_g >= self.falls[again] else 0.1 * pga_g

    def run(self, pga_g):
        pga_g = np.asarray(pga_g)
        self.asked.append(pga_g.tolist())
        status = np.where(pga_g >= self.both_g, "overturned", "ok")
        table = {"status": status, "d_over_b": 0.2 * pga_g, "twist_rad": pga_g, "slid_m": -pga_g}
        return pd.DataFrame(table)


def test_both_components_are_compared_at_half_the_planar_collapse_and_at_the_last_that_stood():
    trial = TwoComponents(0.30, 0.32, 0.20)
    found = dict(zip(two_components.FOUND, trial.compare(), strict=True))
    levels = 0.05 * 1.05 ** np.arange(62)
    first = {g: levels[levels >= g][0] for g in (0.30, 0.32, 0.20)}
    assert found["one_g"] == pytest.approx(first[0.30])
    assert found["again_g"] == pytest.approx(first[0.32])
    assert found["two_g"] == pytest.approx(first[0.20])
    assert found["half_g"] == pytest.approx(0.5 * first[0.30])
    assert found["d_one"] == pytest.approx(0.1 * found["half_g"])
    assert found["d_two"] == pytest.approx(0.2 * found["half_g"])
    assert found["twist_rad"] == pytest.approx(found["half_g"])
    assert found["last_g"] == pytest.approx(levels[levels < 0.20][-1])
    assert found["last_slid_m"] == pytest.approx(-found["last_g"])


def test_a_facade_that_never_falls_is_compared_at_half_the_largest_level():
    found = dict(zip(two_components.FOUND, TwoComponents(9.0, 9.0, 9.0).compare(), strict=True))
    assert np.isnan([found[name] for name in ("one_g", "again_g", "two_g")]).all()
    assert 0.5 <= found["half_g"] < 0.5 * 1.05
    assert found["last_g"] == pytest.approx(2.0 * found["half_g"])


def test_the_second_ratio_is_of_the_peak_along_the_facade_to_that_out_of_plane(monkeypatch):
    own = SimpleNamespace(floors=(None, {"ground": np.array([0.1, -0.4])}), name="A")
    second = SimpleNamespace(floors=(None, {"ground": np.array([-0.3, 0.2])}), name="B")
    own.varied = lambda variant: own
    case = SimpleNamespace(model="W1", varied=lambda variant: case)
    values = SimpleNamespace(compare=lambda: range(len(two_components.FOUND)))
    monkeypatch.setattr(two_components, "Comparison", lambda *given: values)
    (row,) = two_components.collapse([case], own, ["pos"], second, {}).to_dict("records")
    assert row["second_ratio"] == pytest.approx(0.75)
    assert (row["second"], row["model"], row["direction"]) == ("B", "W1", "pos")


def test_ratios_of_both_components_are_over_those_of_one():
    table = pd.DataFrame({"model": ["W1"], "one_g": [0.4], "two_g": [0.3], "again_g": [0.42]})
    found = two_components.summary(table.assign(d_one=0.2, d_two=0.25)).set_index("compared")
    medians = found["median"].to_dict()
    assert medians == pytest.approx(
        {"both components": 0.75, "repetition": 1.05, "d/b at half": 0.8}
    )


def test_of_equal_forces_the_highest_row_is_the_best():
    table = pd.DataFrame({"height_m": [2.0, 4.0, 6.0, 8.0], "force_kn": [5.0, 3.0, 3.0, np.nan]})
    assert strengthening.best(table)["height_m"] == 6.0
    assert strengthening.best(table[::-1])["height_m"] == 6.0
    assert strengthening.best(table[table["height_m"] == 8.0]) is None


def test_the_chosen_stack_is_run_again_at_half_the_step_of_courses(monkeypatch):
    asked = []

    def collapses(cases, motion, directions, find, variants):
        asked.append((find, [variant.about["facade"] for variant in variants]))
        return [{"facade": variant.about["facade"], **ROW_OF_CURVE} for variant in variants]

    monkeypatch.setattr(base_compliance, "collapses", collapses)
    table = base_compliance.of_wall("own", None, None, "pos")
    (_, names), (half, again) = asked
    assert base_compliance.CHOICE in names
    assert again == [base_compliance.HALF]
    assert half.keywords == {"step": 0.5 * base_compliance.COURSES_STEP}
    assert half.func is base_compliance.costed
    assert table["facade"].tolist() == [*names, base_compliance.HALF]
    assert (table["wall"] == "own").all()


ROW_OF_CURVE = {"pga_median_g": 0.2, **dict.fromkeys(base_compliance.ENDS, 0.2)}


def test_a_gable_s_motions_are_scaled_to_the_stated_pga_at_its_foot(monkeypatch):
    """What the solver is given times its factor has the stated peak, whatever the record has."""
    seen = []

    def peaks(plane, motion, numerics, size, **_):
        seen.append(np.asarray(size))
        return SimpleNamespace(overturned=np.asarray(size) * 0.0 + 1.0 > 0.0)

    feet = []

    def driving(scene, t, columns):
        feet.append(np.abs(columns["ground"]).max())
        return columns

    signs, loaded = iter((1.0, -1.0)), predictions.load

    def load(name, table):
        found, sign = loaded(name, table), next(signs)
        peak = found.acceleration_m_s2[np.abs(found.acceleration_m_s2).argmax()]
        return replace(found, acceleration_m_s2=sign * np.sign(peak) * found.acceleration_m_s2)

    monkeypatch.setattr(predictions, "load", load)  # one with its peak either way
    monkeypatch.setattr(predictions, "peaks", peaks)
    monkeypatch.setattr(predictions, "driving", driving)
    specimen, _ = predictions.read(GABLES)
    specimen = {**specimen, "records": specimen["records"][:2], "phase_deg": [0.0]}
    specimen |= {"amplification": [2.0], "variants": dict(list(specimen["variants"].items())[:1])}
    table = predictions.foot_and_top(specimen, pd.DataFrame(), GABLES, False, 1)
    assert len(seen) == 2
    for foot, size in zip(feet, seen, strict=True):
        assert foot * size / 9.80665 == pytest.approx(specimen["pga_g"], rel=1e-9)
    assert table["pga_g"].tolist() == specimen["pga_g"]
    assert (table["probability"] == 1.0).all()


def scattered(seed=5, facades=9, stations=8):
    """Values of façades under two motions a station: a law without terms, and its scatter."""
    rng = np.random.default_rng(seed)
    level = np.repeat(rng.normal(0.0, 0.4, stations), 2)
    names = [f"S{k // 2}" for k in range(2 * stations)]
    own = rng.normal(0.0, 0.1, facades)[:, None]
    return own + level, names


def test_an_interval_leaves_five_per_cent_on_either_side():
    """Of a mean over stations drawn again: ± 1.645 σ/√n, where the façades are alike."""
    values, names = scattered()
    values = values - values.mean(axis=1, keepdims=True)
    low, high = fit.intervals(np.ones((len(values), 1)), values, names, 1)
    error = values[0, ::2].std() / np.sqrt(8)
    assert low[0] == pytest.approx(-1.645 * error, rel=0.15)
    assert high[0] == pytest.approx(1.645 * error, rel=0.15)


def test_the_error_has_that_of_the_facades_and_that_of_as_many_stations_as_there_are(monkeypatch):
    """A motion more of a station that is there already tells nothing new of the level."""
    values, names = scattered()
    columns = pd.MultiIndex.from_tuples(
        [(f"r{k}", "pos") for k in range(len(names))], names=["record", "direction"]
    )
    wide = pd.DataFrame(values, columns=columns)
    stations_of = dict(zip(columns.get_level_values(0), names, strict=True))
    monkeypatch.setattr(fit, "wide", lambda *given: wide)
    monkeypatch.setattr(fit, "matrix", lambda design, terms: np.ones((len(design), 1)))
    monkeypatch.setitem(fit.TERMS, "W1", ("1",))
    design = pd.DataFrame(index=wide.index)
    found = fit.fitted(None, design, "W1", "own", "pga_g", None, stations_of, 1)
    spread = np.sqrt(np.mean(np.var(values, axis=1, ddof=1)))
    assert found["dispersion"] == pytest.approx(spread, abs=1e-4)
    # a façade against the mean of the others: its own deviation times n/(n − 1)
    means = values.mean(axis=1)
    alone = (means - means.mean()) * len(means) / (len(means) - 1)
    rms = np.sqrt(np.mean(alone**2))
    assert found["checks"]["facades_rms"] == pytest.approx(rms, abs=1e-4)
    assert found["error"] == pytest.approx(np.hypot(rms, spread / np.sqrt(8)), abs=2e-4)
    assert found["checks"]["stations"] == 8
    assert found["checks"]["motions"] == 16


def test_a_class_is_refused_by_the_weight_that_lies_outside_and_not_by_the_number(monkeypatch):
    """One of three outside: refused with 60 % of the weight, left out and counted with 4 %."""

    def said(row, *_):
        if row["period_s"] > 1.0:
            raise groups.OutsideError("outside")
        return 0.3, 0.2, 0.1

    monkeypatch.setattr(law, "said", said)
    rows = pd.DataFrame({name: [0.5, 0.5, 0.5] for name in groups.DIMENSIONS})
    rows["period_s"] = [0.3, 2.0, 0.3]
    share = classes.OUTSIDE
    for outside, refused in ((0.6, True), (share + 1e-3, True), (share - 1e-3, False)):
        inside = 0.5 * (1.0 - outside)
        weighted = rows.assign(weight=7.0 * np.array([inside, outside, inside]))
        if refused:
            with pytest.raises(groups.OutsideError, match=f"{100 * outside:.0f} % of it"):
                classes.fragility(weighted, "W1")
        else:
            found = classes.fragility(weighted, "W1")
            assert (found["n"], found["n_outside"]) == (2, 1)
            assert found["median"] == pytest.approx(0.3)


def test_limits_of_the_formula_are_the_stated_ends_or_those_that_came_out(monkeypatch):
    monkeypatch.setattr(fit, "fitted", lambda *given: "fitted")
    values = np.array([0.2, 0.5, 0.3])
    design = pd.DataFrame({name: values + k for k, name in enumerate(groups.DIMENSIONS)})
    table = pd.DataFrame({"base": "own", "facade": design.index[:3], "model": "W1"})
    stated = groups.DIMENSIONS[0]
    made_of = {"seed": 1, "ranges": {stated: [0.1, 0.9]}}
    found = fit.law(table, design, {}, {}, made_of)
    assert found["limits"][stated] == [0.1, 0.9]
    for k, name in enumerate(groups.DIMENSIONS[1:], 1):
        assert found["limits"][name] == pytest.approx([0.2 + k, 0.5 + k])
    assert found["made_of"]["facades"] == 3
    assert list(found["models"]) == ["W1"]


def test_what_a_bond_buys_is_said_of_both_pairs_of_models():
    capacity = pd.DataFrame({"W1": [0.2, 0.4], "W1c": [0.3, 0.6], "W2": [0.2, 0.2]})
    text, holds = claims._no_help(capacity.assign(W2c=[0.22, 0.2]))
    assert text == "W2c/W2 1.00 to 1.10, median 1.05; W1c/W1 median 1.50"
    assert holds == (claims.HELP > 1.05)
    assert claims._no_help(capacity) is None


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_run_s_own_pga_is_that_of_its_foot_whichever_way_it_goes(monkeypatch, sign):
    foot = sign * np.array([0.0, 3.0, -1.0, 0.0])
    motion = 0.01 * np.arange(4), foot, foot
    answer = SimpleNamespace(overturned=np.array([True]))
    monkeypatch.setattr(predictions, "foot_and_top_files", lambda *given: motion)
    monkeypatch.setattr(predictions, "driving", lambda *given: None)
    monkeypatch.setattr(predictions, "peaks", lambda *given: answer)
    specimen, _ = predictions.read(GABLES)
    specimen = {**specimen, "amplification": []}
    runs = pd.DataFrame({"run": [1], "foot": ["a"], "top": ["b"]})
    table = predictions.foot_and_top(specimen, runs, GABLES, False, 1)
    assert table["pga_g"].to_numpy() == pytest.approx(3.0 / 9.80665)
    assert (table["probability"] == 1.0).all()


@pytest.mark.parametrize(("third", "holds"), [(0.5, True), (0.7, False)])
def test_a_comparison_holds_only_where_it_does_in_every_case(third, holds):
    index = ["A+", "A-", "B+"]
    first, second = [0.2, 0.3, third], [0.4, 0.5, 0.6]
    capacity = pd.DataFrame({"W2": first, "W1": second}, index=index)
    width = bound = pd.DataFrame(0.0, index=index, columns=["W1", "W2"])
    text, said = claims._compare((capacity, width, bound), "W2", "W1", "<")
    assert said is holds
    assert f"as claimed in {2 + holds} of 3" in text
    assert ("not in B+" in text) is not holds
    turned, said = claims._compare((capacity, width, bound), "W1", "W2", ">")
    assert said is holds


def test_a_scan_is_too_costly_by_its_steps_and_not_below_the_limit(monkeypatch):
    """So many runs of so many steps to the motion's end, at a stated cost of each."""
    t = 0.01 * np.arange(300)
    record = Record("burst", np.sin(6.0 * t) * np.exp(-((t - 1.0) ** 2)), 0.01, "file")
    monkeypatch.setattr(limits, "LIMIT_S", 0.0)
    found = limits.verdict_of("W1", {}, record, "pos")
    assert found["verdict"] == "too costly"
    duration_s = found["steps"] * found["step_s"]
    assert duration_s >= 3.0 - 0.01
    scan_s = limits.SCAN_RUNS * found["steps"] * limits.STEP_COST_S
    assert f"some {scan_s / 3600.0:.1f} h" in found["why"]
    monkeypatch.setattr(limits, "STEP_COST_S", 3600.0 / limits.SCAN_RUNS)
    again = limits.verdict_of("W1", {}, record, "pos")
    assert f"some {found['steps']:.1f} h" in again["why"]
    seen = []
    monkeypatch.setattr(limits, "LIMIT_S", 3600.0 * found["steps"])
    monkeypatch.setattr(limits.search, "climb", lambda *given: seen.append(given) or 1 / 0)
    with pytest.raises(ZeroDivisionError):  # at the limit itself it goes on to search
        limits.verdict_of("W1", {}, record, "pos")
    assert len(seen) == 1
