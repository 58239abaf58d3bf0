"""The formula and its atlas: groups, exact laws found again, refusals, classes, the page."""

import json
import math
import shutil
import subprocess
import warnings
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from rocking import Case, Motion, estimate
from rocking.assessment import report
from rocking.formula import classes, fit, groups, law, measures, page, words
from rocking.shipped import shipped
from rocking.studies import atlas
from scipy.special import ndtr

from smdof.spectra import response_spectrum

COLUMN = {
    "facade.base": "column",
    "damping.law": "eq5",
    "return_wall.building_mass_kg": 1.0e5,
    "facade.thickness_m": 0.45,
}
ROW = {
    "height_m": 6.5,
    "slenderness": 14.0,
    "e_mpa": 1800.0,
    "density_kg_m3": 1800.0,
    "friction_deg": 30.0,
    "period_s": 0.3,
    "mass_ratio": 6.0,
    "contact_damping": 1.0,
    "storeys": 3,
}
PARTS = ("whole", "above_2.000")  # of an assessment
SETTINGS = {"facades": 32, "seed": 48, "others": [], "max_pga_g": 8.0}
SETTINGS["ranges"] = {
    "height_m": [3.0, 12.0],
    "slenderness": [9.0, 20.0],
    "e_mpa": [800.0, 3500.0],
    "density_kg_m3": [1600.0, 2100.0],
    "friction_deg": [25.0, 40.0],
    "period_s": [0.08, 0.6],
    "mass_ratio": [3.0, 25.0],
    "width_m": [3.0, 10.0],
    "storeys": [2, 5],
    "beta_factor": [0.5, 2.0],
}


@pytest.fixture(scope="module")
def known():
    return law.read()


@pytest.fixture(scope="module")
def case():
    with pytest.warns(UserWarning, match="eq. 5 was fitted"):
        return Case.configured("W2m", COLUMN)


def drawn(count, seed=7):
    """Façades within the limits of the shipped formula."""
    rng, limits = np.random.default_rng(seed), law.read()["limits"]
    rows = [{name: rng.uniform(*ends) for name, ends in limits.items()} for _ in range(count)]
    return [{**row, "storeys": round(row["storeys"])} for row in rows]


def test_a_longer_design_begins_with_the_shorter_one():
    short = atlas.design({**SETTINGS, "facades": 8})
    pd.testing.assert_frame_equal(atlas.design(SETTINGS).head(8), short)


def test_design_fills_every_dimension_evenly():
    """Of 32 Sobol' points each quarter of a dimension has eight."""
    table = atlas.design(SETTINGS)
    for name, kind in atlas.DIMENSIONS.items():
        low, high = SETTINGS["ranges"][name]
        if kind == atlas.WHOLE:
            assert table[name].value_counts().tolist() == [8, 8, 8, 8]
            continue
        ends = np.geomspace(low, high, 5) if kind == atlas.LOG else np.linspace(low, high, 5)
        assert np.histogram(table[name], ends)[0].tolist() == [8, 8, 8, 8]


def test_facade_of_the_design_is_the_one_described(case):
    table = atlas.design({**SETTINGS, "facades": 8})
    found = atlas.described(case, table)
    for name in ("height_m", "slenderness", "e_mpa", "mass_ratio", "storeys"):
        assert found[name].to_numpy() == pytest.approx(table[name].to_numpy())


def test_contact_damping_is_that_of_the_façade_on_its_walls(case):
    """z/2 is c/(2√(k m)) of the mass per area ρ b on springs E r/L with dashpots β times those."""
    e, b, h = 1.8e9, 0.45, 6.48
    k = e / (h / 2.0) * 2.0 * 0.375 / 4.4
    share = case["beta_s"] * k / (2.0 * math.sqrt(k * 1800.0 * b))
    assert groups.dimensions(case)["contact_damping"] == pytest.approx(2.0 * share, rel=1e-6)


def test_groups_do_not_change_with_the_units_of_length():
    """Γ and z are numbers: twice the size on twice the modulus and half of β keep both."""
    other = {**ROW, "height_m": 13.0, "e_mpa": 3600.0}
    assert groups.gamma(other) == pytest.approx(groups.gamma(ROW))
    assert groups.p_rad_s(other) == pytest.approx(groups.p_rad_s(ROW) / math.sqrt(2.0))


