"""The least tie under a run's motions: what is tried, what is kept, what is said of the cost."""

import itertools
import math

import numpy as np
import pandas as pd
import pytest
from both_solvers import BETA_S, FEW
from rocking import Case, Motion
from rocking.collapse import curve as curves
from rocking.collapse.additions import planar_models
from rocking.collapse.curve import WHERE
from rocking.configuration.config import ConfigError
from scipy.stats import binomtest
from studies.assess import strengthening
from study_cases import study_case, study_settings
from yade_process import resolved

from yade_scripts.model.facade import facade_scene

G = 9.80665


def tied(*rows, model="W1", **sections):
    """Configuration and scene of a façade with ties."""
    facade = {**sections.pop("facade", {}), "ties": list(rows)}
    config = resolved(facade=facade, **sections)
    return config, facade_scene(config, model, BETA_S)


def searched(shares, n=61):
    """Table of a search at two heights, by shares of realisations that fell."""
    rows = []
    for height, column in shares.items():
        for k, share in enumerate(column):
            band = binomtest(round(share * n), n).proportion_ci(0.95, "wilson")
            rows.append((height, 10.0 * k, round(share * n), n, share, band.low, band.high))
    names = ["height_m", "force_kn", "fell", "realisations", "probability", "low", "high"]
    return pd.DataFrame(rows, columns=names)


def test_the_least_tie_is_the_weakest_from_which_all_hold():
    """An range of collapse above a force that holds counts; so does a height that never holds."""
    table = searched({3.0: [1.0, 0.0, 0.5, 0.05, 0.0, 0.0], 6.0: [1.0, 1.0, 1.0, 1.0, 1.0, 0.9]})
    found = strengthening.least(table, 0.1).set_index("height_m")
    assert found.loc[3.0, "force_kn"] == 30.0
    assert found.loc[3.0, "force_low_kn"] == 30.0
    assert found.loc[3.0, "force_high_kn"] == 40.0  # 3 of 61: up to 0.14 with 95 %
    assert np.isnan(found.loc[6.0, "force_kn"])
    choice = strengthening.best(strengthening.least(table, 0.1))
    assert strengthening.weakest(table, choice) == [(3.0, 20.0), (3.0, 30.0)]
    assert strengthening.best(strengthening.least(table[table["height_m"] == 6.0], 0.1)) is None


def search_of(falls, settings, monkeypatch, kept=None):
    """Table of a search where a share `falls(force)` of each tie falls, and the ties tried."""
    tried = []

    def realisations(case, motion, direction, given):
        rows = case["facade"]["ties"]
        force = rows[-1]["anchor_kn"] if rows else 0.0
        tried.append(force)
        n = given["realisations"]
        return round(falls(force) * n), n

    monkeypatch.setattr(strengthening, "realisations", realisations)
    monkeypatch.setattr(
        strengthening,
        "row_of_rods",
        lambda _, z, force: {"height_m": z, "diameter_mm": 20.0, "anchor_kn": force},
    )
    config, _ = tied(numerics=FEW)
    case = Case({**config, "model": "W1", "beta_s": BETA_S})
    case = Case({**case.sections, "facade": {**case["facade"], "ties": []}})
    return strengthening.search(case, None, "pos", settings, kept), tried


SEARCH = {"probability": 0.1, "realisations": 61, "levels": 25, "forces_kn": [2.0, 100.0]}
SEARCH |= {"heights_m": [3.0, 6.0]}


def test_over_all_motions_a_share_stands_that_grows_with_the_force():
    """Three motions: one fells nothing, one asks for 20 kN, one is held by no tie tried."""
    about = {"model": "W2", "height_m": 3.0}
    table = pd.DataFrame([{**about, "force_kn": force} for force in (0.0, 20.0, np.nan)])
    found = strengthening.together(table).set_index("force_kn")
    assert found["share_stands"].to_dict() == pytest.approx({0.0: 1 / 3, 20.0: 2 / 3})
    assert set(found["curves"]) == {3}


def test_the_search_goes_down_from_the_strongest_to_the_first_that_fails(monkeypatch):
    """An island of collapse at 20 to 30 kN: whatever holds below it cannot be the least tie."""

    def falls(force):
        return float(force < 5.0 or 20.0 < force < 30.0)

    table, tried = search_of(falls, SEARCH, monkeypatch)
    found = strengthening.least(table, 0.1)
    forces = strengthening.trial_forces(SEARCH, 25)
    assert found["force_kn"].tolist() == [forces[forces > 30.0].min()] * 2
    weakest = max(f for f in forces if 20.0 < f < 30.0)
    assert min(f for f in tried if f) in (weakest, *forces[forces < weakest][-1:])
    above = int((forces > 30.0).sum())  # every second, and those next to where ties cease to hold
    assert len(tried) <= 1 + 2 * (2 + math.ceil(above / 2) + 1)


