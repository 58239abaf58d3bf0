"""What is shaken, what holds it then, and how far each mechanism is followed."""

import numpy as np
import pandas as pd
import pytest
from rocking import Motion
from rocking.collapse import curve, scan, search
from studies.assess import collapses, shaken
from studies.assess.code_checks import family_of, governing
from studies.assess.code_spectrum import CodeDemand
from studies.assess.dynamic_answer import left_out
from studies.assess.national import return_period_of
from studies.shared.hazard import Hazard
from study_cases import study_case, study_settings

DEMAND = CodeDemand(0.16, 2.5, 0.31, "C")
FACADE = {"height_m": 8.0, "thickness_m": 0.5, "width_m": 8.0, "density_kg_m3": 1800.0}
FACADE |= {"parapet_height_m": 1.2, "parapet_thickness_m": 0.3, "ties": [{"height_m": 4.0}]}
FACADE |= {"floors": [{"height_m": 4.0, "load_kn": 40.0, "friction": 0.3}]}
CHAIN = {"n_dof": 2, "period_s": 0.3}
HELD = {"floor_friction": False, "anchor_plate_m": 0.3, "masonry_shear_mpa": 0.05}
HELD |= {"masonry_compression_mpa": 2.6, "confidence_factor": 1.2}


def table(within, demand=DEMAND, facade=FACADE):
    settings = study_settings({"facade": facade, "smdof": CHAIN})
    ranked = governing(family_of(settings, demand).all(), settings, demand)
    damping = {"law": "value", "beta_s": 0.001}
    case = study_case("W1", {"facade": facade, "smdof": CHAIN, "damping": damping})
    return shaken.chosen(ranked, [case], demand.pga_g, within), case


def test_the_demand_decides_and_not_the_weakest():
    """Everything plane below the factor of the demand; the others by a key, and all named."""
    found, _ = table(1.0)
    near = found["pga_fails_g"] <= DEMAND.pga_g
    plane = found["side"] == 0
    far = found["why_not"] == shaken.FAR
    assert near.any()
    assert not (far & near).any()
    assert set(found.loc[~plane, "why_not"]) == {shaken.CORNER}
    every = (
        found["shaken"].astype(bool)
        | far
        | found["why_not"].isin((shaken.CORNER, shaken.STOCKY, shaken.REFUSED))
    )
    assert every.all()
    fewer, _ = table(1.0, CodeDemand(0.06, 2.5, 0.31, "C"))  # none is near a weak demand
    spans = set(fewer.loc[fewer["held_m"].notna(), "part"])
    assert spans
    assert set(fewer.loc[fewer["shaken"] == 1, "part"]) == {"whole", *spans}
    assert found.loc[found["part"] == "whole", "shaken"].iloc[0] == 1


def test_a_span_falls_once_its_level_gives_way():
    """By hand the level stays in place whatever it bears; with anchors of 12 kN it does not."""
    fell = {}
    for anchor_kn in (12.0, 400.0):
        row = {"height_m": 4.0, "count": 1, "diameter_mm": 30.0, "anchor_kn": anchor_kn}
        facade = {**FACADE, "thickness_m": 0.3, "ties": [row], "floors": []}
        damping = {"law": "value", "beta_s": 0.001}
        case = study_case("W1", {"facade": facade, "smdof": CHAIN, "damping": damping})
        motion = Motion.named("IS105_Lo", "config/suites/recorded_suite.tsv")
        how = {"search": "list", "settings": {"pga_g": [0.5]}}
        (found,) = curve.collapse_curves(case.part(0.0, 4.0, 2.5), [(motion, "pos")], **how)
        fell[anchor_kn] = found.table["status"].iloc[0] == "overturned"
    assert fell == {12.0: True, 400.0: False}


