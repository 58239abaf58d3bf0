"""The formula and its atlas: design, groups, exact laws found again, refusals."""

import math
import warnings

import numpy as np
import pandas as pd
import pytest
from formula_cases import ROW
from rocking import Motion, estimate
from rocking.formula import groups, law
from rocking.shipped import shipped
from scipy.special import ndtr
from study_cases import study_case

from smdof.spectra import response_spectrum
from studies.atlas import fit, measures
from studies.atlas import study as atlas

COLUMN = {
    "facade.base": "column",
    "damping.law": "eq5",
    "return_wall.building_mass_kg": 1.0e5,
    "facade.thickness_m": 0.45,
}
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
        return study_case("W2m", COLUMN)


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
    soft = study_case("W2m", {**COLUMN, "facade.base": "study", "facade.thickness_m": 0.4})
    hard = study_case("W2m", {**COLUMN, "facade.thickness_m": 0.4})
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
        estimate(study_case(model, {**COLUMN, **change}))
    assert said_of in str(said.value)
    assert "\n" not in str(said.value)


def test_a_stack_of_courses_is_known_by_its_number_and_growth(known):
    rows = [{"name": "courses", "courses": 4, "courses_growth": 1.5}]
    own = {**known, "made_of": {**known["made_of"], "others": rows}}
    stack = {"base": "study", "courses": 4, "courses_growth": 1.5}
    assert law.base_of(**stack, law=own) == "courses"
    assert law.base_of(**{**stack, "courses": 0}, law=own) == "study"
    with pytest.raises(groups.OutsideError, match="4 of growth 1.2: of stacks .* 4 of growth 1.5"):
        law.base_of(**{**stack, "courses_growth": 1.2}, law=own)


def test_the_elastic_wall_in_courses_is_estimated(known, case):
    """Of four courses, growth 1.5: the block's median times a ratio, with both errors."""
    stack = {**COLUMN, "facade.base": "study", "facade.courses": 4, "facade.courses_growth": 1.5}
    found, block = estimate(study_case("W2m", stack)), estimate(case)
    part = known["bases"]["courses"]["W2m"]
    ratio = law.total(part, groups.terms(groups.dimensions(case)))
    assert math.log(found.median / block.median) == pytest.approx(ratio, abs=1e-9)
    assert found.error == pytest.approx(math.hypot(block.error, part["error"]))
    assert 0.9 < found.median / block.median < 1.1  # `column` was made to follow the elastic wall
    with pytest.raises(groups.OutsideError, match="courses = 7 of growth 1.5"):
        estimate(study_case("W2m", {**stack, "facade.courses": 7}))


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
        estimate(study_case("W1c", {"facade.base": "column"}))


def test_w1_does_not_ask_for_the_building():
    case = study_case("W1", {"facade.base": "column", "smdof.period_s": 3.0})
    assert estimate(case).median > 0.0


def test_shipped_formula_is_the_one_of_the_shipped_atlas(known):
    """Coefficients and errors follow from config/atlas.csv anew."""
    table, made = pd.read_csv(shipped("config/atlas.csv")), known["made_of"]
    settings = {**SETTINGS, "facades": made["facades"], "seed": made["seed"]}
    settings["ranges"] = made["ranges"]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        of = study_case("W2m", {**COLUMN, "facade.base": made["base"]})
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