def made(noise=0.0, seed=3):
    """An atlas of a law that is known, with a scatter by motion of 0.3 and none of the façade."""
    rng = np.random.default_rng(seed)
    table = atlas.design(SETTINGS)
    design = table.assign(contact_damping=table["beta_factor"]).set_index("facade")
    names = fit.TERMS["W2"]
    truth = np.array([2.0, -0.9, 0.2, -5.0, -0.5])
    mean = fit.matrix(design, names) @ truth
    motions = np.repeat(rng.normal(0.0, 0.3, 12), 2) + rng.normal(0.0, 0.1, 24)
    rows = []
    for k, (number, row) in enumerate(design.iterrows()):
        for m, level in enumerate(motions):
            value = mean[k] + level + noise * rng.normal()
            pga = math.exp(value) / row["slenderness"]
            rows.append((number, "own", "W2", f"r{m // 2}", ("pos", "neg")[m % 2], pga))
    columns = ["facade", "base", "model", "record", "direction", "pga_median_g"]
    return pd.DataFrame(rows, columns=columns), design, truth, motions


def test_a_law_without_noise_is_found_again_and_foretells_what_was_left_out():
    table, design, truth, motions = made()
    values = fit.wide(table, design, "W2", "own")
    terms = fit.matrix(design, fit.TERMS["W2"])
    found = fit.solve(terms, values.to_numpy())
    assert found[1:] == pytest.approx(truth[1:], abs=1e-9)
    assert found[0] == pytest.approx(truth[0] + motions.mean(), abs=1e-9)
    stations = values.columns.get_level_values(0)
    out = fit.left_out(terms, values.to_numpy(), stations)
    assert out["of_facade"].abs().max() < 1e-9
    assert out["level"].abs().max() > 0.02  # six motions are no suite
    assert np.abs(fit.facades_out(terms, values.to_numpy())[0]).max() < 1e-9


def test_intervals_hold_the_truth_where_façades_scatter():
    table, design, truth, _ = made(noise=0.2)
    values = fit.wide(table, design, "W2", "own")
    terms = fit.matrix(design, fit.TERMS["W2"])
    stations = values.columns.get_level_values(0)
    low, high = fit.intervals(terms, values.to_numpy(), stations, 1)
    assert np.all(low < high)
    assert np.mean((low[1:] < truth[1:]) & (truth[1:] < high[1:])) >= 0.8


def test_measures_are_those_of_the_spectrum_period_by_period():
    record = Motion.named("LPCC_H1", table="config/suites/recorded_suite.tsv").record
    design = pd.DataFrame({"period_s": [0.5, 0.2]}, index=[1, 2])
    found = measures.factors([record], design)
    periods = np.geomspace(0.2, 2.0, 10)
    every = [
        response_spectrum(record.acceleration_m_s2, record.dt_s, np.array([t]), 0.05).psa_m_s2[0]
        for t in (*periods, 0.5)
    ]
    peak = np.abs(record.acceleration_m_s2).max()
    average = math.exp(np.mean(np.log(every[:-1]))) / peak
    assert found["sa_avg_2s_g"]["LPCC_H1"].to_numpy() == pytest.approx([average] * 2, rel=1e-6)
    own = [every[-1] / peak, every[0] / peak]
    assert found["sa_t1_g"]["LPCC_H1"].to_numpy() == pytest.approx(own, rel=1e-6)
    mean = [average**0.7 * one**0.3 for one in own]
    assert found["sa_avg_2s_t1_g"]["LPCC_H1"].to_numpy() == pytest.approx(mean, rel=1e-6)


def test_a_measure_moves_the_level_by_its_factor_alone():
    table, design, truth, _ = made()
    factor = pd.DataFrame(60.0, index=design.index, columns=[f"r{k}" for k in range(12)])
    values = fit.wide(table, design, "W2", "own", factor)
    plain = fit.wide(table, design, "W2", "own")
    assert (values - plain).to_numpy() == pytest.approx(math.log(60.0))


def test_shipped_formula_stays_within_what_mechanics_allows(known):
    """A façade gains with its size and its thickness; a slow building costs; Γ costs."""
    for model in known["models"]:
        own = dict(
            zip(
                known["models"][model]["pga_g"]["terms"],
                known["models"][model]["pga_g"]["coefficients"],
                strict=True,
            )
        )
        assert -1.3 < own["ln p"] < -0.5
        assert own.get("G", 0.0) <= 0.0
        assert own.get("ln T1", 0.0) <= 0.0
        assert law.said({**ROW, "height_m": 10.0}, model)[0] > law.said(ROW, model)[0]
        assert law.said({**ROW, "slenderness": 11.0}, model)[0] > law.said(ROW, model)[0]


def test_walls_that_follow_the_building_cost_and_can_be_pushed_save(known):
    found = {model: law.said(ROW, model)[0] for model in ("W1", "W2", "W2m")}
    assert found["W2"] < found["W2m"] < found["W1"]


