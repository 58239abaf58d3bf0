"""Parts of the scatter, sensitivities and samples against closed forms."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from rocking import Case, Motion, collapse_curve
from rocking.collapse.case import LAW_FILE
from rocking.configuration.config import ConfigError
from rocking.mechanics.beta import beta_for
from rocking.runs import Runs
from study_cases import study_settings
from yade_process import resolved

from studies.shared import fragility
from studies.uncertainty import design, parts, sampling
from studies.uncertainty.design import sampled_motions
from yade_scripts.model.facade import joint_stiffness
from yade_scripts.model.models import build_scene


def drawn(job, factor):
    """Case file with the parameters times their factors."""
    case = Case(job)
    return case.varied(sampling.variant(case, factor)).sections


SLOPES = np.array([0.30, -0.15, 0.05, 0.0])
MODELS = np.array([-0.12, 0.0, 0.12])
PARAMETERS = [
    {"parameter": name, "distribution": kind, "spread": spread, "source": "a test"}
    for name, kind, spread in (
        ("e_mpa", "lognormal", 0.3),
        ("thickness_m", "uniform", 0.1),
        ("friction", "lognormal", 0.2),
        ("length_m", "lognormal", 0.2),
    )
]
SETTINGS = {"samples": 64, "sampling": "sobol", "seed": 4, "parameters": PARAMETERS, "motions": 5}


def additive(motions, rng, mixed=0.1, noise=0.05, crossed=0.0):
    """Scores, and ln C of an additive answer with what motions do to points and to models."""
    z = sampling.scores(SETTINGS)
    record = 0.4 * rng.standard_normal(motions)
    y = record[:, None, None] + (z @ SLOPES)[None, :, None] + MODELS[None, None, :]
    y = y + mixed * rng.standard_normal((motions, len(z), 1))
    y = y + crossed * rng.standard_normal((motions, 1, len(MODELS)))
    return z, y + noise * rng.standard_normal(y.shape)


def test_parts_of_an_additive_lognormal_answer():
    """Variances 0.16, Σc², mean of squares of the models' shifts, the mixed parts and the noise.

    Of what a motion does to each model apart, s², the mean over the models, s²/3, is the motion's.
    Unbiased: the mean of 300 designs is within three standard errors of each, and within 3 % of
    the whole; absent interactions come out as nothing.
    """
    rng = np.random.default_rng(7)
    designs = (additive(6, rng, mixed=0.3, crossed=0.15)[1] for _ in range(300))
    found = pd.DataFrame([parts.components(y, 0.05**2) for y in designs])
    exact = dict.fromkeys(parts.PARTS, 0.0) | {
        "motion": 0.16 + 0.15**2 / 3.0,
        "motion x model": 0.15**2 * 2.0 / 3.0,
        "material": float(SLOPES @ SLOPES),
        "model": float(np.mean(MODELS**2)),
        "motion x material": 0.09,
        "numerical": 0.0025,
    }
    for name, value in exact.items():
        error = 3.0 * found[name].std() / np.sqrt(len(found))
        # the points are the same in every design: their own variance is off by what fills space
        assert found[name].mean() == pytest.approx(value, abs=error + 0.01 * value + 1e-12), name
    assert found.sum(axis=1).mean() == pytest.approx(sum(exact.values()), rel=0.03)


def test_intervals_hold_the_truth_and_the_total_is_the_likelihoods():
    """Of 20 designs the 90 % interval of each large part holds the truth in 15 or more."""
    rng = np.random.default_rng(11)
    exact = {"motion": 0.4, "material": np.sqrt(SLOPES @ SLOPES)}
    held = dict.fromkeys(exact, 0)
    for _ in range(20):
        _, y = additive(16, rng)
        table = parts.table_of_parts(y, 0.05**2, 0.9).set_index("part")
        for name, value in exact.items():
            held[name] += table.loc[name, "beta_low"] <= value <= table.loc[name, "beta_high"]
        assert table["share"].drop("total").sum() == pytest.approx(1.0)
        capacity = np.exp(y).ravel()
        fit = fragility.fit(0.999 * capacity, 1.001 * capacity)
        assert fit.dispersion == pytest.approx(table.loc["total", "beta"], rel=0.05)
    assert min(held.values()) >= 15


def test_indices_of_a_linear_answer():
    """c_i²/Σc² where nothing else scatters; an idle parameter's interval holds zero otherwise."""
    rng = np.random.default_rng(3)
    z, y = additive(12, rng, mixed=0.0, noise=0.0)
    slope, index, r_squared = parts.first_order(z, y[:, :, 0])
    assert slope == pytest.approx(SLOPES, abs=1e-12)
    assert index == pytest.approx(SLOPES**2 / (SLOPES @ SLOPES), abs=0.02)
    assert r_squared == pytest.approx(1.0)
    z, y = additive(12, rng)
    table = parts.sensitivities(z, y[:, :, 1], 0.9)
    assert table["index_low"].iloc[3] <= 0.0 <= table["index_high"].iloc[3]
    assert table["index"].iloc[0] > 0.6
    assert table["slope_low"].iloc[1] < -0.15 < table["slope_high"].iloc[1]


