"""What is said by the formula: the first line of a run, remarks on other medians."""

import math

import pandas as pd
import pytest
from formula_cases import ROW
from rocking import Case, estimate
from rocking.configuration import config
from rocking.formula import groups, law, words, yielding
from study_cases import study_case, study_settings


@pytest.fixture(scope="module")
def known():
    return law.read()


def test_a_run_of_an_own_facade_begins_with_the_formula():
    own = study_settings(
        {
            "models": ["W1", "W2m", "W1c"],
            "facade": {"height_m": 7.2},
            "return_wall": {"building_mass_kg": 1.2e5},
        }
    )
    line = words.of_run("mine", own)
    case = study_case("W1", {"facade.height_m": 7.2})
    assert line.startswith("mine: by the formula")
    assert f"W1 {estimate(case).median:.2g} g" in line
    assert "W2m" in line
    assert "W1c" not in line
    assert words.of_runs({"default": config.resolve({"models": ["W1"]})}) == []
    assert (
        words.of_run("slow", study_settings({"models": ["W2"], "smdof": {"period_s": 3.0}})) == ""
    )


def test_a_computed_median_far_from_the_formula_is_remarked_upon():
    found = law.Estimate("W2m", "pga_g", 0.3, 0.4, 0.05)
    edge = math.exp(2.0 * math.hypot(0.05, 0.4 / 4.0))
    assert words.outlier(found, 0.3 * 0.99 * edge, 16) is None
    assert words.outlier(found, 0.3 * 1.01 * edge, 2) is None  # two motions say little
    assert words.outlier(found, math.nan, 16) is None
    for computed_g in (0.3 * 1.01 * edge, 0.3 / 1.01 / edge):
        one = words.outlier(found, computed_g, 16)
        assert one == ("W2m", computed_g, *map(pytest.approx, (0.3 / edge, 0.3 * edge)))


def test_an_assessment_says_where_its_median_is_far_from_the_formula():
    own = study_settings({"models": ["W1"], "facade": {"height_m": 7.2, "base": "column"}})
    by_formula = estimate(study_case("W1", {"facade.height_m": 7.2, "facade.base": "column"}))
    rows = [{"model": "W1", "median_pga_g": by_formula.median, "stations": 22}]
    assert words.outliers(own, pd.DataFrame(rows)) == []
    rows[0]["median_pga_g"] *= 5.0
    (found,) = words.outliers(own, pd.DataFrame(rows))
    assert (found.model, found.computed_g) == ("W1", rows[0]["median_pga_g"])
    assert found.computed_g > found.high_g
    own["facade"]["ties"] = [{"height_m": 3.0}]
    assert words.outliers(own, pd.DataFrame(rows)) == []  # no formula, nothing to say


def test_a_building_that_yields_late_is_the_elastic_one_and_a_weak_one_spares_the_facade():
    """ln r = s L x where L and x exceed 0: of a strong building nothing."""
    ground = law.said(ROW, "W1")[0]
    for model in ("W2", "W2m"):
        part = yielding.read()["models"][model]
        elastic, spread, error = law.said(ROW, model)
        strong = law.said({**ROW, "base_shear_ratio": 20.0}, model)
        assert strong == (elastic, spread, error)
        weak, weaker = (law.said({**ROW, "base_shear_ratio": v}, model)[0] for v in (0.12, 0.10))
        assert elastic < weak < weaker
        share = part["s"] * math.log(ground / elastic)
        assert math.log(weaker / weak) == pytest.approx(share * math.log(0.12 / 0.10))
        x = yielding.excess(elastic, 0.12, part)
        assert math.log(weak / elastic) == pytest.approx(share * x)
        in_pgv = [
            law.said({**ROW, **more}, model, "pgv_cm_s")[0]
            for more in ({}, {"base_shear_ratio": 0.12})
        ]
        assert in_pgv[1] / in_pgv[0] == pytest.approx(weak / elastic)
        assert law.said({**ROW, "base_shear_ratio": 0.12}, model)[2] > error
    assert law.said({**ROW, "base_shear_ratio": 0.1}, "W1") == law.said(ROW, "W1")


def test_a_strength_that_was_not_tried_is_outside():
    with pytest.raises(groups.OutsideError, match="base_shear_ratio = 0.02: the formula has 0.1"):
        law.said({**ROW, "base_shear_ratio": 0.02}, "W2m")


def test_a_case_is_estimated_with_its_strength():
    keys = {"facade.base": "column", "facade.courses": 0, "return_wall.building_mass_kg": 6.4e4}
    medians = [
        estimate(Case.configured("W2m", {**keys, "smdof.base_shear_ratio": ratio})).median
        for ratio in (None, 0.10)
    ]
    assert medians[1] > 1.02 * medians[0]
    other = {"smdof.base_shear_ratio": 0.1, "smdof.loops": "peak_oriented"}
    looped = Case.configured("W2m", {**keys, **other})
    with pytest.raises(groups.OutsideError, match="smdof.loops = 'peak_oriented'"):
        estimate(looped)
