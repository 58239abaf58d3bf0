"""Intermediate hinges: mechanisms in closed form, YADE against the compiled solver, matrices."""

from dataclasses import replace

import numpy as np
import pytest
from both_solvers import BETA_S, FEW, agreed, pulses, same_matrices
from rocking.collapse.scan import carried_masses
from rocking.configuration.config import ConfigError
from rocking.mechanics.blocks import weakest_hinge
from rocking.solver.bars import of_scene
from rocking.solver.plane import moving_supports, to_plane
from rocking.solver.runs import Motions, history
from rocking.solver.stack import stack_matrices, stacked
from study_cases import study_settings
from test_floors import ROOF, floored, slow
from test_ties import G
from yade_process import in_yade

from yade_scripts.model.facade import facade_scene
from yade_scripts.model.scene import BOND, observed_at
from yade_scripts.model.stiffness import modes

HELD = {**ROOF, "friction": 0.0, "anchor_kn": 1000.0, "stiffness_kn_m": 1e6}


def multipliers(facade, hinge_m, load_n, arm_m, held_n):
    """λ of the mechanisms with a hinge at h₁, top load N at s, held by F; and the reaction R.

    Held at the top, by the virtual work of a rotation 1 of the lower and r = h₁/h₂ of the upper
    piece, λ = [W₁ b/2 + (W₂ + N) b + r (W₂ b/2 + N s)]/[(W₁ + W₂) h₁/2], and by moments of the
    upper one about the joint's inner edge R h₂ = λ W₂ h₂/2 − W₂ b/2 − N s. Slid, the whole turns
    about its toe, or the upper piece about the joint's outer edge:
    λ W h/2 = W b/2 + N (b − s) + F h, of the piece or of the whole.
    """
    h, b = facade["height_m"], facade["thickness_m"]
    weight = facade["density_kg_m3"] * h * b * facade["width_m"] * G
    h1, h2 = hinge_m, h - hinge_m
    w1, w2, r = weight * h1 / h, weight * h2 / h, h1 / h2
    bent = 0.5 * w1 * b + (w2 + load_n) * b + r * (0.5 * w2 * b + load_n * arm_m)
    bent /= 0.5 * (w1 + w2) * h1
    reaction = bent * 0.5 * w2 - (0.5 * w2 * b + load_n * arm_m) / h2
    whole, upper = (
        (0.5 * w * b + load_n * (b - arm_m) + held_n * tall) / (0.5 * w * tall)
        for w, tall in ((weight, h), (w2, h2))
    )
    return bent, whole, upper, reaction


