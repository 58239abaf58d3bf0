"""What is said by the formula: its page, the first line of a run, remarks on other medians."""

import json
import math
import shutil
import subprocess

import numpy as np
import pandas as pd
import pytest
from formula_cases import ROW, drawn
from rocking import Case, estimate
from rocking.configuration import config
from rocking.formula import groups, law, page, words, yielding
from scipy.special import ndtr
from study_cases import study_case, study_settings


@pytest.fixture(scope="module")
def known():
    return law.read()


def test_page_carries_the_formula_and_loads_nothing(known):
    text = page.page(known)
    assert not any(word in text for word in ("src=", "href=", "fetch(", "import("))
    assert "http" not in text.replace("http://www.w3.org/2000/svg", "")
    inside = text.split("const LAW = ", 1)[1].split(";\n", 1)[0]
    assert json.loads(inside)["limits"] == known["limits"]
    assert set(json.loads(inside)["walls"]) == {known["made_of"]["base"], *known["bases"]}
    assert 'name="viewport" content="width=device-width' in text


@pytest.mark.skipif(not shutil.which("node"), reason="no Node.js; the browser was tried by hand")
def test_page_and_python_agree_at_a_thousand_inputs(known, tmp_path):
    """The page's own script, run without a page: median, probability at a PGA, error."""
    rng, rows = np.random.default_rng(11), drawn(1000)
    lowest = yielding.read()["lowest"]
    for row in rows[::2]:
        row["base_shear_ratio"] = float(rng.uniform(lowest, 0.6))
    models, measures = list(known["models"]), list(law.MEASURES)
    bases = [known["made_of"]["base"], *known["bases"]]
    asked = [
        {
            "x": row,
            "model": models[rng.integers(len(models))],
            "measure": measures[rng.integers(len(measures))],
            "base": bases[rng.integers(len(bases))],
            "factor": float(rng.uniform(0.3, 3.0)),
        }
        for row in rows
    ]
    script = page.page(known).split("<script>", 1)[1].split("</script>", 1)[0]
    script += (
        "\nconst asked = JSON.parse(require('fs').readFileSync(0, 'utf8'));\n"
        "console.log(JSON.stringify(asked.map((a) => { const f = estimate(a.x, a.model, a.measure, "
        "a.base); return [f.median, probability(f, a.factor * f.median), f.error, "
        "outside(a.x, a.model) === null]; })));\n"
    )
    (tmp_path / "page.js").write_text(script, "utf-8")
    run = subprocess.run(
        ["node", str(tmp_path / "page.js")],
        input=json.dumps(asked),
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    for one, (median, share, error, inside) in zip(asked, json.loads(run.stdout), strict=True):
        own, spread, own_error = law.said(one["x"], one["model"], one["measure"], one["base"])
        assert inside
        assert median == pytest.approx(own, rel=1e-9)
        assert share == pytest.approx(ndtr(math.log(one["factor"]) / spread), rel=1e-6, abs=1e-12)
        assert error == pytest.approx(own_error, rel=1e-9)


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
        x = yielding.excess(elastic, 0.12, ROW["period_s"], part)
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
