"""Blocks on a shake table: geometry, restitution from corners, and predictions held by digests."""

import math
import shutil
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml
from reference_solver import simulate
from rocking.configuration.config import ConfigError
from rocking.mechanics.closed_forms import restitution_housner
from rocking.solver import Motions, history, peaks, stable_step, to_plane

from studies.overturning import (
    blocks,
    draws,
    geometry,
    lessons,
    others,
    predict,
    rectangles,
    solvers,
    table,
)
from studies.overturning.__main__ import main
from studies.overturning.score import calibration, interval, measures, score

ROOT = Path(__file__).resolve().parents[3]
FOLDER = ROOT / "config" / "predictions" / "overturning"
MADE = [m for m in predict.MODELS if (FOLDER / f"{m}.csv").is_file()]
WIDE, DEEP, HIGH = 0.2, 0.3, 0.6


def box_points(count=15):
    """Points all over the surface of a box, its lowest corner at (1, 2, 3)."""
    line = np.linspace(0.0, 1.0, count)
    grid = np.stack(np.meshgrid(line, line, line), axis=-1).reshape(-1, 3)
    outside = np.any((grid == 0.0) | (grid == 1.0), axis=1)
    return grid[outside] * [WIDE, DEEP, HIGH] + [1.0, 2.0, 3.0]


def standing(corners, mass=350.0, damping=1.0, kn=6e7, inertia=None):
    inertia = inertia or mass * 0.06
    beta = blocks.beta(mass, kn, damping)
    fallen = blocks.fallen_tilt(np.asarray(corners)[:, -2:])
    return blocks.Standing(np.array(corners), mass, (inertia,) * 3, 0.7, kn, beta, fallen)


def test_a_box_has_its_volume_centre_and_inertia():
    solid = geometry.solid(box_points())
    assert solid.volume_m3 == pytest.approx(WIDE * DEEP * HIGH, rel=3e-3)
    assert solid.points_m.min(axis=0) == pytest.approx([-WIDE / 2, -DEEP / 2, -HIGH / 2], abs=1e-4)
    x, y, z = np.square([WIDE, DEEP, HIGH]) / 12.0
    assert np.diag(solid.inertia_m2) == pytest.approx([y + z, x + z, x + y], rel=5e-3)
    assert np.abs(solid.inertia_m2 - np.diag(np.diag(solid.inertia_m2))).max() < 1e-5


def test_a_box_comes_to_rest_on_its_base():
    points = geometry.solid(box_points()).points_m
    tilted = points @ geometry.turned(np.array([0.6, 0.8, 0.0]), 0.1).T
    rest = tilted @ geometry.at_rest(tilted).T
    lowest = rest[:, 2] < rest[:, 2].min() + 1e-6
    assert rest[:, 2].min() == pytest.approx(-HIGH / 2, abs=1e-4)
    assert np.count_nonzero(lowest) >= 15 * 15


@pytest.mark.parametrize("degrees", [0.0, 20.0, 90.0])
def test_the_toe_is_where_the_edge_meets_the_plane_of_shaking(degrees):
    """The nearest of the edges at b/2 over cos ψ, also where a corner reaches farther."""
    points = geometry.solid(box_points()).points_m
    angle = math.radians(degrees)
    toe = min(0.5 * WIDE / max(math.cos(angle), 1e-9), 0.5 * DEEP / max(math.sin(angle), 1e-9))
    chain = geometry.profile(points, angle)
    sole = chain[chain[:, 1] < chain[:, 1].min() + 1e-6]
    assert sole[:, 0].max() == pytest.approx(toe, rel=1e-3)
    assert sole[:, 0].min() == pytest.approx(-toe, rel=1e-3)
    rise, tilt = geometry.barrier(chain, 1)
    assert rise == pytest.approx(math.hypot(toe, HIGH / 2) - HIGH / 2, rel=1e-3)
    assert tilt == pytest.approx(math.atan2(toe, HIGH / 2), abs=5e-3)


def test_corners_in_space_are_those_of_a_box():
    corners = geometry.corners(geometry.solid(box_points()).points_m)
    sole = corners[corners[:, 2] < -HIGH / 2 + 1e-3]
    ends = {tuple(np.sign(np.round(c, 3)[:2])) for c in sole if abs(abs(c[0]) - WIDE / 2) < 1e-3}
    assert {(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)} <= ends


def test_a_random_field_has_its_deviation_and_length():
    rng = np.random.default_rng(1)
    fields = [geometry.field(rng, [[0.0, 0.0], [0.05, 0.0]], 2e-3, 0.05) for _ in range(2000)]
    fields = np.array(fields)
    assert fields.std() == pytest.approx(2e-3, rel=0.05)
    kept = np.corrcoef(fields.T)[0, 1]
    assert kept == pytest.approx(math.exp(-0.5), abs=0.05)