def test_the_scatter_of_repeated_cells_is_the_noise():
    rng = np.random.default_rng(5)
    rows = [(f"r{i}", t, "W1", k) for i in range(40) for t in range(20) for k in (0, 1)]
    table = pd.DataFrame(rows, columns=["record", "sample", "model", "replicate"])
    table["pga_median_g"] = np.exp(0.3 * table["sample"] + 0.04 * rng.standard_normal(len(table)))
    assert parts.numerical_variance(table) == pytest.approx(0.04**2, rel=0.1)
    y, records, models = parts.cube(table)
    assert y.shape == (40, 19, 1)
    table.loc[2, "pga_median_g"] = np.nan  # a cell that never collapsed takes its motion along
    assert parts.cube(table)[1] == records[1:] or "r0" not in parts.cube(table)[1]
    assert models == ["W1"]


@pytest.mark.parametrize("kind", ["sobol", "lhs"])
def test_samples_have_the_stated_distributions(kind):
    """Medians first, then ln factor of the stated spread; the same seed, the same digits."""
    settings = {**SETTINGS, "sampling": kind, "samples": 256}
    table = sampling.factors(settings)
    assert (table.iloc[sampling.MEDIAN] == 1.0).all()
    drawn = table.iloc[1:]
    assert np.log(drawn["e_mpa"]).std() == pytest.approx(0.3, rel=0.05)
    assert drawn["thickness_m"].min() > 0.9
    assert drawn["thickness_m"].max() < 1.1
    assert drawn["thickness_m"].std() == pytest.approx(0.1 / np.sqrt(3.0), rel=0.05)
    assert sampling.factors(settings).equals(table)
    assert not sampling.factors({**settings, "seed": 5}).equals(table)
    correlation = np.corrcoef(sampling.scores(settings).T) - np.eye(len(PARAMETERS))
    assert np.abs(correlation).max() < 0.15


def test_sobol_points_come_in_powers_of_two():
    with pytest.raises(ValueError, match=r"uncertainty\.samples = 12: expected a power of two"):
        sampling.scores({**SETTINGS, "samples": 12})
    with pytest.raises(ValueError, match=r"uncertainty\.samples = 7: expected at least 8, two"):
        sampling.scores({**SETTINGS, "samples": 7})


def test_a_varied_scene_has_what_the_factors_say():
    """Friction by its coefficient; E on base and back joint, the length on the back joint alone."""
    job = {**resolved(), "beta_s": 0.002}
    new = drawn(job, {"e_mpa": 2.0, "friction": 0.5, "length_m": 4.0, "beta_s": 3.0})
    base, back = joint_stiffness(job)
    assert joint_stiffness(new) == pytest.approx((2.0 * base, 0.5 * back))
    for section in ("facade", "return_wall"):
        tangent = np.tan(np.radians(new[section]["friction_deg"]))
        assert tangent == pytest.approx(0.5 * np.tan(np.radians(30.0)))
    assert new["beta_s"] == pytest.approx(0.006)
    assert job["return_wall"]["length_m"] is None
    assert drawn(job, {"period_s": 1.1})["smdof"]["period_s"] == pytest.approx(0.297)
    weak = {**job, "smdof": {**job["smdof"], "base_shear_ratio": 0.2}}
    assert drawn(weak, {"base_shear_ratio": 0.5})["smdof"]["base_shear_ratio"] == 0.1