def test_estimate_of_a_case_is_that_of_its_dimensions(case):
    found = estimate(case)
    median, dispersion, error = law.said(groups.dimensions(case), "W2m")
    assert (found.median, found.dispersion, found.error) == (median, dispersion, error)
    assert found.probability([found.low, found.median, found.high]) == pytest.approx(
        ndtr([-1.0, 0.0, 1.0])
    )
    assert f"{median:.3g} g" in repr(found)


def test_on_the_soft_base_it_takes_less(case):
    soft = Case.configured("W2m", {**COLUMN, "facade.base": "study", "facade.thickness_m": 0.4})
    hard = Case.configured("W2m", {**COLUMN, "facade.thickness_m": 0.4})
    assert estimate(soft).median < estimate(hard).median
    assert estimate(soft).error > estimate(hard).error


@pytest.mark.parametrize(
    ("change", "said_of"),
    [
        ({"facade.height_m": 20.0, "facade.thickness_m": 1.4}, "height_m = 20"),
        ({"smdof.period_s": 1.5}, "period_s = 1.5"),
        ({"facade.ties": [{"height_m": 3.0}]}, "facade.ties"),
        ({"facade.sides": "two", "damping.law": "value"}, "facade.sides"),
        ({"smdof.damping_ratio": 0.1}, "smdof.damping_ratio"),
        ({"return_wall.friction_deg": 20.0}, "return_wall.friction_deg"),
    ],
)
@pytest.mark.filterwarnings("ignore:.*eq. 5 was fitted")
def test_outside_of_the_atlas_it_refuses_in_one_line(change, said_of):
    model = "W1" if "facade.sides" in change else "W2m"
    with pytest.raises(groups.OutsideError) as said:
        estimate(Case.configured(model, {**COLUMN, **change}))
    assert said_of in str(said.value)
    assert "\n" not in str(said.value)


def test_a_stack_of_courses_is_known_by_its_number_and_growth(known):
    rows = [{"name": "courses", "courses": 4, "courses_growth": 1.5}]
    own = {**known, "made_of": {**known["made_of"], "others": rows}}
    stack = {"base": "study", "courses": 4, "courses_growth": 1.5}
    assert law.base_of(stack, own) == "courses"
    assert law.base_of({**stack, "courses": 0}, own) == "study"
    with pytest.raises(groups.OutsideError, match="4 of growth 1.2: of stacks .* 4 of growth 1.5"):
        law.base_of({**stack, "courses_growth": 1.2}, own)


def test_the_elastic_wall_in_courses_is_estimated(known, case):
    """Of four courses, growth 1.5: the block's median times a ratio, with both errors."""
    stack = {**COLUMN, "facade.base": "study", "facade.courses": 4, "facade.courses_growth": 1.5}
    found, block = estimate(Case.configured("W2m", stack)), estimate(case)
    part = known["bases"]["courses"]["W2m"]
    ratio = law.total(part, groups.terms(groups.dimensions(case)))
    assert math.log(found.median / block.median) == pytest.approx(ratio, abs=1e-9)
    assert found.error == pytest.approx(math.hypot(block.error, part["error"]))
    assert 0.9 < found.median / block.median < 1.1  # `column` was made to follow the elastic wall
    with pytest.raises(groups.OutsideError, match="courses = 7 of growth 1.5"):
        estimate(Case.configured("W2m", {**stack, "facade.courses": 7}))


def test_the_ratio_of_two_bases_is_found_again():
    """0.7 of all; and of a base whose loss grows with Γ, exp(−8 Γ)."""
    table, design, _, _ = made()
    seven = table.assign(base="seven", pga_median_g=0.7 * table["pga_median_g"])
    leans = [math.exp(-8.0 * groups.gamma(design.loc[k])) for k in table["facade"]]
    soft = table.assign(base="soft", pga_median_g=table["pga_median_g"] * leans)
    both, stations = pd.concat([table, seven, soft]), {f"r{k}": f"s{k}" for k in range(12)}
    given = (both, design, "W2", "own")
    stack = fit.ratio_of_bases(*given, "seven", 1, stations, fit.OF_STACK)
    assert stack["coefficients"] == pytest.approx([math.log(0.7)], abs=1e-4)
    block = fit.ratio_of_bases(*given, "soft", 1, stations)
    assert block["coefficients"] == pytest.approx([0.0, -8.0], abs=1e-4)
    assert max(stack["error"], block["error"]) < 1e-4