def free_peaks(corners, inertia=None):
    """Successive |θ| of a block that a pulse set rocking."""
    plane = to_plane(blocks.scene(standing(corners, inertia=inertia)))
    time = np.arange(0.0, 5.0, 0.005)
    pulse = Motions(time, np.where(time < 0.15, 3.2, 0.0))
    run = history(plane, pulse, blocks.NUMERICS, step_s=0.1 * stable_step(plane), sample_s=0.0)
    theta, rate = run.pose[:, 2], run.rates[:, 2]
    turning = np.flatnonzero(np.sign(rate[1:]) != np.sign(rate[:-1])) + 1
    found = np.abs(theta[turning])
    return found[found > 0.03]  # beside which what the corners sink is little


def test_restitution_follows_from_the_corners():
    """Two corners keep Housner's share of the rate; one between them lets more of it pass."""
    half, high = 0.06, 0.3
    mass, alpha = 350.0, math.atan2(half, high)
    inertia = mass * (half**2 + high**2) / 3.0
    ends = [[-half, -high], [half, -high]]

    def kept(found):
        energy = math.tan(alpha) * np.sin(found) - (1.0 - np.cos(found))  # over m g h
        return np.sqrt(energy[1:] / energy[:-1])

    housner = kept(free_peaks(ends, inertia))
    assert len(housner) > 3
    assert housner == pytest.approx(restitution_housner(alpha), abs=0.012)
    more = kept(free_peaks([ends[0], [0.0, -high], ends[1]], inertia))
    assert more.min() > housner.max()


@pytest.fixture(scope="module")
def pulses():
    """A block of three corners under half sines that fell it or do not, on either side."""
    made = standing([[-0.16, -0.3], [0.02, -0.302], [0.07, -0.297]])
    time = np.arange(0.0, 1.6, 0.005)
    shape = np.where(time < 0.25, np.sin(math.pi * time / 0.25), 0.0)
    return made, [Motions(time, a * shape) for a in (1.0, -1.0, 3.0, -3.0, 9.0, -9.0)]


def test_both_solvers_agree_which_pulses_overturn(pulses):
    made, motions = pulses
    plane = to_plane(blocks.scene(made))
    step = 0.2 * stable_step(plane)
    planar = peaks(plane, motions, blocks.NUMERICS, np.ones(6), step_s=step).overturned
    assert planar.tolist() == others.fell_by_reference(made, motions).tolist()
    assert set(planar.tolist()) == {True, False}


@pytest.mark.yade
def test_yade_agrees_on_a_block_that_has_no_third_dimension(pulses):
    made, motions = pulses
    plane = to_plane(blocks.scene(made))
    planar = peaks(plane, motions, blocks.NUMERICS, np.ones(6)).overturned
    y, z = made.corners_m.T
    points = np.concatenate([np.column_stack([x + 0.0 * y, y, z]) for x in (-0.3, 0.3)])
    points = np.concatenate([points, [[x, y0, 0.4] for x in (-0.3, 0.3) for y0 in (-0.1, 0.1)]])
    draw = draws.Draw(points, made, np.eye(3) * 0.06)
    found = others.by_yade({"a": draw}, dict(enumerate(motions)), limit_s=300.0)
    assert [found["a", k]["status"] == "fell" for k in range(6)] == planar.tolist()


def test_the_sensor_s_offset_is_no_motion():
    true = np.sin(np.arange(4000) / 7.0) * np.hanning(4000)
    off = table.acceleration(np.round(1e4 * (0.3 * true + 0.015)))
    assert np.abs(off / table.UNIT_M_S2 - 3e3 * (true - true.mean())).max() < 1.0


def test_scores_by_hand():
    """Brier (0.5² + 0² + 1²)/3; a draw more of either outcome keeps the likelihood above 0."""
    found = measures([0.5, 1.0, 1.0], [1, 1, 0], 10)
    assert found["brier"] == pytest.approx(1.25 / 3)
    assert found["correct"] == pytest.approx(1 / 3)
    assert found["likelihood"] == pytest.approx((0.5 * 11 / 12 * 1 / 12) ** (1 / 3))
    assert interval([0.5] * 10) == (2, 8)  # binomial: 5 % below 2, 95 % up to 8
    curve = calibration([0.05, 0.5, 0.5, 0.95], [0, 1, 1, 1])
    assert curve["tests"].tolist() == [1, 0, 2, 0, 1]
    assert (curve["within"] == "yes").all()


@pytest.mark.parametrize("model", MADE)
def test_what_is_committed_is_what_its_digest_says(model):
    predict.read(FOLDER, model)
    said = predict.digests(FOLDER)[model]
    assert said["stated"] == predict.digest(FOLDER / f"{model}.yaml")
    assert said["predicted"] == predict.digest(FOLDER / f"{model}.csv")
    rows = pd.read_csv(FOLDER / f"{model}.csv")
    assert len(rows) == 980
    assert not rows.duplicated(["test", "specimen"]).any()
    assert rows["probability_of_fall"].to_numpy() == pytest.approx(
        rows["fell"] / rows["members"], abs=1e-5
    )


