"""The reference solver of stacks: the adaptive one, the chain, its energy, its own convergence."""

from dataclasses import replace

import numpy as np
import pytest
from both_solvers import pulses
from reference_solver import simulate
from reference_solver.facade import answers, motion_of, one_block, outcomes, wall_of
from reference_solver.stack import StackSolver
from rocking.solver import Motions, history, moving_supports, to_plane
from study_cases import study_case
from yade_process import resolved

from smdof import floor_motions, shear_chain
from yade_scripts.model import floor_motions as files
from yade_scripts.model.facade import facade_scene
from yade_scripts.model.scene import BOND

BETA_S = 0.00276
NINE = dict.fromkeys(("nodes_thickness", "nodes_height", "nodes_per_block"), 9)
COURSES = {"courses": 4, "courses_growth": 1.5}
HEAVY = {"building_mass_kg": 64000.0}
AMPLITUDE = 0.8  # m/s², of `pulses`


def scene_of(model, facade=(), walls=(), beta_s=BETA_S, **numerics):
    config = resolved(facade=dict(facade), return_wall=dict(walls), numerics={**NINE, **numerics})
    return facade_scene(config, model, beta_s), config


def moved(amplitude=AMPLITUDE, floors=4, vertical=False):
    """Times, and motions of ground and floors that grow up the building."""
    time_s, ground = pulses(amplitude)
    columns = {"ground": ground}
    columns |= {f"floor{j}": ground * (1.0 + 0.1 * j) for j in range(1, floors + 1)}
    return time_s, columns | ({"vertical": 0.7 * ground[::-1]} if vertical else {})


def series(scene, amplitude=AMPLITUDE, how=None, **options):
    return StackSolver(scene, *moved(amplitude), **options).history(1.0, **(how or {}))


def answer_of_the_chain(config):
    """Times and floor motions of a configuration's chain under the pulses, and while it rings."""
    chain, (_, ground) = config["smdof"], pulses(AMPLITUDE)
    own = shear_chain(chain["n_dof"], chain["period_s"])
    how = own, chain["damping_ratio"], chain["damping_model"]
    motion = floor_motions(ground, 0.01, *how, tail_s=1.0)
    return 0.01 / motion.refine * np.arange(motion.ground_m_s2.size), motion


@pytest.mark.parametrize("bounded", [True, False])
def test_free_rocking_is_that_of_the_adaptive_solver(bounded):
    """Successive rebounds from θ0/α = 0.5 against one return wall."""
    config, beta_s = resolved(numerics=NINE), 3e-4
    scene = facade_scene(config, "W1", beta_s, release_ratio=0.5)
    case = {**config, "model": "W1", "beta_s": beta_s}
    wall = replace(wall_of(case, 9), bounded=bounded)
    expected = simulate(wall, duration_s=6.0, theta0_over_alpha=0.5, tolerance=1e-7)
    expected = expected.rebounds(0.02)
    still = {"ground": np.zeros(601)}
    solver = StackSolver(scene, 0.01 * np.arange(601), still, bounded=bounded, after_s=0.0)
    found = solver.history(1.0, sample_s=1e-4)
    theta = -found.place[:, 1, 2] / wall.alpha_rad
    edges = np.flatnonzero((theta[:-1] > 0.0) & (theta[1:] <= 0.0)) + 1
    peaks = [part.max() for part in np.split(theta, edges)[1:]]
    assert len(expected) >= 3
    assert peaks[: len(expected)] == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("model", ["free", "W1", "W2"])
@pytest.mark.parametrize("friction", [5.0, 30.0])
def test_one_block_shaken_is_that_of_the_adaptive_solver(model, friction):
    sliding = {"friction_deg": friction}
    scene, config = scene_of(model, sliding, sliding)
    time_s, columns = moved()
    case = {**config, "model": model, "beta_s": BETA_S}
    wall = wall_of(case, 9)
    other = simulate(wall, motion_of(time_s, columns, model), tolerance=1e-7)
    found = StackSolver(scene, time_s, columns).peaks([1.0])
    assert 0.1 < found.d_over_b[0] < 1.0
    assert found.d_over_b[0] == pytest.approx(np.abs(other.d_over_b).max(), rel=1e-3)


def test_slips_that_are_kept_while_open_tell_where_something_opens():
    """On its base alone a façade that does not rock is the same; one that does is not."""
    scene, _ = scene_of("free")
    peaks = [
        [StackSolver(scene, *moved(a), keeps=keeps).peaks([1.0]).d_over_b[0] for a in (0.05, 0.8)]
        for keeps in (False, True)
    ]
    (still, rocks), (still_kept, rocks_kept) = peaks
    assert still_kept == still > 0.0
    assert abs(rocks_kept - rocks) > 1e-6 * rocks > 1e-8