def test_forces_between_are_tried_where_ties_cease_to_hold(monkeypatch):
    """Whichever of the forces is the least that holds, it is found, in less than half of them."""
    forces = strengthening.trial_forces(SEARCH, 25)[1:]
    for least in (*forces[[0, 1, 7, 12, 23, 24]],):
        table, tried = search_of(lambda f, least=least: f < least - 1e-9, SEARCH, monkeypatch)
        assert strengthening.least(table, 0.1)["force_kn"].tolist() == [least] * 2
        assert len(tried) <= 1 + 2 * 15
    even = {**SEARCH, "levels": 6}
    table, _ = search_of(lambda f: 1.0 - np.sign(f), even, monkeypatch)
    assert strengthening.least(table, 0.1)["force_kn"].tolist() == pytest.approx([2.0] * 2)


def test_what_was_found_is_kept_and_taken_up_again(monkeypatch, tmp_path):
    path = tmp_path / "kept.jsonl"
    first, _ = search_of(lambda f: f < 9.0, SEARCH, monkeypatch, strengthening.Kept(path, "a"))
    path.write_text(path.read_text() + '{"key": "a", "height')  # broken off
    again, tried = search_of(lambda f: 1.0, SEARCH, monkeypatch, strengthening.Kept(path, "a"))
    assert tried == []
    assert again.equals(first)
    _, tried = search_of(lambda f: 1.0, SEARCH, monkeypatch, strengthening.Kept(path, "b"))
    assert len(strengthening.Kept(path, "b").known) == len(tried) > 0  # none with what broke off


def test_scans_of_the_chart_are_kept_and_said(monkeypatch, tmp_path):
    """A scan that has no tenth of collapse (NaN) is kept as well; a search's key is another one."""

    class Found:
        def summary(self):
            found = dict.fromkeys(("safe", "collapse", "median", "p90", "all", "max"), 0.25)
            return {f"pga_{k}_g": v for k, v in (found | {"p10": math.nan}).items()}

    def curve(*_, **__):
        done.append(1)
        return Found()

    monkeypatch.setattr(strengthening, "collapse_curve", curve)
    config, _ = tied(numerics=FEW)
    case, settings = Case({**config, "model": "W1"}), {**config["strengthening"], "curve_levels": 3}
    done, said, tables, clock = [], [], [], itertools.count(0.0, 40.0)
    monkeypatch.setattr(strengthening.time, "process_time", lambda: next(clock))
    for _ in range(2):
        kept = strengthening.Kept(tmp_path / "kept.jsonl", "a chart")
        tables.append(strengthening.curve(case, None, "pos", settings, 3.0, kept, said.append))
    assert len(done) == 4  # without a tie too
    assert tables[0].equals(tables[1])
    assert tables[0]["force_kn"].is_monotonic_increasing
    assert tables[0]["pga_p10_g"].isna().all()
    assert said[:3] == [
        "chart of 4 scans at 3.00 m, 0 known",
        "scan with a tie of 100 kN: 40 s of processor time, 3 left",
        "the 3 left take at most about 2 min",
    ]
    assert said[-2].endswith(" 0 left")
    assert said[-1] == "chart of 4 scans at 3.00 m, 4 known"
    assert strengthening.Kept(tmp_path / "kept.jsonl", "a").known == {}


def test_the_cost_is_said_beforehand():
    """Two heights of 25 forces and none: 51 × 61 histories; 13 each and none: 27 × 35."""
    assert strengthening.most_histories(SEARCH, 6.0) == (3111, 945)
    said = strengthening.forecast(SEARCH, 6.0, 0.06)
    assert said == "0.06 s a history: at most 3.11 min of processor time in all"


def test_what_is_left_is_said_once_a_height_is_through(monkeypatch):
    """Lower ties cease to hold at larger forces; 0.06 s a history: within a factor of two."""
    clock, said, at = [0.0], [], []

    def realisations(case, motion, direction, settings):
        row = (case["facade"]["ties"] or [{"height_m": 3.0, "diameter_mm": 0.0}])[0]
        over = row["diameter_mm"] / (12.0 * math.sqrt(4.5 / row["height_m"]))
        histories = 13 if over < 1.0 else 61 if over < 1.3 else 37
        clock[0] += 0.06 * histories
        return (histories if over < 1.0 else 0), histories

    def say(text):
        said.append(text)
        at.append(clock[0])

    monkeypatch.setattr(strengthening, "realisations", realisations)
    monkeypatch.setattr(strengthening.time, "process_time", lambda: clock[0])
    case = study_case("W1")
    settings = {**resolved()["strengthening"], **SEARCH, "heights_m": [3.0, 4.5, 6.0]}
    strengthening.search(case, None, "pos", settings, say=say)
    told = [k for k, text in enumerate(said) if " min of processor time for the " in text]
    for k, words in zip(told, ("2 heights that are left", "height that is left"), strict=True):
        assert said[k].endswith(words)
        assert 0.5 < 60.0 * float(said[k].split()[1]) / (clock[0] - at[k]) < 2.0


