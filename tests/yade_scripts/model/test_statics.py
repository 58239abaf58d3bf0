"""Pieces at rest: their lean by hand, and that nothing moves before anything shakes it."""

import math
from dataclasses import replace

import numpy as np
import pytest
from reference_solver.stack import StackSolver
from rocking.configuration.schema import ConfigError
from rocking.solver import Motions, history, moving_supports, to_plane
from yade_process import in_yade, resolved

from yade_scripts.model.facade import facade_scene
from yade_scripts.model.rest import DoesNotStandError
from yade_scripts.model.statics import resting

BETA_S = 0.002
FEW = {"nodes_thickness": 9, "nodes_height": 5, "nodes_per_block": 5}
COURSES = {"courses": 4, "courses_growth": 1.5}
FREE = {"friction": 0.0, "load_inertia": None}
LOADS = [
    {"height_m": 3.2, "load_kn": 40.0, "arm_m": 0.1, **FREE},
    {"height_m": 6.48, "load_kn": 30.0, "arm_m": 0.12, **FREE},
]
OUTER = [{"height_m": 6.48, "load_kn": 25.0, "arm_m": 0.3, **FREE}]
TIE = {"height_m": 6.0, "diameter_mm": 20.0, "length_m": 4.0, "count": 2}
LEANS = {
    "floors on the inner half": {"floors": LOADS},
    "a roof on the outer half": {"floors": OUTER},
    "a floor that friction holds": {"floors": [{**row, "friction": 0.4} for row in LOADS]},
    "a setback and a gable": {
        "thickness_steps": [{"z_m": 3.5, "thickness_m": 0.25}],
        "gable_height_m": 1.2,
    },
    "a thrust": {"thrusts": [{"height_m": 6.0, "force_kn": 4.0}]},
    "a tie that pulls": {"floors": OUTER, "ties": [{**TIE, "pretension_kn": 3.0}]},
    "free-standing": {"sides": "two", "floors": LOADS},
    "a wall that leans": {
        "tilt_deg": 0.4,
        "floors": [{**row, "friction": 0.4} for row in LOADS],
        "ties": [{**TIE, "pretension_kn": 3.0}],
        "openings": [{"x_m": 0.0, "z_m": 4.0, "width_m": 1.0, "height_m": 1.5}],
    },
    "a hinge below a held top": {
        "courses": 0,
        "hinges_m": [4.0],
        "floors": [{"height_m": 6.48, "load_kn": 60.0, "arm_m": 0.08, "friction": 0.6}],
    },
}
STILL_S = np.linspace(0.0, 3.0, 301)
MOVED = 1e-3  # of the thickness: what joints slip to bear a thrust


def case_of(facade, model="W1", **sections):
    """Configuration and scene of a façade in courses, and of what the test changes of it."""
    config = resolved(facade={**COURSES, **facade}, models=[model], numerics=FEW, **sections)
    return config, facade_scene(config, model, BETA_S)


def upright(scene):
    """The scene with its pieces upright, settled under what stands on each."""
    blocks = [
        replace(block, displacement_m=(0.0, 0.0, block.displacement_m[2]), rotation_rad=(0,) * 3)
        for block in scene.blocks
    ]
    return replace(scene, blocks=blocks)


def unshaken(scene, config):
    """History by the compiled solver under motions that do not move, over the thickness."""
    still = 0.0 * STILL_S
    supports = [still for _ in moving_supports(scene)]
    numerics = {**config["numerics"], "rest_time_s": 10.0}
    found = history(to_plane(scene), Motions(STILL_S, still, supports), numerics)
    return found.d_m / scene.thickness_m


@pytest.mark.parametrize("kind", LEANS)
def test_nothing_swings_before_anything_shakes(kind):
    config, scene = case_of(LEANS[kind])
    assert np.ptp(unshaken(scene, config)) < MOVED
    # from the upright it would swing about that lean
    swings = unshaken(upright(scene), config)
    assert np.ptp(swings) > 5.0 * np.ptp(unshaken(scene, config))


@pytest.mark.parametrize("model", ["W2", "W2m"])
@pytest.mark.parametrize("kind", ["a roof on the outer half", "a wall that leans"])
def test_reference_and_building_leave_it_where_it_rests(kind, model):
    walls = {"building_mass_kg": 64e3}
    _, scene = case_of(LEANS[kind], model, return_wall=walls)
    columns = {"ground": 0.0 * STILL_S} | {f"floor{j}": 0.0 * STILL_S for j in range(1, 5)}
    found = StackSolver(scene, STILL_S, columns, after_s=0.0).history(1.0)
    assert np.ptp(found.d_m) < MOVED * scene.thickness_m


