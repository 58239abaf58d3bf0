"""Experiments: how parameters follow from a specimen, its runs, and a reduced target."""

import json
import math
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml
from forked import snakemake
from rocking.configuration.config import ConfigError
from rocking.mechanics import closed_forms
from rocking.solver import Motions, history, peaks, stable_step, to_plane
from run_script import script

from studies.shared.restitution import TARGETS, e_exp, e_one_sided, rebounds
from studies.validation import specimens
from studies.validation import study as validation
from studies.validation.study import ALONE, SEQUENCE
from yade_scripts.model.base import EDGE, SPREAD
from yade_scripts.model.facade import facade_scene
from yade_scripts.model.models import build_scene

ROOT = Path(__file__).resolve().parents[3]
US1 = ROOT / "config" / "experiments" / "us1"
BLOCKS = ROOT / "config" / "experiments" / "limestone"
RETURN_WALLS = ROOT / "config" / "experiments" / "sorrentino"
FEW = {"numerics.nodes_thickness": 3}


def test_the_modulus_gives_the_period():
    """T of the assembled wall is the stated one; without springs of its own E grows with 1/T²."""
    specimen = validation.read(US1).specimen
    found = specimens.case(specimen, FEW)
    assert 2.0 * math.pi / specimens.first_frequency(found) == pytest.approx(0.091, rel=1e-8)
    assert found["beta_s"] == pytest.approx(0.05 * 0.091 / math.pi, rel=1e-8)
    free = {**specimen, "first_period_s": None}
    free["sections"] = {**specimen["sections"], "facade": {**specimen["sections"]["facade"]}}
    free["sections"]["facade"] |= {"floors": [], "hinges_m": []}
    own = specimens.case(free, FEW)
    moduli = []
    for period in (0.2, 0.1):
        specimens.fit_period(own, period)
        moduli.append(own["facade"]["e_mpa"])
    assert moduli[1] == pytest.approx(4.0 * moduli[0], rel=1e-6)
    with pytest.raises(ConfigError, match=r"first_period_s = 0.001: expected one that some facade"):
        specimens.fit_period(found, 0.001)


def test_bounce_of_a_block():
    """β = 2ζ/ω, ω = √(E/ρ)/h: 3 GPa, 2238 kg/m³ and 0.4 m give 2894.5 rad/s."""
    specimen = validation.read(BLOCKS).specimen
    found = specimens.case(specimen, {"damping": {"bounce": 0.5}}, height_m=0.4)
    assert found["beta_s"] == pytest.approx(1.0 / 2894.5, rel=1e-4)
    assert specimens.case(specimen, {"damping": {"beta_s": 0.002}})["beta_s"] == 0.002


def first_loss(changes):
    """Loss at the first impact of a block of 0.35 m, over Housner's."""
    specimen, h, b = validation.read(BLOCKS).specimen, 0.35, 0.05
    found = specimens.case(specimen, {"facade.e_mpa": 1e5, **changes}, height_m=h)
    scene = facade_scene(found, found["model"], found["beta_s"], release_ratio=0.5)
    rules = {**found["numerics"], "rest_time_s": 1.0, "after_motion_s": 0.0, "overturn_ratio": 10.0}
    got = history(to_plane(scene), Motions([0.0, 0.7], [0.0, 0.0]), rules, sample_s=5e-5)
    turned = rebounds(got.time_s, -got.pose[:, 2] / math.atan2(b, h), sides="two", smallest=1e-3)
    return (1.0 - e_exp(turned)[0]) / (1.5 * b**2 / (b**2 + h**2))


def impact_share(edge=0.0):
    """Share of Housner's loss that a base of dashpots takes, from 2/3 of an even one to 1.

    A block comes down turning about one edge of its base and leaves turning about the other, so
    that J = m b ω in all. Its loss 1 − e is Housner's times the mean arm of that impulse over b/2.
    Where the base only damps and cannot pull, what closes pushes with what it closes by. While the
    block turns about a point s·b from the far edge, the arm is

        b/2 − b s²/(3 (s + 2 ε)),

    and J comes evenly in s from 1 to 0. With a = 2 ε the mean is that of
    1 − (2/3) (1/2 − a + a² ln(1 + 1/a)).

    Parameters
    ----------
    edge : float
        ε, the dashpot along either edge over that spread evenly.
    """
    a = 2.0 * edge
    return 1.0 - (2.0 / 3.0) * (0.5 - a + (a * a * math.log1p(1.0 / a) if a > 0.0 else 0.0))