def test_the_forecast_is_by_a_history_of_the_tie_after_the_one_that_compiles(monkeypatch):
    """The first 13 histories take 100 s, as they compile; all others 0.06 s each."""
    clock, said = [0.0], []

    def realisations(case, motion, direction, settings):
        clock[0] += 0.06 * 13 if clock[0] else 100.0
        return 13, 13

    monkeypatch.setattr(strengthening, "realisations", realisations)
    monkeypatch.setattr(strengthening.time, "process_time", lambda: clock[0])
    settings = {**resolved()["strengthening"], **SEARCH}
    strengthening.search(study_case("W1"), None, "pos", settings, say=said.append)
    height_m = study_case("W1")["facade"]["height_m"]
    assert [text for text in said if "s a history" in text] == [
        strengthening.forecast(settings, height_m, 0.06)
    ]


def test_realisations_end_where_they_have_decided(monkeypatch):
    """Of 61 at 0.1: all fall, 13 do; none falls, 37 do (35 are enough); some fall, all 61."""

    class Found:
        def __init__(self, status):
            self.status = np.array(status, object)

    def outcome(which):
        def curve(case, motion, direction, search, settings):
            n = settings["pga_g"].size
            status = ["ok"] * n
            if which == "all":
                status = ["overturned"] * n
            elif which == "some":
                status[0] = "overturned"
            return Found(status)

        return curve

    case = {"ensemble": {"amplitude_spread": 0.01}}
    settings = {"probability": 0.1, "pga_g": 0.4, "realisations": 61}
    assert strengthening.enough(0.1) == 35
    for which, expected in (("all", (13, 13)), ("none", (0, 37)), ("some", (5, 61))):
        monkeypatch.setattr(strengthening, "collapse_curve", outcome(which))
        assert strengthening.realisations(case, None, "pos", settings) == expected


@pytest.mark.slow
def test_search_finds_the_static_answer():
    """A long slow push: the least tie at z is that of moments about the middle of the pressed toe.

    F z = λ W h/2 − W (b/2 − c/3) when the tie yields, turned by θ = e_y/z; the weight then presses
    on a toe of length c = √(2W/(jkn w θ)).
    """
    config, scene = tied(facade={"e_mpa": 1e5}, numerics=FEW)
    job = {**config, "model": "W1", "beta_s": BETA_S}
    f, z = config["facade"], 6.0
    h, b = f["height_m"], f["thickness_m"]
    push = 2.0 * b / h
    time_s = np.linspace(0.0, 12.0, 601)
    ground = push * G * 0.5 * (1.0 - np.cos(np.pi * np.minimum(time_s / 8.0, 1.0)))
    settings = {
        **config["strengthening"],
        "pga_g": push,
        "heights_m": [z],
        "forces_kn": [6.2, 7.4],
        "levels": 6,
        "realisations": 5,
    }
    weight = scene.blocks[1].mass_kg * G
    turn = settings["yield_mpa"] / 2e5 * settings["length_m"] / z
    toe = math.sqrt(2.0 * weight / (f["e_mpa"] * 1e6 / h * f["width_m"] * turn))
    expected = (push * weight * 0.5 * h - weight * (0.5 * b - toe / 3.0)) / z / 1e3
    motion = Motion(floors=(time_s, {"ground": -ground}))
    table = strengthening.search(Case(job), motion, "pos", settings)
    (found,) = strengthening.least(table, 0.5)["force_kn"]
    assert found == pytest.approx(expected, rel=0.04)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"models": ["W1"], "facade": {"sides": "two"}}, "sides = two"),
        ({"strengthening": {"heights_m": [6.0, 7.0]}}, "height_m = 7: expected"),
        ({"strengthening": {"elongation": 1e-4}}, "elongation.*strain at yield"),
    ],
)
def test_facades_that_cannot_be_held(given, message):
    """The search for a tie is refused before anything is planned."""
    config = study_settings(given)

    def models():
        settings = config["strengthening"]
        heights = strengthening.trial_heights(settings, config["facade"]["height_m"])
        return planar_models(config, [strengthening.tie(settings, z, 10.0) for z in heights])

    with pytest.raises(ConfigError, match=message):
        models()


def test_the_project_s_own_settings_are_within_them():
    for key, value in strengthening.CHART.items():
        curves._allowed(key, WHERE[key], value)
