"""The base of a rigid façade and the stack of courses that it stands for, in every solver."""

import numpy as np
import pytest
from both_solvers import BETA_S, pulses
from reference_solver import SupportTable, simulate_batch
from reference_solver.facade import wall_of
from rocking import Motion as Shaking
from rocking import Variant
from rocking.collapse.case import FIDELITY_FILE
from rocking.collapse.curve import collapse_curve
from rocking.collapse.scan import COURSES_NODES, COURSES_STEP, one_block_step
from rocking.configuration.config import ConfigError
from rocking.configuration.files import read_yaml
from rocking.fidelity import COURSES
from rocking.mechanics import column
from rocking.mechanics.closed_forms import capacity_compliant_base
from rocking.solver.plane import to_plane
from rocking.solver.runs import Motions, history, peaks, stable_step
from study_cases import study_case, study_settings
from test_floors import slow
from test_ties import G
from yade_process import in_yade, resolved

from yade_scripts.model import base
from yade_scripts.model.facade import facade_scene
from yade_scripts.model.models import build_scene

NODES = dict.fromkeys(("nodes_thickness", "nodes_height", "nodes_per_block"), 17)
COLUMN = {"base": "column"}


def scene_of(facade, numerics=NODES, model="W1"):
    """Configuration and scene."""
    config = resolved(facade=facade, numerics=numerics)
    return config, facade_scene(config, model, BETA_S)


def test_where_the_stiffness_sits():
    """2.2 E/h evenly, 0.3 E b/h along either edge: the uncracked column's Σ k y² = E b³/(3 h)."""
    config, scene = scene_of(COLUMN)
    f = config["facade"]
    at = scene.nodes.joint == scene.joints.index("base")
    kn, y = scene.nodes.kn_n_m[at], scene.nodes.position_m[at, 1] - 0.5 * f["thickness_m"]
    unit = f["e_mpa"] * 1e6 / f["height_m"] * f["thickness_m"] * f["width_m"]
    assert kn.sum() == pytest.approx(2.8 * unit)
    assert kn @ y**2 == pytest.approx(4.0 * unit * f["thickness_m"] ** 2 / 12.0)
    assert kn[0] == pytest.approx((0.3 + 2.2 / (17 * 16)) * unit)
    assert scene.nodes.ks_n_m[at] == pytest.approx(f["shear_stiffness_ratio"] * kn)


@pytest.mark.parametrize("growth", [1.0, 1.4])
def test_courses_in_series_are_the_wall(growth):
    """Under a uniform pressure the joints of a stack give way as the wall up to its last middle."""
    config, scene = scene_of({"courses": 5, "courses_growth": growth}, COURSES_NODES)
    f = config["facade"]
    area = f["thickness_m"] * f["width_m"]
    joints = [scene.nodes.joint == j for j, name in enumerate(scene.joints) if "wall" not in name]
    give = sum(area / scene.nodes.kn_n_m[at].sum() for at in joints)
    tops = base.course_tops(f)
    assert np.diff(tops)[1:] == pytest.approx(growth * np.diff(tops)[:-1])
    assert give == pytest.approx((tops[-1] - 0.5 * (tops[-1] - tops[-2])) / (f["e_mpa"] * 1e6))


@pytest.mark.parametrize("model", ["W1", "W2", "W2m", "W3"])
def test_at_rest(model):
    """It stands on its base from the start: the weight is borne as it is placed."""
    case = study_case(model).varied(Variant("column", {"facade.base": "column"}))
    if model == "W2m":
        case = case.varied(Variant("mass", {"return_wall.building_mass_kg": 6e4}))
    scene = build_scene(case.sections)
    at = scene.nodes.joint == scene.joints.index("base")
    block = scene.blocks[scene.index("façade")]
    borne = -block.displacement_m[2] * scene.nodes.kn_n_m[at].sum()
    assert borne == pytest.approx(block.mass_kg * scene.gravity_m_s2, rel=1e-9)


def static_peak(facade, edges=None):
    """Largest λ of the block on its base, or of a stack of courses."""
    f = resolved(facade=facade)["facade"]
    h, b, density = f["height_m"], f["thickness_m"], f["density_kg_m3"]
    d = np.linspace(0.03, 0.4, 38)
    if edges is not None:
        gamma = column.compliance(h, b, density, f["e_mpa"] * 1e6)
        return column.capacity(d, gamma, b / h, edges).max()
    jkn, edge = base.parts(f)
    return capacity_compliant_base(np.arcsin(d * b / h), h, b, density, jkn, edge_pa=edge).max()