def test_what_a_base_takes_at_an_impact():
    """No base takes more than its dashpots alone would, and edges take it more than the middle."""
    assert impact_share() == pytest.approx(2.0 / 3.0)
    assert impact_share(1e3) == pytest.approx(1.0, abs=1e-3)
    s = np.linspace(0.0, 1.0, 100001)[1:]
    arm = 0.5 - s**2 / (3.0 * (s + 2.0 * EDGE / SPREAD))
    assert impact_share(EDGE / SPREAD) == pytest.approx(2.0 * arm.mean(), abs=1e-4)
    even, edges = (first_loss({"facade.base": base}) for base in ("study", "column"))
    assert 0.4 < even < impact_share()
    assert even + 0.1 < edges < impact_share(EDGE / SPREAD)


def test_another_model_of_the_same_test(tmp_path):
    """It states what it changes and takes the rest, tables included, from what it is like."""
    shutil.copytree(US1, tmp_path / "us1")
    (tmp_path / "own").mkdir()
    own = {"like": "us1", "sections": {"facade": {"width_m": 2.0}}, "variants": {"one": {}}}
    (tmp_path / "own" / "specimen.yaml").write_text(yaml.safe_dump(own))
    found, other = (validation.read(tmp_path / name) for name in ("own", "us1"))
    assert found.specimen["sections"]["facade"] == {
        **other.specimen["sections"]["facade"],
        "width_m": 2.0,
    }
    assert list(found.specimen["variants"]) == ["one"]
    assert found.measured.equals(other.measured)
    assert [path.parent.name for path in validation.files(tmp_path / "own")] == [
        "own",
        *["us1"] * 3,
    ]
    (tmp_path / "own" / "specimen.yaml").write_text("like: own\n")
    with pytest.raises(ConfigError, match="like: expected another experiment, not own again"):
        validation.read(tmp_path / "own")


@pytest.mark.parametrize(
    "name", ["us1_courses", "us1_inertia", "us1_joists", "us1_shape", "us1_top", "us1_whole"]
)
def test_readings_of_us1(name):
    """Every variant has the first period, by E or by what holds the top."""
    experiment = validation.read(US1.parent / name)
    assert len(experiment.runs) == 24
    for found in specimens.cases(experiment).values():
        assert 2.0 * math.pi / specimens.first_frequency(found) == pytest.approx(0.091, rel=1e-6)
    with pytest.raises(ConfigError, match=r"fitted = facade.width_m: expected facade.e_mpa or"):
        specimens.fit_period(found, 0.091, "facade.width_m")


def peak_at(specimen, height_m):
    """Largest displacement at a height under a smooth pulse that leaves every joint closed [m]."""
    specimen = {**specimen, "observed": {**specimen["observed"], "height_m": height_m}}
    found = specimens.case(specimen, {**FEW, "floors.bearing": "point"})
    t = np.linspace(0.0, 0.5, 501)
    pulse = Motions(t, 0.1 * np.sin(2.0 * np.pi * t) ** 2)
    plane = to_plane(build_scene(found))
    return plane.thickness_m * peaks(plane, pulse, found["numerics"], [1.0]).d_over_b[0]


@pytest.mark.parametrize(("name", "straight"), [("us1_shape", True), ("us1", False)])
def test_shape_of_a_hinged_wall(name, straight):
    """Below its hinge the wall is straight, whatever its foot does; us1 is bent below 2.06 m."""
    specimen = validation.read(US1.parent / name).specimen
    low, middle, high = (peak_at(specimen, z) for z in (0.66, 1.26, 2.06))
    part = (middle - low) / (high - low)
    assert (part == pytest.approx((1.26 - 0.66) / (2.06 - 0.66), rel=1e-3)) == straight
    assert (middle < high) == straight


def test_the_step_a_specimen_states():
    """A fraction of the planar solver's own largest step, an explicit one as it is, or none."""
    specimen = validation.read(US1).specimen
    found = specimens.case(specimen, FEW)
    plane, numerics = to_plane(build_scene(found)), found["numerics"]
    assert numerics["step_fraction"] == 0.1
    assert specimens.planar_step(plane, numerics) == pytest.approx(0.1 * stable_step(plane))
    assert specimens.planar_step(plane, {**numerics, "step_s": 1e-4}) == 1e-4
    assert specimens.planar_step(plane, {**numerics, "step_fraction": None}) is None