@pytest.mark.slow
def test_a_building_too_heavy_to_be_pushed_is_one_that_is_driven():
    """W2m with 1e9 kg and W2 under the floor motions of the same chain."""
    driven, config = scene_of("W2")
    time_s, motion = answer_of_the_chain(config)
    columns = {"ground": motion.ground_m_s2}
    columns |= {f"floor{j}": floor for j, floor in enumerate(motion.floors_m_s2, 1)}
    carried, _ = scene_of("W2m", walls={"building_mass_kg": 1e9})
    peaks = [
        StackSolver(scene, time_s, columns).peaks([1.0]).d_over_b[0] for scene in (driven, carried)
    ]
    assert peaks[1] == pytest.approx(peaks[0], rel=2e-3)
    assert 0.1 < peaks[0] < 1.0


def test_the_chain_alone_moves_as_the_modes_say():
    """Masses before a façade that is far away follow smdof's modal answer, 5 % in every mode."""
    scene, config = scene_of("W2m", walls=HEAVY)
    scene.nodes.gap_m[scene.nodes.b != 0] = 10.0
    time_s, motion = answer_of_the_chain(config)
    solver = StackSolver(scene, time_s, {"ground": motion.ground_m_s2}, after_s=0.0)
    sample_s = time_s[1] - time_s[0]
    found = solver.history(1.0, sample_s=solver.step_s, until_s=time_s[-1], stop_d_over_b=1e9)
    masses = [i for i, b in enumerate(scene.blocks) if b.free == "y"]
    rows = np.searchsorted(found.time_s, time_s[:-1] - 1e-3 * sample_s)
    places = found.place[rows][:, masses, 0].T
    expected = motion.relative_m[:, : places.shape[1]]
    assert np.abs(places - expected).max() < 2e-3 * np.abs(expected).max()


@pytest.mark.slow
def test_pieces_on_a_stiff_joint_are_one_block():
    """Two pieces on a joint 300 times as stiff, which slides nowhere: the whole block's peak."""
    whole, _ = scene_of("W2")
    pieces, _ = scene_of("W2", {"hinges_m": [2.0]})
    nodes, joint = pieces.nodes, pieces.joints.index("hinge 1")
    stiff, rough = np.where(nodes.joint == joint, [[300.0], [14.0]], [[1.0], [1.0]])
    changed = {"kn_n_m": nodes.kn_n_m * stiff, "ks_n_m": nodes.ks_n_m * stiff}
    changed["friction_rad"] = np.arctan(rough * np.tan(nodes.friction_rad))
    pinned = replace(pieces, nodes=nodes.select(slice(None), **changed))
    first, loose, held = (
        StackSolver(scene, *moved()).peaks([1.0], step_s=2e-5).d_over_b[0]
        for scene in (whole, pieces, pinned)
    )
    assert held == pytest.approx(first, rel=0.01)
    assert abs(loose / first - 1.0) > 0.03


@pytest.mark.parametrize("model", ["W1", "W2m"])
def test_energy_of_courses_closes_and_nothing_gives_any(model):
    """Input is kinetic, stored and spent to 1e-4; what is spent never comes back."""
    scene, _ = scene_of(model, COURSES, HEAVY)
    found = series(scene)
    largest = np.abs(found.input_j).max()
    assert 0.1 < found.peak_d_over_b < 1.0
    assert np.abs(found.closure_j).max() < 1e-4 * largest
    assert np.diff(found.spent_j).min() > -1e-6 * largest
    assert found.spent_j[-1] > 0.5 * largest


def test_energy_closes_with_ties_floors_and_vertical_motion():
    tie = {"height_m": 5.0, "diameter_mm": 12, "length_m": 2.0, "count": 1, "e_mpa": 200000}
    tie |= {"yield_mpa": 235, "anchor_kn": None, "elongation": 0.05, "slack_mm": 5.0}
    config = study_case("W1").sections
    case = study_case(
        "W1",
        {"facade.ties": [{**tie}], "facade.floors": [floor()], "facade.gap_m": 0.002}
        | {f"numerics.{key}": 9 for key in NINE},
    )
    scene = facade_scene(case.sections, "W1", config["beta_s"])
    time_s, columns = moved(1.6, vertical=True)
    found = StackSolver(scene, time_s, columns).history(1.0)
    largest = np.abs(found.input_j).max()
    assert np.abs(found.closure_j).max() < 1e-4 * largest
    assert np.diff(found.spent_j).min() > -1e-6 * largest


def floor():
    row = {"height_m": 3.2, "load_kn": 10.0, "bearing": "point", "friction": 0.2}
    row |= {"anchor_kn": 1.0, "anchor_reach_m": 0.2, "stiffness_kn_m": 20000.0, "mass_t": 0.0}
    return row | {"period_s": 0.3, "arm_m": None, "load_inertia": None}