@pytest.mark.parametrize("facade", [{}, COLUMN, {"courses": 5}, {"courses": 5, "e_mpa": 900.0}])
def test_static_capacity(facade):
    """A slow push at 0.9 of the largest λ of the closed forms is borne, 1.03 of it fells.

    Less than 0.9 for what the push sets swinging.
    """
    courses = facade.get("courses")
    config, scene = scene_of(facade, COURSES_NODES if courses else NODES)
    peak = static_peak(facade, column.courses(courses) if courses else None)
    plane = to_plane(scene)
    step = course_step(config) if courses else None
    for share, status in ((0.9, "ok"), (1.03, "overturned")):
        t, pull = slow(share * G * peak)
        got = history(plane, Motions(t, -pull), config["numerics"], sample_s=0.01, step_s=step)
        assert got.status == status


def course_step(config, share=COURSES_STEP):
    """Step of a stack, by that of its façade in one block."""
    return share * one_block_step({**config, "model": "W1", "beta_s": BETA_S})


def test_the_step_of_a_stack():
    """Half the step moves the peak by less than 1 %; so do nodes in place of closed forms.

    The error of the step falls with the step itself, so the joints are compared at a short one.
    """
    t, ground = pulses(1.2)
    fine = dict.fromkeys(COURSES_NODES, 33)
    found = []
    for even, share in ((True, 1.0), (True, 0.5), (True, 0.25), (False, 1.0)):
        config, scene = scene_of({"courses": 5}, COURSES_NODES if even else fine)
        scene.notes["even"] = scene.notes["even"] if even else []
        step = share * COURSES_STEP * course_step(config, 1.0)
        if not even:  # springs as they are, by an explicit step
            step = 0.1 * stable_step(to_plane(scene))
        got = history(to_plane(scene), Motions(t, ground), config["numerics"], step_s=step)
        found.append(got.peak_d_over_b)
    whole, half, quarter, nodes = found
    assert whole > 0.05
    assert half == pytest.approx(whole, rel=0.01)
    assert abs(quarter - half) < 0.6 * abs(half - whole)
    assert quarter == pytest.approx(nodes, rel=0.005)


STIFF = {"facade.height_m": 3.0, "facade.thickness_m": 0.25, "facade.e_mpa": 4050.0}


def courses_peaks(wall, forms, share):
    """Peak d/b of stacks under two pulses, at a share of the step of one block."""
    t, ground = pulses(1.2)
    motion = Shaking.sampled(ground, float(t[1]), name="pulses")
    case = study_case("W1", {**wall, "numerics.after_motion_s": 1.0})
    found = []
    for courses, growth in forms:
        stack = case.varied({"facade.courses": courses, "facade.courses_growth": growth})
        how = {"search": "list", "settings": {"pga_g": [0.06, 0.08, 0.12]}, "fraction": share}
        curve = collapse_curve(stack, motion, **how)
        found.append(curve.table["d_over_b"].to_numpy(float))
    return np.array(found)


@pytest.mark.slow
@pytest.mark.parametrize("wall", [{}, {**STIFF, "return_wall.thickness_m": 0.25}])
def test_thin_courses_do_not_ring(wall):
    """Joints of β many steps long ring if their dashpots act in the middle of a step.

    Twelve equal courses, and eight whose lowest is as thin: at half the step within 1.5 %.
    """
    forms = [(12, 1.0), (8, 1.2)]
    whole, half = (courses_peaks(wall, forms, share) for share in (COURSES_STEP, COURSES_STEP / 2))
    assert np.all(whole[:, -1] > 0.1)
    assert half == pytest.approx(whole, rel=0.015)


@pytest.mark.slow
@pytest.mark.parametrize("wall", [{}, {**STIFF, "return_wall.thickness_m": 0.25}])
def test_courses_converge(wall):
    """With more and thinner courses at the foot peaks go towards those of eight."""
    two, chosen, five, eight = courses_peaks(
        wall, [(2, 1.0), (4, 1.5), (5, 1.4), (8, 1.2)], COURSES_STEP
    )[:, 1]
    assert abs(two - eight) > 2.0 * abs(chosen - eight) > 2.0 * abs(five - eight)
    assert five == pytest.approx(eight, rel=0.06)


def test_courses_side_by_side():
    """Eight histories in one vector have the digits of each alone."""
    t, ground = pulses(1.2)
    config, scene = scene_of({"courses": 4, "courses_growth": 1.5}, COURSES_NODES)
    plane, step, factors = to_plane(scene), course_step(config), [0.5, 0.8, 1.0, 1.5]
    given = plane, Motions(t, ground), config["numerics"]
    together = peaks(*given, factors, step_s=step)
    alone = [history(*given, factor, step_s=step).peak_d_over_b for factor in factors]
    assert together.overturned.tolist() == [False, False, False, True]
    assert together.d_over_b.tolist() == alone


def test_against_the_reference_solver():
    """The block on the column's base by the solver that shares nothing with the compiled one."""
    case = study_case("W1").varied(Variant("column", {"facade.base": "column"}))
    case = case.varied(Variant("nodes", {f"numerics.{key}": 17 for key in NODES}))
    t, ground = pulses(1.2)
    planar = history(to_plane(build_scene(case.sections)), Motions(t, ground), case["numerics"])
    wall = wall_of(case.sections, 17)
    judged = simulate_batch(wall, SupportTable(0.01, ground, None), [1.0], tolerance=1e-6)
    assert planar.peak_d_over_b > 0.05
    assert planar.peak_d_over_b == pytest.approx(float(judged.peak_d_over_b[0]), rel=0.01)