def test_free_rocking_against_return_walls():
    """One wall, three impacts: a case by variant and height, stated ranges, both laws of β."""
    experiment = validation.read(RETURN_WALLS)
    found = specimens.cases(experiment)
    assert len(found) == len(experiment.specimen["variants"])
    assert found["β of eq. 5, 0.94 ms|0.8"]["beta_s"] == pytest.approx(
        closed_forms.beta_one_sided(0.11, 0.8, 1800)
    )
    assert 2e-4 < found["β of the fitted law|0.8"]["beta_s"] < 1e-3
    ranges = validation.quartiles(experiment)
    e_1sr = e_one_sided(0.8, 0.11)
    stated = np.array(TARGETS) * e_1sr
    assert ranges[["p25", "p75"]].to_numpy() == pytest.approx(stated, abs=1e-4)
    trials = validation.quartiles(validation.read(BLOCKS))
    assert trials["trials"].sum() == 134
    assert (trials["p25"] <= trials["p75"]).all()


def test_changes_of_a_variant():
    """Every floor, a section's key; the weakest hinge rises as the load shrinks."""
    specimen = validation.read(US1).specimen
    heavy = specimens.case(specimen, {**FEW, "floors.load_kn": 27.1, "facade.friction_deg": 20})
    assert heavy["facade"]["floors"][0]["load_kn"] == 27.1
    assert heavy["facade"]["friction_deg"] == 20.0
    light = specimens.case(specimen, FEW)
    assert light["facade"]["floors"][0]["load_kn"] == 10.35
    assert 0.5 * 2.58 < heavy["facade"]["hinges_m"][0] < light["facade"]["hinges_m"][0]


@pytest.mark.parametrize(("unit", "metres"), [("m/s2", 1.0), ("g", 9.80665), ("m/s", None)])
def test_units_of_a_table_motion(tmp_path, unit, metres):
    """Accelerations in m/s² whatever the file has; a velocity v is differentiated."""
    experiment = validation.read(US1)
    motions = {**experiment.specimen["motions"], "unit": unit}
    own = replace(experiment, specimen={**experiment.specimen, "motions": motions})
    run = experiment.runs.iloc[0]
    t = np.linspace(0.0, 1.0, 401)
    path = tmp_path / motions["files"].format(run=int(run["run"]))
    np.savetxt(path, np.column_stack((t, 0.2 * np.sin(3.0 * t))))
    _, found, source = validation.motion(own, run, str(tmp_path), "")
    assert source == "file"
    slope = 0.6 * np.cos(3.0 * t)
    expected = slope if metres is None else metres * 0.2 * np.sin(3.0 * t)
    assert found == pytest.approx(expected, abs=3e-3)


def test_runs_that_follow_each_other():
    """Spans hold the runs' own peaks, from where each began; what was not reached has none."""
    t = np.linspace(0.0, 1.0, 201)
    pulse = np.sin(2.0 * np.pi * t)
    time_s, ground, spans = validation.one_after_another([(t, pulse), (t, 3.0 * pulse)])
    assert spans[1][0] == pytest.approx(spans[0][1])
    ends = [np.abs(ground[(time_s >= a) & (time_s < b)]).max() for a, b in spans]
    assert ends == pytest.approx([1.0, 3.0])
    drift = np.where(time_s < spans[1][0], 0.0, 5.0)
    found = validation.peaks_of_spans(time_s, ground + drift, spans, "ok")
    assert found == pytest.approx([1.0, 3.0])
    short = time_s < spans[1][0] + 1.5
    cut = time_s[short], ground[short], spans
    assert validation.peaks_of_spans(*cut, "ok") == pytest.approx([1.0, 3.0])
    fell = validation.peaks_of_spans(*cut, "overturned")
    assert fell[0] == pytest.approx(1.0)
    assert math.isnan(fell[1])