@pytest.mark.slow
def test_it_converges_in_the_step_and_in_the_nodes():
    """At the default step and the one twice as long within 0.2 % of a quarter; nodes too."""
    scene, _ = scene_of("W2m", COURSES, HEAVY)
    solver = StackSolver(scene, *moved())
    fine = solver.peaks([1.0], step_s=1e-5).d_over_b[0]
    errors = [abs(solver.peaks([1.0], step_s=h).d_over_b[0] / fine - 1.0) for h in (8e-5, 4e-5)]
    assert max(errors) < 2e-3
    by_nodes = []
    for count in (5, 17, 33):
        numerics = dict.fromkeys(NINE, count)
        layout, _ = scene_of("W2m", COURSES, HEAVY, **numerics)
        by_nodes.append(StackSolver(layout, *moved()).peaks([1.0]).d_over_b[0])
    few, many, most = by_nodes
    assert abs(many / most - 1.0) < 3e-3
    assert abs(few / most - 1.0) > abs(many / most - 1.0)


def test_a_step_beyond_stability_is_not_taken():
    """Stiff masonry shortens the solver's own step; at one four times as long energy tells."""
    soft, _ = scene_of("W1", COURSES)
    stiff, _ = scene_of("W1", COURSES | {"e_mpa": 20000.0})
    first, second = StackSolver(soft, *moved()), StackSolver(stiff, *moved())
    assert second.step_s < first.step_s
    own, longer = (
        second.history(1.0, until_s=1.5, step_s=factor * second.step_s) for factor in (1.0, 4.0)
    )
    assert np.abs(own.closure_j).max() < 1e-4 * np.abs(own.input_j).max()
    assert np.abs(longer.closure_j).max() > np.abs(longer.input_j).max()


def test_floors_and_gap_are_those_of_the_compiled_solver():
    """Two routes to one scene: peaks within 1 % where it pulls and slides."""
    rows = {"facade.floors": [floor()], "facade.gap_m": 0.002}
    case = study_case("W1", rows | {f"numerics.{key}": 17 for key in NINE})
    scene = facade_scene(case.sections, "W1", case.sections["beta_s"])
    time_s, columns = moved(1.0)
    supports = [columns[name] for name in moving_supports(scene)]
    planar = history(
        to_plane(scene), Motions(time_s, columns["ground"], supports), case["numerics"]
    )
    found = StackSolver(scene, time_s, columns).peaks([1.0]).d_over_b[0]
    assert found > 0.1
    assert found == pytest.approx(planar.peak_d_over_b, rel=0.01)


@pytest.mark.slow
def test_entry_points_take_what_each_solver_has(tmp_path):
    """W2m and courses are a stack's; a plain block stays the adaptive solver's."""
    numbers = {f"numerics.{key}": 9 for key in NINE}
    plain = study_case("W2", numbers).sections
    courses = study_case("W2", {"facade.courses": 4, "facade.courses_growth": 1.5}).sections
    pushed = study_case("W2m", {"return_wall.building_mass_kg": 64000.0}).sections
    assert [one_block(case) for case in (plain, courses, pushed)] == [True, False, False]
    time_s, columns = moved()
    path = tmp_path / "floors.csv"
    files.write_columns(path, time_s, columns, digits=17)
    peak_g = np.abs(columns["ground"]).max() / 9.80665
    for case in (plain, courses, pushed):
        found = answers(case, (time_s, columns), "pos", [peak_g], nodes=9, tolerance=1e-5)
        again = outcomes(case, path, "pos", [peak_g], nodes=9, tolerance=1e-5)
        assert 0.05 < found.d_over_b[0] < 1.0
        assert again.d_over_b[0] == pytest.approx(found.d_over_b[0], rel=1e-6)


@pytest.mark.parametrize("model", ["W1c", "W2c", "W2cm", "W3", "W3m"])
def test_bonds_and_bricks_are_refused(model):
    case = study_case(model, {"return_wall.building_mass_kg": 64000.0}).sections
    with pytest.raises(
        ValueError, match=f"the reference solver has no model {model}: expected one"
    ):
        answers(case, moved(), "pos", [0.1], nodes=5, tolerance=1e-4)


def test_a_bonded_base_is_refused():
    case = study_case("W1", {"facade.bond_tension_mpa": 0.1}).sections
    with pytest.raises(ValueError, match=r"facade.bond_tension_mpa = 0.1: the reference solver"):
        answers(case, moved(), "pos", [0.1], nodes=5, tolerance=1e-4)


def test_scenes_that_are_not_planar_or_dry_are_refused():
    scene, _ = scene_of("W1")
    full = facade_scene(resolved(numerics=NINE), "W1", BETA_S, planar=False)
    with pytest.raises(ValueError, match="expected a planar scene"):
        StackSolver(full, *moved())
    nodes = scene.nodes.select(slice(None), kind=np.full(len(scene.nodes), BOND))
    with pytest.raises(ValueError, match="expected dry joints"):
        StackSolver(replace(scene, nodes=nodes), *moved())