CAPACITIES = {  # hinge, the floor that holds, which mechanism
    "bending": (3.24, {"load_kn": 0.0}, "bent"),
    "bending, high hinge, overburden": (4.2, {}, "bent"),
    "bending, low hinge": (2.2, {"load_kn": 30.0, "arm_m": 0.3}, "bent"),
    "the whole slides out": (3.24, {"load_kn": 30.0, "anchor_kn": 5.0}, "whole"),
    "the upper piece over a floor": (4.5, {"load_kn": 0.0, "height_m": 4.4}, "upper"),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", CAPACITIES)
def test_static_capacity(name):
    """The multiplier of the mechanism that governs: a push at 0.99 of it is borne, 1.01 fells."""
    hinge, floor, which = CAPACITIES[name]
    roof = {**HELD, **floor}
    config, scene = floored(roof, facade={"e_mpa": 1e5, "hinges_m": [hinge]}, numerics=FEW)
    holds = 1e3 * roof["anchor_kn"] if roof["height_m"] > hinge else 0.0
    given = hinge, 1e3 * roof["load_kn"], roof["arm_m"], holds
    bent, whole, upper, reaction = multipliers(config["facade"], *given)
    if which == "bent":
        assert reaction < holds
        assert bent < min(whole, upper)
    found = {"bent": bent, "whole": whole, "upper": upper}[which]
    for share, status in ((0.99, "ok"), (1.01, "overturned")):
        t, pull = slow(share * G * found)
        got = history(to_plane(scene), Motions(t, -pull), config["numerics"], sample_s=0.01)
        assert got.status == status


@pytest.mark.slow
def test_the_weakest_hinge():
    """It minimises the closed form, and no height is worse under a push."""
    roof = {**HELD, "load_kn": 40.0, "arm_m": 0.1}
    config, _ = floored(roof, facade={"e_mpa": 1e5, "hinges_m": "weakest"}, build=False)
    f = config["facade"]
    heights = np.linspace(0.05, 0.95, 1801) * f["height_m"]
    found = [multipliers(f, z, 40e3, 0.1, 1e6)[0] for z in heights]
    weakest = weakest_hinge(f)
    assert weakest == pytest.approx(heights[np.argmin(found)], rel=0.01)
    t, pull = slow(1.02 * min(found) * G)
    for z, status in ((weakest, "overturned"), (0.7 * weakest, "ok"), (1.2 * weakest, "ok")):
        config, scene = floored(roof, facade={"e_mpa": 1e5, "hinges_m": [z]}, numerics=FEW)
        got = history(to_plane(scene), Motions(t, -pull), config["numerics"], sample_s=0.01)
        assert got.status == status


def node_by_node(scene):
    """The same, whose dashpots along the joints differ by the last digit: they form no groups."""
    more = np.full(len(scene.nodes), np.nextafter(1.0, 2.0))
    return replace(scene, nodes=scene.nodes.select(slice(None), drag=more))


@pytest.mark.parametrize("model", ["W1", "W2"])
def test_one_piece_is_the_single_block(model):
    """All three step loops, through impacts, sliding and a roof with a mass, to rounding."""
    config, scene = floored({**ROOF, "load_kn": 30.0, "mass_t": 2.0}, model=model, numerics=FEW)
    t, ground = pulses(2.0)
    floors = [ground * (1.0 + 0.1 * j) for j in range(1, 5)] if model == "W2" else []
    column = {name: i for i, name in enumerate(moving_supports(scene))}
    scenes = scene, node_by_node(scene)
    stacks = [stacked(s, [1], column, of_scene(s, [1], column)) for s in scenes]
    assert [plane.kn_n_m.size for plane in stacks] == [0, len(scene.nodes)]
    motions = Motions(t, ground, floors)
    one, *others = (
        history(p, motions, config["numerics"], sample_s=0.01) for p in (to_plane(scene), *stacks)
    )
    assert one.peak_d_over_b > 0.1
    for other in others:
        assert other.peak_d_over_b == pytest.approx(one.peak_d_over_b, rel=1e-9)
        assert other.spent_j[-1] == pytest.approx(one.spent_j[-1], rel=1e-9)
        assert other.step_s == pytest.approx(one.step_s, rel=1e-9)


PIECES = {
    "as they are": ("W2", {}, {}),
    "bonds that break": ("W2", {}, {"tension_n": 3e4, "cohesion_n": 6e4}),
    "a setback, a gap behind": ("W2", {"thickness_steps": [{"z_m": 4.0, "thickness_m": 0.25}]}, {}),
    "walls on masses": ("W2m", {}, {}),
}


@pytest.mark.parametrize("name", PIECES)
def test_pieces_by_groups_are_pieces_node_by_node(name):
    """Three that open, slide and let bonds go: forces and dashpots of a line are its nodes'."""
    model, facade, strength = PIECES[name]
    config, scene = floored(*FLOORS, model="W2", facade={**THREE, **facade}, numerics=FEW)
    n = scene.nodes
    mine = n.joint == scene.joints.index("hinge 1")
    changes = {key: pa * n.area_m2 * mine for key, pa in strength.items()}
    if strength:
        changes["kind"] = np.where(mine, BOND, n.kind)
    if "gap" in name:
        changes["gap_m"] = n.gap_m + 1e-3 * (n.normal[:, 1] != 0.0)
    scene = replace(scene, nodes=n.select(slice(None), **changes))
    t, ground = pulses(3.0)
    floors, how = [ground * (1.0 + 0.1 * j) for j in range(1, 5)], {"sample_s": 0.01}
    if model == "W2m":
        config = {**config, "return_wall": {**config["return_wall"], "building_mass_kg": 6e4}}
        floors, how["carried"] = (), carried_masses(config, scene)
    one, other = (
        history(to_plane(s), Motions(t, ground, floors), config["numerics"], **how)
        for s in (scene, node_by_node(scene))
    )
    assert one.peak_d_over_b > 0.05
    assert one.broken == other.broken
    assert (one.broken > 0) == bool(strength)
    assert other.d_m == pytest.approx(one.d_m, abs=1e-6 * np.abs(one.d_m).max())
    assert other.supports_m == pytest.approx(one.supports_m, abs=1e-9)
    assert other.spent_j[-1] == pytest.approx(one.spent_j[-1], rel=1e-6)
    assert other.elastic_j == pytest.approx(one.elastic_j, abs=1e-6 * one.spent_j[-1])


THREE = {"hinges_m": [2.0, 4.0]}
FLOORS = [
    {**ROOF, "load_kn": 30.0, "arm_m": None, "anchor_kn": 10.0},
    {"height_m": 3.24, "anchor_kn": 5.0},
]


def test_three_pieces_at_rest_and_their_matrices():
    """They stand still from the start; K and C of the scene file are those of the plane."""
    config, scene = floored(*FLOORS, model="W2", facade=THREE, numerics=FEW)
    plane = to_plane(scene)
    t = np.linspace(0.0, 1.0, 101)
    still = Motions(t, np.zeros(101), np.zeros((4, 101)))
    got = history(plane, still, config["numerics"], sample_s=0.01)
    assert np.abs(got.d_m).max() < 1e-8
    at = np.isin(scene.nodes.joint, [scene.joints.index("hinge 1")])
    f = config["facade"]  # half the height of the two pieces together is 2 m
    hinge = f["e_mpa"] * 1e6 / 2.0 * f["thickness_m"] * f["width_m"]
    assert scene.nodes.kn_n_m[at].sum() == pytest.approx(hinge)
    mass, k, c, _ = stack_matrices(plane)
    same_matrices(scene, mass, k, c)
    whole = facade_scene({**config, "facade": {**config["facade"], "hinges_m": []}}, "W2", BETA_S)
    assert sum(mass[::3]) == pytest.approx(whole.blocks[1].mass_kg)


def test_every_hinge_carries_what_is_above_it():
    """Pieces sink into each other by weight and floor loads above, over the joint's stiffness."""
    config, scene = floored(*FLOORS, model="W2", facade=THREE, numerics=FEW)
    f, sunk = config["facade"], [-b.displacement_m[2] for b in scene.blocks if b.free]
    kn = f["e_mpa"] * 1e6 * f["thickness_m"] * f["width_m"]  # over the height that yields
    weight_m = f["density_kg_m3"] * f["thickness_m"] * f["width_m"] * scene.gravity_m_s2
    above = [weight_m * f["height_m"] + 30e3, weight_m * 4.48 + 30e3, weight_m * 2.48 + 30e3]
    assert sunk[0] > 0.0
    assert sunk[1] - sunk[0] == pytest.approx(above[1] / (kn / 2.0), rel=1e-9)
    assert sunk[2] - sunk[1] == pytest.approx(above[2] / (kn / 2.24), rel=1e-9)
    assert sunk[0] == pytest.approx(above[0] / (kn / f["height_m"]), rel=0.05)  # and its lean


@pytest.mark.yade
def test_yade_and_the_compiled_solver():
    """Two pieces, two floors that slide: peak d/b within 1 %, and YADE's energy balance closes."""
    config, scene = floored(*FLOORS, facade={"hinges_m": [4.0]}, numerics=FEW)
    agreed(config, scene, "W1", 3.0, 0.1)


@pytest.mark.parametrize(
    ("facade", "models", "message"),
    [
        ({"hinges_m": [7.0]}, ["W1"], r"hinges_m = \[7\]: expected heights below"),
        ({"hinges_m": [4.0, 2.0]}, ["W1"], "hinges_m.*ascending"),
        ({"hinges_m": [-1.0]}, ["W1"], r"hinges_m"),
        ({"hinges_m": "midheight"}, ["W1"], "hinges_m = 'midheight': expected 'weakest' or"),
        ({"hinges_m": [3.0]}, ["W2cm"], "models = W2cm: expected W1, W2 or W2m"),
        ({"courses": 8}, ["W2cm"], "models = W2cm: expected W1, W2 or W2m"),
        ({"hinges_m": [3.0]}, ["W1c"], "models = W1c: expected W1, W2 or W2m"),
        ({"hinges_m": "weakest", "base_height_m": 1.0}, ["W1"], "weakest: expected a plain"),
        ({"hinges_m": "weakest"}, ["W1"], "hinges_m = weakest: expected facade.floors at the top"),
    ],
)
def test_impossible_hinges(facade, models, message):
    """One line with key, value and what was expected."""
    with pytest.raises(ConfigError, match=message):
        study_settings({"facade": facade, "models": models})


LEVEL = {**HELD, "load_kn": 30.0, "arm_m": None, "bearing": "flat", "stiffness_kn_m": 2e5}
SPANNING = {  # the floor at the top of a free-standing wall, and the arm of its load
    "on a point": ({"arm_m": None, "bearing": "point"}, 0.5),
    "level, on an edge of the turning top": ({"arm_m": None, "bearing": "flat"}, 1.0),
}


@pytest.mark.slow
@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("name", SPANNING)
def test_a_wall_that_spans(name, side):
    """Held by the ground alone, either way: λ of bending with the load at s = b/2 or b."""
    bearing, share = SPANNING[name]
    roof = {**LEVEL, **bearing}
    facade = {"e_mpa": 1e5, "hinges_m": [3.6], "sides": "two"}
    config, scene = floored(roof, facade=facade, numerics=FEW, models=["W1"])
    f = config["facade"]
    bent = multipliers(f, 3.6, 30e3, share * f["thickness_m"], 1e6)[0]
    for part, status in ((0.99, "ok"), (1.01, "overturned")):
        t, pull = slow(part * G * bent)
        got = history(to_plane(scene), Motions(t, side * pull), config["numerics"], sample_s=0.01)
        assert got.status == status


def test_the_weakest_hinge_under_a_level_load():
    """It minimises the closed form with the load on the edge."""
    facade = {"hinges_m": "weakest", "sides": "two"}
    config, _ = floored(LEVEL, facade=facade, build=False, models=["W1"])
    f = config["facade"]
    heights = np.linspace(0.05, 0.95, 1801) * f["height_m"]
    found = [multipliers(f, z, 30e3, f["thickness_m"], 1e6)[0] for z in heights]
    assert weakest_hinge(f) == pytest.approx(heights[np.argmin(found)], rel=0.01)


def spanning(height_m=5.2):
    """A wall of two pieces under a level load, watched at a height."""
    facade = {"hinges_m": [3.6], "sides": "two"}
    config, scene = floored(LEVEL, facade=facade, numerics=FEW, models=["W1"])
    return config, observed_at(scene, height_m)


def test_a_level_load_at_rest_and_its_matrices():
    """It lies still from the start, weighs P, moves along z alone; K and C by both routes."""
    config, scene = spanning()
    plane = to_plane(scene)
    t = np.linspace(0.0, 1.0, 101)
    got = history(plane, Motions(t, 0.0 * t), config["numerics"], sample_s=0.01)
    assert np.abs(got.d_m).max() < 1e-8
    mass, k, c, block = stack_matrices(plane)
    assert mass[block == 2] == pytest.approx([30e3 / scene.gravity_m_s2])
    same_matrices(scene, mass, k, c)


@pytest.mark.parametrize(("bearing", "root"), [("flat", 4.7300), ("point", 3.9266)])
def test_courses_between_a_foot_and_a_held_top(bearing, root):
    """Stacked courses lie still under their load; their first ω is the beam's, (λ/h)² √(EI/ρA)."""
    facade = {"courses": 20, "sides": "two", "shear_stiffness_ratio": 1.0}
    roof = {**LEVEL, "bearing": bearing, "stiffness_kn_m": 1e7}
    few = {"nodes_thickness": 5, "after_motion_s": 0.1}
    config, scene = floored(roof, facade=facade, numerics=few, models=["W1"])
    own = config["facade"]
    ratio = own["e_mpa"] * 1e6 * own["thickness_m"] ** 2 / (12.0 * own["density_kg_m3"])
    beam = (root / own["height_m"]) ** 2 * np.sqrt(ratio)
    assert modes(scene)[0][0] == pytest.approx(beam, rel=0.02)
    t = np.linspace(0.0, 0.2, 101)
    got = history(to_plane(scene), Motions(t, 0.0 * t), config["numerics"], sample_s=0.01)
    assert np.abs(got.d_m).max() < 1e-8


def test_observed_at_a_height():
    """d is that of the piece at the height, whatever else moves; above the top there is none."""
    t, ground = pulses(1.0)
    found = []
    for z in (2.0, 3.6, 6.4):
        config, scene = spanning(z)
        got = history(to_plane(scene), Motions(t, ground), config["numerics"], sample_s=0.0)
        found.append(np.abs(got.d_m).max())
    lower, hinge, top = found
    assert 0.5 * hinge < lower < 0.7 * hinge  # a rigid piece that turns about its foot: 2/3.6
    assert top < 0.1 * hinge
    with pytest.raises(ValueError, match="height_m = 7: expected a height of the façade"):
        spanning(7.0)


@pytest.mark.yade
def test_yade_and_the_compiled_solver_on_a_wall_that_spans():
    """Joints opening but little: the watched point within 0.1 %, and YADE's energy closes."""
    config, scene = spanning()
    own = {**config, "observed_m": scene.monitor_point_m[2]}
    t, ground = pulses(1.0)
    planar = history(to_plane(scene), Motions(t, ground), config["numerics"], sample_s=0.01)
    got = in_yade(
        "accuracy_cases", "balanced", config=own, model="W1", beta_s=BETA_S, fraction=0.2,
        time_s=t.tolist(), columns={"ground": ground.tolist()},
    )  # fmt: skip
    assert got["status"] == planar.status == "ok"
    assert got["peak"] == pytest.approx(planar.peak_d_over_b, rel=1e-3)
    assert got["residual"] < 2e-3 * got["overturning"]


@pytest.mark.parametrize(
    ("floor", "facade", "message"),
    [
        ({"height_m": 3.0}, {}, "bearing = flat: expected height_m = facade.height_m = 6.48"),
        ({}, {"gable_height_m": 1.0, "hinges_m": []}, "bearing = flat: expected a plain upright"),
        ({}, {"ties": [{"height_m": 3.0}]}, "sides = two: expected no facade.ties"),
    ],
)
def test_impossible_bearings(floor, facade, message):
    """One line with key, value and what was expected."""
    own = {"sides": "two", "hinges_m": [3.6], "floors": [{**LEVEL, **floor}], **facade}
    with pytest.raises(ConfigError, match=message):
        study_settings({"models": ["W1"], "facade": own})