def test_ratios():
    """Geometric mean and scatter; a fall fails the goal, whatever the others did."""
    pair = pd.DataFrame({"peak": [2.0, 0.5, np.nan], "measured": 1.0})
    found = validation.ratio(pair, "peak", "measured")
    assert found == pytest.approx((1.0, math.exp(math.sqrt(2) * math.log(2))))
    experiment = validation.read(US1)
    rows = [(7, 1.2, "ok"), (24, 29.0, "ok"), (6, 99.0, "ok")]
    goals = experiment.specimen["goal"]
    table = pd.DataFrame(rows, columns=["run", "peak_mm", "status"]).assign(
        variant="v", how=ALONE, solver="s"
    )
    table = table.merge(experiment.measured, on="run")
    first, other = validation.summary(experiment, table).to_dict("records")
    assert (first["runs"], first["fell"], first["goal_met"]) == (2, 0, 1)
    ratio = [1.2 / 1.236, 29.0 / 29.482]
    assert first["mean"] == pytest.approx(math.sqrt(ratio[0] * ratio[1]))
    assert other["solver"] == "3DEC"
    assert other["runs"] == 11
    table.loc[table["run"] == 24, ["peak_mm", "status"]] = (np.nan, "overturned")
    fallen = validation.summary(experiment, table).to_dict("records")[0]
    assert (fallen["fell"], fallen["goal_met"]) == (1, 0)
    # a mean rests on no run that falls at an amplitude of its band, or on which solvers part
    both = pd.concat([table.assign(solver=s, peak_mm=[1.2, 29.0, 99.0]) for s in ("s", "t")])
    both = both.assign(status="ok", fell=0).reset_index(drop=True)
    for change, left in (
        ({"fell": 1}, (1, 0)),
        ({"peak_mm": 9.5}, (0, 1)),
        ({"peak_mm": 9.9}, (0, 0)),
    ):
        own = both.copy()
        own.loc[1, list(change)] = list(change.values())
        for row in validation.summary(experiment, own).to_dict("records")[:2]:
            assert (row["fell"], row["apart"]) == left
            if left != (0, 0):
                assert row["goal_met"] == 0
                assert row["mean"] == pytest.approx(1.2 / 1.236)
    # two within the goal do not outweigh a third that falls
    late = sorted(experiment.measured["run"][experiment.measured["run"] >= goals["from_run"]])[:3]
    peaks_mm = experiment.measured.set_index("run").loc[late, "measured_mm"].to_numpy()
    table = pd.DataFrame({"run": late, "peak_mm": peaks_mm, "status": "ok"}).assign(
        variant="v", how=ALONE, solver="s"
    )
    table["peak_mm"] *= [1.0, 1.01, np.nan]
    table = table.merge(experiment.measured, on="run")
    for status, met in (("ok", 1), ("overturned", 0)):
        table.loc[table["run"] == late[-1], "status"] = status
        found = validation.summary(experiment, table).to_dict("records")[0]
        assert (found["fell"], found["goal_met"]) == (1 - met, met)


def test_amplitudes_of_a_run_have_a_seed():
    """The same seed, the same factors, all within the band; the first two are the run's own."""
    found = validation.factors(3, 4, 50, 0.1)
    assert np.array_equal(found, validation.factors(3, 4, 50, 0.1))
    assert found[:, 0] == pytest.approx(1.0)
    assert np.abs(found[:, 2:] - 1.0).max() < 0.1 < np.abs(found[:, 2:] - 1.0).max() + 0.02


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("kind", "pendulum", r"specimen.yaml: kind = pendulum: expected shake_table or"),
        ("model", "W9", r"specimen.yaml: model = W9: expected free or W1 or"),
        ("damping", None, r"specimen.yaml: expected damping"),
        ("damping", {"eq5": 1}, r"specimen.yaml: variants.10.35 kN: damping.eq5: expected one of"),
        ("damping", {"law": "eq5"}, r"specimen.yaml: variants.10.35 kN: damping.law = eq5: expe"),
        ("variants", {"a": {"damping": {"law": "eq5"}}}, r"yaml: variants.a: damping.law = eq5: "),
    ],
)
def test_faulty_specimens(tmp_path, key, value, message):
    """One line with the file and what was expected."""
    folder = tmp_path / "own"
    shutil.copytree(US1, folder)
    specimen = yaml.safe_load((folder / "specimen.yaml").read_text("utf-8"))
    if value is None:
        del specimen[key]
    else:
        specimen[key] = value
    (folder / "specimen.yaml").write_text(yaml.safe_dump(specimen))
    with pytest.raises(ConfigError, match=message):
        validation.read(folder)