def test_pieces_of_another_base_may_take_the_first_records_alone():
    others = [{"name": "courses", "facades": 8, "records": 1}]
    found = atlas.parts({"facades": 16, "others": others}, ["A", "B"])
    assert [(row["base"], row["piece"], row["record"]) for row in found] == [
        ("own", 1, "A"),
        ("own", 1, "B"),
        ("own", 2, "A"),
        ("own", 2, "B"),
        ("courses", 1, "A"),
    ]


def test_a_model_without_a_law_is_refused():
    with pytest.raises(TypeError, match="expected a rocking.Case, got int"):
        estimate(3)
    with pytest.raises(groups.OutsideError, match="model W1c"):
        estimate(Case.configured("W1c", {"facade.base": "column"}))


def test_w1_does_not_ask_for_the_building():
    case = Case.configured("W1", {"facade.base": "column", "smdof.period_s": 3.0})
    assert estimate(case).median > 0.0


def test_class_of_one_facade_is_that_facade(known):
    found = classes.fragility(pd.DataFrame([ROW]), "W2m")
    median, dispersion, _ = law.said(ROW, "W2m")
    assert found["median"] == pytest.approx(median, rel=1e-12)
    assert found["dispersion"] == pytest.approx(dispersion, rel=1e-12)
    assert found["by_facade"] == 0.0
    same = classes.fragility(pd.DataFrame([ROW] * 5), "W2m")
    assert same["dispersion"] == pytest.approx(dispersion, rel=1e-12)


def test_class_of_two_facades_by_hand():
    """θ = √(0.2·0.8) = 0.4; ln θ_i = ± ln 2 about it, so β_f = ln 2; β_m² = (0.3² + 0.4²)/2."""
    median, beta, by_facade, by_motion = classes.combined([0.2, 0.8], [0.3, 0.4])
    assert median == pytest.approx(0.4)
    assert by_facade == pytest.approx(math.log(2.0))
    assert by_motion == pytest.approx(math.sqrt(0.125))
    assert beta == pytest.approx(math.sqrt(math.log(2.0) ** 2 + 0.125))
    # at the median the mixture is one half, for it is symmetrical there if the dispersions are
    assert classes.mixture(0.4, [0.2, 0.8], [0.3, 0.3]) == pytest.approx(0.5)


def test_class_has_the_mean_and_the_variance_of_its_mixture():
    medians, spreads, weights = [0.2, 0.3, 0.7], [0.3, 0.35, 0.4], [1.0, 2.0, 1.0]
    median, beta, _, _ = classes.combined(medians, spreads, weights)
    x = np.linspace(-8.0, 6.0, 200_001)
    cdf = classes.mixture(np.exp(x), medians, spreads, weights)
    density, middle = np.diff(cdf), 0.5 * (x[1:] + x[:-1])
    mean = density @ middle
    assert mean == pytest.approx(math.log(median), abs=1e-6)
    assert density @ (middle - mean) ** 2 == pytest.approx(beta**2, abs=1e-6)


def test_class_of_distributions_keeps_to_them():
    rows = [
        {"parameter": "height_m", "distribution": "uniform", "low": 5.0, "high": 9.0},
        {"parameter": "thickness_m", "distribution": "lognormal", "median": 0.5, "spread": 0.1}
        | {"low": 0.45, "high": 0.55},
        {"parameter": "storeys", "distribution": "choice", "values": [2, 3]},
    ]
    rest = ("e_mpa", "density_kg_m3", "friction_deg", "period_s", "mass_ratio", "contact_damping")
    rows += [{"parameter": name, "distribution": "value", "median": ROW[name]} for name in rest]
    table = classes.sampled({"samples": 256, "seed": 1, "parameters": rows})
    thick = table["height_m"] / table["slenderness"]
    assert table["height_m"].between(5.0, 9.0).all()
    assert thick.between(0.45, 0.55).all()
    assert np.median(thick) == pytest.approx(0.5, rel=0.01)
    assert set(table["storeys"]) == {2.0, 3.0}
    without = [row for row in rows if row["parameter"] != "friction_deg"]
    with pytest.raises(ValueError, match="friction_deg is missing"):
        classes.sampled({"samples": 8, "seed": 1, "parameters": without})


@pytest.mark.parametrize(
    ("row", "said_of"),
    [
        ({"distribution": "value"}, "value without median; expected median"),
        ({"distribution": "uniform", "low": 5.0}, "uniform without high; expected low and high"),
        ({"distribution": "lognormal", "median": 5.0}, "lognormal without spread"),
        ({"distribution": "choice"}, "choice without values"),
        ({"distribution": "uniform", "low": 9.0, "high": 5.0}, "from 9 to 5; expected low < high"),
    ],
)
def test_row_of_a_class_that_is_incomplete_ends_in_one_line(row, said_of):
    settings = {"samples": 8, "seed": 1, "parameters": [{"parameter": "height_m", **row}]}
    with pytest.raises(ValueError, match="facade_class.parameters: height_m: ") as said:
        classes.sampled(settings)
    assert said_of in str(said.value)
    assert "\n" not in str(said.value)