@pytest.mark.yade
def test_yade_leaves_it_where_it_rests():
    config, scene = case_of(LEANS["a roof on the outer half"])
    columns = {"ground": [0.0] * 101} | {f"floor{j}": [0.0] * 101 for j in range(1, 5)}
    got = in_yade(
        "accuracy_cases", "balanced", config=config, model="W1", beta_s=BETA_S, fraction=0.3,
        time_s=STILL_S[:101].tolist(), columns=columns,
    )  # fmt: skip
    lean = abs(unshaken(scene, config)[0])
    assert lean > 4.0 * MOVED
    assert got["status"] == "ok"
    assert got["peak"] == pytest.approx(lean, abs=MOVED)


def test_lean_under_an_eccentric_load():
    """Joints that stay closed turn by θ_j = M_j/(jkn_j b³w/12), M_j = P e and W u of what leans."""
    load = {"height_m": 6.48, "load_kn": 2.0, "arm_m": 0.2, **FREE}
    _, scene = case_of({"floors": [load]})
    pieces = [block for block in scene.blocks if block.name.startswith("façade")]
    nodes, width_m = scene.nodes, 0.375
    heights = np.array([0.0, *(point[2] for _, point in scene.watched[1:])])
    level = np.array([nodes.position_m[nodes.joint == j][0, 2] for j in range(len(pieces))])
    assert np.sort(level) == pytest.approx(heights)
    kn = np.array([nodes.kn_n_m[nodes.joint == j].sum() for j in range(len(pieces))])
    turning = kn[np.argsort(level)] * width_m**2 / 12.0
    weights = np.array([block.mass_kg * scene.gravity_m_s2 for block in pieces] + [2e3])
    places = np.array([block.centre_m[2] for block in pieces] + [6.48])
    # small rotations, outward positive: K θ = P e + Σ W (lengths of the pieces below a weight) θ
    tops = np.append(heights[1:], 6.48)
    lengths = np.clip(places[:, None] - heights, 0.0, tops - heights)
    apart = np.eye(4) - np.eye(4, k=-1)
    matrix = apart.T @ (turning[:, None] * apart) - np.diag(weights @ lengths)
    arm_m = 0.2 - 0.5 * width_m  # outward of the middle
    theta = np.linalg.solve(matrix, np.append(np.zeros(3), 2e3 * arm_m))
    assert [-block.rotation_rad[0] for block in pieces] == pytest.approx(theta, rel=0.01)


def test_a_wall_that_leans_bends_under_its_weight():
    """K (θ − φ at its base) = Σ W (lengths of the pieces below a weight) θ, of small rotations."""
    lean = math.radians(0.3)
    _, scene = case_of({"tilt_deg": 0.3, "e_mpa": 600.0})
    pieces = [block for block in scene.blocks if block.name.startswith("façade")]
    heights = np.array([0.0, *(point[2] for _, point in scene.watched[1:])])
    joints = [scene.joints.index(name) for name in ("base", "hinge 1", "hinge 2", "hinge 3")]
    kn = np.array([scene.nodes.kn_n_m[scene.nodes.joint == j].sum() for j in joints])
    turning = kn * scene.thickness_m**2 / 12.0
    weights = np.array([block.mass_kg * scene.gravity_m_s2 for block in pieces])
    places = np.array([block.centre_m[2] for block in pieces])
    lengths = np.clip(places[:, None] - heights, 0.0, np.append(heights[1:], 6.48) - heights)
    apart = np.eye(4) - np.eye(4, k=-1)
    matrix = apart.T @ (turning[:, None] * apart) - np.diag(weights @ lengths)
    theta = np.linalg.solve(matrix, [turning[0] * lean, 0.0, 0.0, 0.0])
    assert theta[0] > 1.02 * lean
    assert [-block.rotation_rad[0] for block in pieces] == pytest.approx(theta, rel=0.01)


def test_what_rests_stays_as_it_is():
    for facade in ({}, {"floors": [{"height_m": 6.48, "load_kn": 30.0, **FREE}]}):
        _, scene = case_of(facade)
        assert resting(scene) is scene
        assert all(block.rotation_rad == (0.0, 0.0, 0.0) for block in scene.blocks)


def test_a_load_that_topples_it_is_refused():
    config, _ = case_of({"floors": OUTER})
    (row,) = config["facade"]["floors"]
    facade = {**config["facade"], "floors": [{**row, "load_kn": 200.0, "arm_m": 0.37}]}
    with pytest.raises(DoesNotStandError, match="do not stand under weight and loads"):
        facade_scene({**config, "facade": facade}, "W1", BETA_S)
    with pytest.raises(ConfigError, match="floors: the façade falls by itself, at a tenth"):
        resolved(facade=facade, models=["W1"])