@pytest.mark.slow
def test_courses_before_a_heavy_building():
    """Walls that hang on masses a million times the façade's move as those that are driven."""
    t, ground = pulses(1.2)
    motion = Shaking.sampled(ground, float(t[1]), name="pulses")
    found = {}
    for model in ("W2", "W2m"):
        given = {"facade.courses": 4, "return_wall.building_mass_kg": 1e11}
        case = study_case(model, given)
        settings = {"pga_g": [0.08, 0.1, 0.12]}
        curve = collapse_curve(case, motion, search="list", settings=settings)
        found[model] = curve.table["d_over_b"].to_numpy(float)
    assert found["W2"].max() > 0.05
    assert found["W2m"] == pytest.approx(found["W2"], rel=0.01)


OPEN = {"x_m": -0.5, "z_m": 1.0, "width_m": 1.0, "height_m": 1.5}


@pytest.mark.slow
@pytest.mark.parametrize(
    "shape",
    [
        {"openings": [OPEN]},
        {"gable_height_m": 1.0},
        {"thickness_steps": [{"z_m": 3.0, "thickness_m": 0.3}]},
        {"base_height_m": 2.0},
        {"ties": [{"height_m": 5.0}]},
        {"floors": [{"height_m": 6.0, "load_kn": 20.0, "friction": 0.3}]},
    ],
)
def test_courses_of_a_shape_stand(shape):
    """Hardly shaken, a façade of any shape hardly moves, in one block or in courses."""
    t, ground = pulses(1.2)
    motion = Shaking.sampled(ground, float(t[1]), name="pulses")
    found = []
    for courses in (0, 5):
        case = study_case("W2", {**{f"facade.{k}": v for k, v in shape.items()}})
        case = case.varied({"facade.courses": courses})
        settings = {"pga_g": [0.0005, 0.001, 0.15]}
        curve = collapse_curve(case, motion, search="list", settings=settings)
        found.append(curve.table["d_over_b"].to_numpy(float))
    assert np.max(found, axis=0)[1] < 0.02
    assert found[1][2] > 0.01


@pytest.mark.yade
@pytest.mark.parametrize("facade", [COLUMN, {"courses": 4}])
def test_yade_and_the_compiled_solver(facade):
    """Peak d/b within 1 %, and YADE's energy balance closes."""
    numerics = {**NODES, "nodes_thickness": 9}
    if "courses" in facade:
        numerics = read_yaml(FIDELITY_FILE)[COURSES]
    config, scene = scene_of(facade, numerics)
    config["numerics"]["after_motion_s"] = 0.0
    t, ground = pulses(1.2)
    t, ground = t[:180], ground[50:230]  # the strong ones
    plane = to_plane(scene)
    step = course_step(config) if "courses" in facade else None
    planar = history(plane, Motions(t, ground), config["numerics"], sample_s=0.01, step_s=step)
    got = in_yade(
        "accuracy_cases", "balanced", config=config, model="W1", beta_s=BETA_S,
        fraction=numerics.get("step_fraction", 0.05),
        time_s=t.tolist(), columns={"ground": ground.tolist()},
    )  # fmt: skip
    assert got["status"] == planar.status == "ok"
    assert got["peak"] > 0.05
    assert got["peak"] == pytest.approx(planar.peak_d_over_b, rel=0.01)
    assert got["residual"] < 5e-3 * got["overturning"]


@pytest.mark.parametrize(
    ("facade", "models", "message"),
    [
        ({"base": "soft"}, ["W1"], "facade.base = 'soft'"),
        ({**COLUMN, "base_stiffness_pa_m": 1e9}, ["W1"], "facade.base = column: expected study"),
        ({**COLUMN, "courses": 5}, ["W1"], "expected study with facade.courses"),
        ({"courses": 5, "hinges_m": [2.0]}, ["W1"], "facade.courses = 5: expected 0"),
        ({"courses": 1}, ["W1"], "facade.courses = 1"),
        ({"courses": 5}, ["W1c"], "with facade.courses"),
    ],
)
def test_impossible_bases(facade, models, message):
    """One line with key, value and what was expected."""
    with pytest.raises(ConfigError, match=message):
        study_settings({"facade": facade, "models": models})


def test_a_gap_behind_courses_is_open_by_as_much():
    """The plane of the wall stands back by it: the courses' joints with it are less deep."""
    levels = []
    for gap in (0.0, 0.002):
        case = study_case("W1", {"facade.courses": 4, "facade.gap_m": gap})
        levels.append(to_plane(build_scene(case.sections)).lines.level_m)
    assert (levels[1] - levels[0]).min() == pytest.approx(-0.002)
    assert (levels[1] - levels[0]).max() < 1e-9