def test_faulty_tables(tmp_path):
    """A run that was measured but not made, and a column that is missing."""
    folder = tmp_path / "own"
    shutil.copytree(US1, folder)
    (folder / "measured.csv").write_text("run,measured_mm\n99,1.0\n")
    with pytest.raises(ConfigError, match="measured.csv: run 99: expected one of runs.csv"):
        validation.read(folder)
    (folder / "runs.csv").write_text("run,record\n1,A\n")
    with pytest.raises(ConfigError, match="runs.csv: expected columns pga_g"):
        validation.read(folder)


def test_a_folder_without_motions(tmp_path):
    """It stops before anything runs, instead of taking stand-ins unasked."""
    settings = {"validation": {"motions_folder": str(tmp_path), "main_variants": 1}}
    done = script(
        "validation_cases",
        tmp_path,
        checked=False,
        input={"files": [str(US1 / "specimen.yaml")]},
        output={"cases": "cases.json", "tests": "tests.json", "motions": "motions"},
        params={
            "settings": json.dumps(json.dumps(settings)),
            "table": str(ROOT / "config/suites/recorded_suite.tsv"),
        },
    )
    assert done.returncode == 1
    assert "motions_folder = " in done.stderr
    assert "expected files named vel_expfull" in done.stderr


@pytest.mark.yade
def test_the_target_in_a_reduced_form(tmp_path):
    """Two short runs by both solvers: within 0.5 %, and the second finds the wall whole.

    The peak is that of the motion in the files, by a call of the solver beside the target; the
    ratios are those to the measured column.
    """
    folder, tables = tmp_path / "own", tmp_path / "tables"
    shutil.copytree(US1, folder)
    tables.mkdir()
    specimen = yaml.safe_load((folder / "specimen.yaml").read_text("utf-8"))
    specimen["variants"] = {"light": FEW}
    (folder / "specimen.yaml").write_text(yaml.safe_dump(specimen))
    (folder / "runs.csv").write_text("run,record,pga_g\n7,HU12,0.1\n8,HU12,0.1\n")
    (folder / "measured.csv").write_text("run,measured_mm,another_mm\n7,0.3,0.2\n8,0.6,\n")
    t = np.linspace(0.0, 0.6, 121)
    speed = 0.05 * np.sin(2.0 * np.pi * 3.0 * t) * np.sin(np.pi * t / 0.6) ** 2
    for number in (7, 8):
        path = tables / specimen["motions"]["files"].format(run=number)
        np.savetxt(path, np.column_stack((t, speed)))
    settings = f"{{experiments: [{folder}], motions_folder: {tables}, members: 2}}"
    words = ("--config", "run=small", f"validation={settings}", "--", "validation")
    done = snakemake(tmp_path, *words)
    assert done.returncode == 0, done.stderr[-2000:]
    assert (tmp_path / "results/small/figures/validation_shake_table_own.png").stat().st_size > 0
    results = tmp_path / "results/small/validation/own"
    table = pd.read_csv(results / "shake_table.csv")
    assert (table["status"] == "ok").all()
    assert (table["source"] == "file").all()
    by_run = table.set_index(["solver", "how", "run"])
    assert len(by_run) == 8
    found = specimens.case(specimen, FEW)
    plane, numerics = to_plane(build_scene(found)), found["numerics"]
    pulse, step = Motions(t, np.gradient(speed, t)), specimens.planar_step(plane, numerics)
    expected = 210.0 * peaks(plane, pulse, numerics, [1.0], step_s=step).d_over_b[0]
    assert expected > 0.1
    assert by_run.loc[("planar", ALONE, 7), "peak_mm"] == pytest.approx(expected, rel=1e-3)
    assert by_run["peak_mm"].to_numpy() == pytest.approx(np.full(8, expected), rel=5e-3)
    assert by_run.loc[("planar", SEQUENCE, 8), "peak_mm"] == pytest.approx(expected, rel=1e-3)
    ratios = by_run["peak_mm"] / np.where(by_run.index.get_level_values("run") == 7, 0.3, 0.6)
    assert by_run["ratio"].to_numpy() == pytest.approx(ratios.to_numpy(), rel=1e-4)
    means = pd.read_csv(results / "summary.csv").set_index(["solver", "how"])["mean"]
    mean = expected / math.sqrt(0.3 * 0.6)
    assert means.to_dict() == pytest.approx(
        {key: mean for key in by_run.index.droplevel("run").unique()}
        | {("3DEC", ALONE): 0.2 / 0.3},
        rel=5e-3,
    )