@pytest.fixture
def copy(tmp_path):
    """The prediction, and outcomes made up for three of its tests."""
    shutil.copytree(FOLDER, tmp_path / "mine")
    rows = pd.read_csv(FOLDER / "geometry.csv")
    numbers = rows["test"].unique()[:3]
    pd.DataFrame(
        {
            "test": numbers,
            "motion": "a",
            "pga_g": 0.1,
            "overturned_specimen1": [0, 0, None],
            "overturned_specimen2": [0, None, 1],
        }
    ).to_csv(tmp_path / "tests.csv", index=False)
    return tmp_path


def test_known_outcomes_alone_are_scored(copy):
    scores = score(copy / "mine", copy / "tests.csv", ["geometry"])
    assert scores["tests"].tolist() == [2, 2]
    assert scores["fell"].tolist() == [0, 1]


def test_changed_parameters_are_refused(copy, capsys):
    path = copy / "mine" / "geometry.yaml"
    path.write_text(path.read_text().replace("draws: 24", "draws: 25"))
    words = ["score", str(copy / "mine"), "--data", str(copy / "tests.csv"), "--model", "geometry"]
    assert main(words) == 1
    assert "geometry.yaml: not what digest.txt says" in capsys.readouterr().err


def test_what_is_no_outcome_is_refused(copy):
    tests = pd.read_csv(copy / "tests.csv").astype({"overturned_specimen1": object})
    tests.loc[0, "overturned_specimen1"] = "fell"
    tests.to_csv(copy / "tests.csv", index=False)
    with pytest.raises(ConfigError, match="overturned_specimen1 = fell: expected 0, 1 or blank"):
        score(copy / "mine", copy / "tests.csv", ["geometry"])


def test_absent_data_are_one_line(tmp_path, capsys):
    assert main(["run", str(FOLDER), "--data", str(tmp_path), "--model", "geometry"]) == 1
    assert capsys.readouterr().err.count("\n") == 1


def test_a_draw_is_the_same_for_the_same_number():
    stated = yaml.safe_load((FOLDER / "geometry.yaml").read_text("utf-8"))
    solid = geometry.solid(box_points())
    one, same, other = (draws.draw(stated, solid, 100.0, 0.0, k, 1) for k in (3, 3, 4))
    assert np.array_equal(one.standing.corners_m, same.standing.corners_m)
    assert one.standing.friction_rad != other.standing.friction_rad


@pytest.fixture
def waiting(tmp_path):
    """The folder that waits for rectangular blocks, with two tests under a pulse filled in."""
    shutil.copytree(FOLDER.parent / "rocking_blocks", tmp_path / "mine")
    time = np.arange(0.0, 2.0, 0.005)
    pulse = np.where(time < 0.4, 4.0 * np.sin(math.pi * time / 0.4), 0.0)
    np.savetxt(tmp_path / "m.csv", np.column_stack([time, pulse]), delimiter=",")
    with open(tmp_path / "mine" / "tests.csv", "a") as file:
        file.write("1,0.17,0.98,200,m.csv,1.0,fell\n2,0.17,0.98,200,m.csv,0.3,stood\n")
    return tmp_path


def test_a_folder_that_was_filled_in_is_predicted_and_scored(waiting):
    """Uplift takes g b/h = 1.7 m/s²: 1.2 m/s² lifts nothing."""
    found, scores = rectangles.run(waiting / "mine", waiting)
    assert found["probability_of_fall"].tolist() == [1.0, 0.0]
    assert scores["brier"] == 0.0


def test_a_folder_that_waits_says_so(capsys):
    where = str(FOLDER.parent / "rocking_blocks")
    assert main(["blocks", where, "--data", "."]) == 1
    assert "nobody has filled it in yet" in capsys.readouterr().err