def test_the_strength_of_an_elastic_building_is_not_drawn():
    one = {**PARAMETERS[0], "parameter": "base_shear_ratio"}
    settings = resolved(uncertainty={"parameters": [one]})
    runs = SimpleNamespace(settings={"main": settings}, records={"main": []}, tables={})
    with pytest.raises(ValueError, match="base_shear_ratio of a building that stays elastic"):
        sampled_motions(runs, "main")


def test_each_base_is_a_form_of_its_own():
    """The run's own case as it is; on the other base the joint of 2.8 E/h and that base's β."""
    own = Case({**resolved(damping={"law": "fitted"}), "model": "W1"}).calibrated()
    assert design.forms(own, [], LAW_FILE) == {"W1": own}
    found = design.forms(own, ["study", "column"], LAW_FILE)
    assert list(found) == ["W1", "W1 column"]
    assert found["W1"] is own
    other = found["W1 column"]
    assert other["facade"] == {**own["facade"], "base": "column"}
    assert other["beta_s"] == pytest.approx(beta_for(other.sections))
    assert other["beta_s"] < own["beta_s"]
    scene = build_scene(other.varied(sampling.variant(other, {"e_mpa": 2.0})).sections)
    kn = scene.nodes.kn_n_m[scene.nodes.joint == scene.joints.index("base")].sum()
    area = own["facade"]["thickness_m"] * own["facade"]["width_m"]
    assert kn == pytest.approx(2.8 * 2.0 * joint_stiffness(own.sections)[0] * area)
    with pytest.raises(ConfigError, match=r"uncertainty\.bases = column: expected study with"):
        study_settings(
            {"uncertainty": {"bases": ["column"]}, "facade": {"base_stiffness_pa_m": 1e9}}
        )


def test_motions_are_drawn_by_the_seed():
    names = [f"r{i}" for i in range(30)]
    drawn = sampling.motions(names, ["pos", "neg"], SETTINGS)
    assert len(drawn) == 5
    assert set(drawn.values()) <= {"pos", "neg"}
    assert drawn == sampling.motions(names, ["pos", "neg"], SETTINGS)
    assert sampling.motions(names[:3], ["neg"], SETTINGS) == dict.fromkeys(names[:3], "neg")


def test_the_study_draws_short_records_and_refuses_what_cannot_be():
    """Through the configuration: durations from the table, and one line before any work."""
    root = Path(__file__).parents[2]
    suite = {"records_table": "config/suites/recorded_suite.tsv"}

    def drawn(**section):
        return sampled_motions(Runs({**suite, "uncertainty": section}, root), "main")

    short = drawn(max_duration_s=24.0, motions=4)
    assert len(short) == 4
    assert {name.split("_")[0] for name in short} <= {"GMN", "IS106", "IS113"}
    assert set(short.values()) <= {"pos", "neg"}
    with pytest.raises(ValueError, match="uncertainty: 2 records of at most 10 s"):
        drawn(max_duration_s=10.0)
    with pytest.raises(ValueError, match=r"uncertainty\.samples = 20: expected a power of two"):
        drawn(samples=20)


@pytest.mark.yade
def test_a_cell_in_yade_is_the_planar_cell():
    """A façade with drawn properties under a burst: outcome, and d/b within 1 %."""
    few = dict.fromkeys(("nodes_thickness", "nodes_height"), 17)
    job = {**resolved(numerics={**few, "step_fraction": 0.1}), "model": "W1", "beta_s": 0.00276}
    case = Case(drawn(job, {"e_mpa": 1.3, "friction": 0.9, "thickness_m": 1.05}))
    t = np.linspace(0.0, 1.2, 121)
    ground = np.sin(np.pi * t / 1.2) ** 2 * np.sin(2.0 * np.pi * t / 0.6)
    motion = Motion.sampled(ground, t[1])
    how = {"search": "list", "settings": {"pga_g": [0.15]}}
    planar, yade = (
        collapse_curve(case, motion, "neg", solver=solver, **how).table.iloc[0]
        for solver in ("planar", "yade")
    )
    assert yade["status"] == planar["status"] == "ok"
    assert planar["d_over_b"] > 0.02
    assert yade["d_over_b"] == pytest.approx(planar["d_over_b"], rel=0.01)