def test_class_outside_of_the_formula_is_refused():
    rows = pd.DataFrame([ROW] * 8 + [{**ROW, "period_s": 2.0}])
    with pytest.raises(groups.OutsideError, match="11 % of it lie outside"):
        classes.fragility(rows, "W2m")
    assert classes.fragility(rows, "W1")["n_outside"] == 0


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
    from rocking.configuration import config

    own = config.resolve(
        {
            "models": ["W1", "W2m", "W1c"],
            "facade": {"height_m": 7.2},
            "return_wall": {"building_mass_kg": 1.2e5},
        }
    )
    line = words.of_run("mine", own)
    case = Case.configured("W1", {"facade.height_m": 7.2})
    assert line.startswith("mine: by the formula")
    assert f"W1 {estimate(case).median:.2g} g" in line
    assert "W2m" in line
    assert "W1c" not in line
    assert words.of_runs({"default": config.resolve({"models": ["W1"]})}) == []
    assert (
        words.of_run("slow", config.resolve({"models": ["W2"], "smdof": {"period_s": 3.0}})) == ""
    )


def test_a_computed_median_far_from_the_formula_is_remarked_upon():
    found = law.Estimate("W2m", "pga_g", 0.3, 0.4, 0.05)
    edge = math.exp(2.0 * math.hypot(0.05, 0.4 / 4.0))
    assert words.remark(found, 0.3 * 0.99 * edge, 16) == ""
    assert "more than" in words.remark(found, 0.3 * 1.01 * edge, 16)
    assert "less than" in words.remark(found, 0.3 / 1.01 / edge, 16)
    assert words.remark(found, 0.3 * 1.01 * edge, 2) == ""  # two motions say little
    assert words.remark(found, math.nan, 16) == ""


def test_an_assessment_says_where_its_median_is_far_from_the_formula():
    from rocking.configuration import config

    own = config.resolve({"models": ["W1"], "facade": {"height_m": 7.2, "base": "column"}})
    by_formula = estimate(Case.configured("W1", {"facade.height_m": 7.2, "facade.base": "column"}))
    rows = [{"model": "W1", "median_pga_g": by_formula.median, "stations": 22}]
    assert words.remarks(own, pd.DataFrame(rows)) == []
    rows[0]["median_pga_g"] *= 5.0
    (said,) = words.remarks(own, pd.DataFrame(rows))
    assert said.startswith("W1: the computed median")
    tables = {
        "parts_dynamic": pd.DataFrame([{**row, "part": part} for row in rows for part in PARTS]),
        "dynamic": pd.DataFrame(rows),
        "code_checks": pd.DataFrame({"pga_demand_g": [0.3]}),
    }
    data = SimpleNamespace(config=own, tables=tables, demand_said="stated", factor=1.35)
    assert report.rests_on(data, "W1").count(said) == 1  # of the whole façade, not of its parts
    own["facade"]["ties"] = [{"height_m": 3.0}]
    assert words.remarks(own, pd.DataFrame(rows)) == []  # no formula, nothing to say


def test_shipped_formula_is_the_one_of_the_shipped_atlas(known):
    """Coefficients and errors follow from config/atlas.csv anew."""
    table, made = pd.read_csv(shipped("config/atlas.csv")), known["made_of"]
    settings = {**SETTINGS, "facades": made["facades"], "seed": made["seed"]}
    settings["ranges"] = made["ranges"]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        of = Case.configured("W2m", {**COLUMN, "facade.base": made["base"]})
    design = atlas.described(of, atlas.design(settings))
    for model, parts in known["models"].items():
        values = fit.wide(table, design, model, atlas.OWN)
        terms = fit.matrix(design.loc[values.index], fit.TERMS[model])
        found = fit.solve(terms, values.to_numpy())
        assert list(fit.TERMS[model]) == parts["pga_g"]["terms"]
        assert found == pytest.approx(parts["pga_g"]["coefficients"], rel=1e-3, abs=1e-3)
        errors, low = fit.facades_out(terms, values.to_numpy())
        checks = parts["pga_g"]["checks"]
        assert fit.rms(errors) == pytest.approx(checks["facades_rms"], abs=1e-3)
        assert fit.rms(low) == pytest.approx(checks["p16_rms"], abs=1e-3)