def test_a_measure_that_parts_all_tests_foretells_left_out_motions():
    rng = np.random.default_rng(3)
    x = rng.normal(size=200)
    y = (x + 0.3 * rng.normal(size=200) > 0.5).astype(float)
    p = lessons.left_out(x, y, np.arange(200) // 10)
    assert np.mean((p > 0.5) == (y > 0)) > 0.85
    c0, c1 = lessons.logistic(x, y)
    assert -c0 / c1 == pytest.approx(0.5, abs=0.15)


def test_pseudo_velocity_of_a_resonant_motion():
    """A long harmonic motion of the oscillator's own period moves it by a/(2 ζ ω²)."""
    omega = 2.0 * math.pi / 0.5
    a = np.sin(omega * np.arange(0.0, 30.0, table.STEP_S))
    assert lessons._pseudo_velocity(a, table.STEP_S, 0.5) == pytest.approx(10.0 / omega, rel=0.02)


def test_histories_far_from_collapse_repeat(pulses):
    made, motions = pulses
    fell, same = solvers.repeated({"step_fraction": 0.4}, made, motions)
    assert same.all()
    assert set(fell.tolist()) == {True, False}


def test_agreement_counts_what_repeats():
    """Of three that repeat the reference agrees in two; YADE ran two, of which one repeats."""
    rows = [(1, 1, 1, 1), (0, 1, 1, None), (1, 0, 0, 0), (0, 1, 0, None)]
    found = pd.DataFrame(rows, columns=["planar", "repeats", "reference", "yade"])
    counts = solvers.agreement(found.astype({"yade": "Int64"}))
    assert (counts["repeat"], counts["reference agrees"], counts["of all"]) == (3, 2, 2)
    assert (counts["in space"], counts["of these repeat"], counts["space agrees"]) == (2, 1, 1)
    assert (counts["falls in the plane"], counts["falls in space"]) == (2, 1)


def test_errors_are_counted_by_what_tests_have_in_common(tmp_path, monkeypatch):
    """Predictions that are all 0 are wrong where a block fell, and by as much too low."""
    numbers = np.arange(8)
    pd.DataFrame(
        {"test": numbers, "specimen": 1, "members": 4, "fell": 0, "probability_of_fall": 0.0}
    ).to_csv(tmp_path / "geometry.csv", index=False)
    tests = {"test": numbers, "motion": "a", "pga_g": 0.1 * (1 + numbers)}
    tests |= {"overturned_specimen1": numbers // 4, "overturned_specimen2": None}
    pd.DataFrame(tests).to_csv(tmp_path / "tests.csv", index=False)
    size = 0.1 * (1.0 + numbers)
    own = pd.DataFrame({"pga_g": size, "pgv_m_s": size, "strong_s": size}, index=numbers)
    monkeypatch.setattr(lessons, "of_tests", lambda folder: own)
    found = lessons.errors(tmp_path, tmp_path, "geometry")
    by = found[found["by"] == "pgv_m_s"]
    assert by["wrong"].tolist() == [0, 0, 2, 2]
    assert by["mean p - y"].tolist() == [0.0, 0.0, -1.0, -1.0]


def test_both_solvers_start_a_block_at_rest(pulses):
    """Nothing moves without a motion but by what friction takes up at the start, 2e-5 rad."""
    made, _ = pulses
    still = Motions(np.arange(0.0, 0.5, 0.005), np.zeros(100))
    plane = to_plane(blocks.scene(made))
    run = history(plane, still, blocks.NUMERICS, step_s=0.1 * stable_step(plane))
    assert np.ptp(run.pose[:, 2]) < 5e-5
    wall = others.Footed(made)
    assert wall.rest_rad == pytest.approx(-run.pose[0, 2])
    assert abs(wall.rest_rad) > 1e-3
    angle = wall.rest_rad / wall.alpha_rad
    free = simulate(wall, None, 0.3, angle, tolerance=1e-7)
    assert np.abs(free.theta_rad - wall.rest_rad).max() < 5e-5


def test_a_stated_direction_turns_into_the_plane_of_a_draw():
    """Of a smooth box shaken 30° off its short side: toes where the edges meet the plane."""
    stated = yaml.safe_load((FOLDER / "geometry.yaml").read_text("utf-8"))
    stated["specimens"][1]["direction_deg"] = 30.0
    stated["centre_of_mass_deviation_mm"] = stated["contact"]["roughness_mm"] = 0.0
    solid = geometry.solid(box_points())
    one = draws.draw(stated, solid, 100.0, 0.0, 3, 1)
    toe = 0.5 * WIDE / math.cos(math.radians(30.0))
    assert one.standing.corners_m[:, 0].max() == pytest.approx(toe, rel=2e-3)
    x, y = (math.cos(math.radians(30.0)), math.sin(math.radians(30.0)))
    across = np.array([y, -x, 0.0])
    about = across @ solid.inertia_m2 @ across
    assert one.standing.inertia_kg_m2[0] == pytest.approx(100.0 * about, rel=1e-6)


def test_the_third_dimension_has_the_width_of_the_plane(pulses):
    made, _ = pulses
    points = geometry.solid(box_points()).points_m
    wide, narrow = (
        others.in_space(draws.Draw(points, made, np.eye(3), width)) for width in (1.0, 0.5)
    )
    assert narrow.corners_m[:, 1] == pytest.approx(0.5 * wide.corners_m[:, 1])
    assert narrow.corners_m[:, [0, 2]] == pytest.approx(wide.corners_m[:, [0, 2]])