@pytest.mark.parametrize(("anchor_kn", "shaken_too"), [(40.0, True), (90.0, False)])
def test_a_link_that_gives_way_early_is_shaken_however_far_from_the_demand(anchor_kn, shaken_too):
    """Rods that yield at 68.4 kN each: on stronger anchors the same part is left out."""
    row = {"height_m": 4.0, "diameter_mm": 22.0, "length_m": 9.0, "yield_mpa": 180.0}
    door = {"x_m": 0.0, "z_m": 0.0, "width_m": 1.0, "height_m": 2.0}
    facade = {**FACADE, "ties": [{**row, "anchor_kn": anchor_kn}], "openings": [door]}
    found, _ = table(1.0, CodeDemand(0.02, 2.5, 0.31, "C"), facade)
    own = found.set_index("part").loc["above_2.0"]
    assert own["shaken"] == shaken_too
    assert (own["d_slv_m"] < 0.1 * own["d_slv_bare_m"]) == shaken_too


def test_what_is_too_stocky_is_known_by_the_kind_of_its_refusal():
    found, _ = table(100.0)
    stocky = found[found["why_not"] == shaken.STOCKY]
    assert (8.0 + 1.2 - stocky["foot_m"] < 2.0 * 0.5 + 1e-9).all()


def test_friction_of_floors_holds_nothing_unless_it_is_said_to():
    case = study_case("W1", {"facade": FACADE, "damping": {"law": "value", "beta_s": 1e-3}})
    found = shaken.settled(case, HELD)
    assert [row["friction"] for row in found["facade"]["floors"]] == [0.0]
    assert found["facade"]["ties"][0]["anchor_kn"] == pytest.approx(
        1e-3 * 0.05e6 / 2.4 * 4.0 * 0.8 * 0.5
    )
    kept = shaken.settled(case, {**HELD, "floor_friction": True})
    assert [row["friction"] for row in kept["facade"]["floors"]] == [0.3]
    assert [row["friction"] for row in case["facade"]["floors"]] == [0.3]  # it is as it was
    assert shaken.rubs(case["facade"])
    assert not shaken.rubs(found["facade"])


def test_a_part_of_the_parapet_stands_on_the_top_of_the_building():
    case = study_case("W1", {"facade": FACADE, "damping": {"law": "value", "beta_s": 1e-3}})
    part = case.part(8.5)["facade"]
    assert part["height_m"] == pytest.approx(0.7)
    assert (part["base_height_m"], part["sides"]) == (8.0, "two")
    gable = {**FACADE, "parapet_height_m": 0.0, "gable_height_m": 2.0}
    case = study_case("W1", {"facade": gable, "damping": {"law": "value", "beta_s": 1e-3}})
    part = case.part(8.5)["facade"]
    assert (part["height_m"], part["width_m"]) == (pytest.approx(1.5), pytest.approx(6.0))


def test_below_what_is_known_a_part_is_asked_only_while_it_moves(monkeypatch):
    """Six amplitudes down to 0.57 of what is known, two at a time, until d/b stays below 0.3."""
    peaks, asked = {"calm": (0.29, 0.29), "less": (0.5, 0.2), "far": (0.9, 0.9)}, {}

    def listed(_, turns, levels):
        tables = []
        for name, own in zip(turns, levels, strict=True):
            asked.setdefault(name, []).extend(own)
            d = np.where(np.asarray(own) > 0.85, *peaks[name])
            tables.append(pd.DataFrame({"pga_g": own, "status": "ok", "d_over_b": d}))
        return tables

    monkeypatch.setattr(collapses, "_listed", listed)
    rows = collapses.by_part({"part": None}, list(peaks), 2.0, [1.0, 1.0, 1.0])["part"]
    assert [len(asked[name]) for name in peaks] == [2, 4, 6]
    assert [row["runs_planar"] for row in rows] == [2, 4, 6]
    assert sorted(asked["far"]) == pytest.approx(1.12 ** np.arange(-5.0, 1.0))
    assert all(np.isnan(row["pga_median_g"]) and row["pga_max_g"] == 1.0 for row in rows)


@pytest.mark.slow
def test_climbs_that_end_where_another_has_fallen_lose_no_first_collapse():
    """The least of all mechanisms under each motion, with and without the early ends."""
    found, case = table(3.0)
    case = shaken.settled(case, HELD)
    parts = {row.part: own for row, own in shaken.cases(case, found)}
    assert len(parts) > 2
    suite = "config/suites/recorded_suite.tsv"
    turns = [(Motion.named(name, suite), "neg") for name in ("IS101_Lo", "GMN_NS")]
    halves = []
    for known in (None, [np.nan, np.nan]):
        rows = collapses.by_part(parts, turns, 2.0, known)
        half = [[row["pga_median_g"] for row in own] for own in rows.values()]
        halves.append(np.nanmin(half, axis=0))
    assert halves[1] == pytest.approx(halves[0], rel=0.02)


@pytest.mark.slow
def test_a_climb_from_where_a_part_stands_finds_the_same_and_runs_none_below(monkeypatch):
    case = study_case("W1", {"facade": FACADE, "damping": {"law": "value", "beta_s": 1e-3}})
    turns = [(Motion.named("IS101_Lo", "config/suites/recorded_suite.tsv"), "neg")]
    (usual,) = collapses.by_part({"whole": case}, turns, 2.0)["whole"]
    start, asked = 0.9 * usual["pga_median_g"], []

    def marched(asks):
        asked.extend(float(np.min(levels)) for _, levels, _ in asks if len(levels))
        return scan.marched(asks)

    monkeypatch.setattr(curve, "seen_together", lambda one: scan.seen_together(one, marched))
    found = collapses.by_part({"whole": case}, turns, 2.0, None, {"whole": [start]})["whole"]
    assert found[0]["pga_median_g"] == pytest.approx(usual["pga_median_g"], rel=search.SPREAD)
    assert min(asked) >= 0.96 * start  # realisations lie either side of an amplitude
    none = collapses.by_part({"whole": case}, turns, 2.0, None, {"whole": [2.0]})["whole"]
    assert (none[0]["runs_planar"], none[0]["pga_max_g"]) == (0, 2.0)
    assert np.isnan(none[0]["pga_median_g"])


def test_what_was_not_shaken_is_bounded_by_what_falls_earliest_against_its_check():
    """λ = 1e-3 (0.1/x)²; of two mechanisms one falls at 0.6 of its check by hand: so may others.

    In closed form λ_c = 1e-3 (0.1/θ)² exp(2 β²), θ = 0.6 times 0.5 g, β the larger of both.
    """
    intensity = np.array([0.01, 0.1, 1.0])
    hazards = {"site": Hazard("pga_g", intensity, 1e-3 * (0.1 / intensity) ** 2)}
    rows = [("a", 0.18, 0.3, 0), ("b", 0.5, 0.5, 0), ("c", 0.1, 0.9, 40)]
    columns = ["part", "median_pga_g", "dispersion", "never_collapsed"]
    parts = pd.DataFrame(rows, columns=columns).assign(model="W2", curves=44)
    table = pd.DataFrame({"part": ["a", "b", "c", "corner"], "pga_fails_g": [0.3, 0.4, 0.6, 0.5]})
    (row,) = left_out(parts, table.assign(shaken=[1, 1, 1, 0]), hazards).itertuples()
    assert (row.part, row.median_pga_g, row.dispersion) == ("corner", pytest.approx(0.3), 0.5)
    assert row.rate_bound == pytest.approx(1e-3 * (0.1 / 0.3) ** 2 * np.exp(2 * 0.25), rel=1e-6)


def test_the_return_period_of_a_capacity_is_read_off_the_rows():
    """At a row's own PGA its period, between two by the power law, beyond them in words."""
    rows = [
        {"return_period_years": t, "ag_g": a, "f0": 2.4, "tc_star_s": 0.3}
        for t, a in ((30, 0.05), (475, 0.16), (2475, 0.3))
    ]
    own = {"hazard": rows, "soil": "A", "topography": "T1"}
    assert return_period_of(own, 0.16) == ("at", pytest.approx(475.0))
    share = np.log(0.2 / 0.16) / np.log(0.3 / 0.16)
    key, years = return_period_of(own, 0.2)
    assert key == "at"
    assert years == pytest.approx(475 * (2475 / 475) ** share, abs=0.6)
    assert return_period_of(own, 0.04) == ("below", 30.0)
    assert return_period_of(own, 0.5) == ("above", 2475.0)
    assert return_period_of({**own, "hazard": []}, 0.1) is None
