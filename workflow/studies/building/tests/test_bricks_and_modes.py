"""Brick buildings: what is laid, what is refused, stiffness against closed forms."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm
from scipy.optimize import brentq
from scipy.sparse.linalg import spsolve
from studies.building.case import fit_floor_load, read_plan, translation_mode
from studies.building.model.assembly import build
from studies.building.model.bricks import Brick, lay
from studies.building.model.contacts import KINDS, Joints
from studies.building.modes import Solver, largest_frequency, rigid_motions

from yade_scripts.model import stiffness
from yade_scripts.model.building.plan import Opening, Plan, PlanError, PlanWall, plan_from_dict

BUILDINGS = Path(__file__).parents[4] / "config" / "buildings"
JOINTS, BRICK = Joints(), Brick()
E_BED = JOINTS.bed_jkn_pa_m * BRICK.height_m  # 307.2 MPa
DENSITY = 1800.0
SETTINGS = {
    "coarsening": 6.0,
    "brick_length_m": 0.24,
    "brick_height_m": 0.06,
    "brick_width_m": 0.12,
    "density_kg_m3": DENSITY,
    "timber_density_kg_m3": 600.0,
    "fit_period_s": 0.25,
    **{name: getattr(JOINTS, name) for name in JOINTS.__dataclass_fields__},
}


def single_wall(length, height, thickness=0.12, **keys):
    return Plan("one", (PlanWall("wall", (0.0, 0.0), (0.0, length), thickness, height, **keys),))


def volume(bricks):
    return (bricks.high_m - bricks.low_m).prod(axis=1).sum()


# --- bricks -----------------------------------------------------------------------------------


@pytest.mark.parametrize("coarsening", [6.0, 3.0, 1.7])
def test_volume_is_walls_less_corners_openings_and_recesses(coarsening):
    plan = read_plan(BUILDINGS / "case_study.yaml")
    bricks = lay(plan, BRICK.coarsened(coarsening))
    walls = 0.36 * 6.48 * (2 * 6.0 + 2 * (4.4 - 2 * 0.36))
    openings = 0.36 * 0.94 * (2 * 2.16 + 6 * 1.26)
    recesses = 4 * 5.28 * 0.18 * 0.12
    assert volume(bricks) == pytest.approx(walls - openings - recesses, rel=1e-9)


@pytest.mark.parametrize("name", [p.name for p in sorted(BUILDINGS.glob("*.yaml"))])
def test_no_two_boxes_overlap(name):
    scene = build(read_plan(BUILDINGS / name), coarsening=4.0).scene
    centre = np.array([b.centre_m for b in scene.blocks[:-1]])
    half = 0.5 * np.array([b.size_m for b in scene.blocks[:-1]])
    gap = np.abs(centre[:, None] - centre[None]) - half[:, None] - half[None]
    inside = np.all(gap < -1e-6, axis=2)
    assert inside.sum() == len(centre)  # each box with itself alone


def test_running_bond_breaks_every_vertical_joint():
    bricks = lay(single_wall(2.4, 0.6), BRICK)
    for course in range(9):
        ends = [
            set(np.round(bricks.high_m[bricks.course == c, 1], 6)) for c in (course, course + 1)
        ]
        assert ends[0] & ends[1] == {2.4}


def test_corner_interlocks():
    """The wall along x passes the corner on even courses, the wall along y on odd ones."""
    walls = (
        PlanWall("x", (0.0, 0.0), (2.0, 0.0), 0.24, 0.6),
        PlanWall("y", (0.12, -0.12), (0.12, 2.0), 0.24, 0.6),
    )
    bricks = lay(Plan("corner", walls), BRICK)
    for course in range(10):
        here = bricks.course == course
        corner = here & (bricks.low_m[:, 0] < 0.2) & (bricks.low_m[:, 1] < 0.0)
        assert set(bricks.wall[corner]) == {course % 2}


@settings(max_examples=20, deadline=None)
@given(
    length=st.floats(1.5, 6.0),
    height=st.floats(0.5, 3.0),
    thickness=st.floats(0.1, 0.5),
    coarsening=st.floats(1.0, 5.0),
    jamb=st.floats(0.05, 0.5),
    head=st.floats(0.2, 0.9),
)
def test_any_wall_closes(length, height, thickness, coarsening, jamb, head):
    opening = Opening("door", jamb * length, 0.4 * length, 0.0, head * height)
    plan = single_wall(length, height, thickness, openings=(opening,))
    building = build(plan, coarsening=coarsening)
    expected = thickness * (length * height - 0.4 * length * head * height)
    assert volume(building.bricks) == pytest.approx(expected, rel=1e-9)
    assert building.mass_kg == pytest.approx(DENSITY * expected, rel=1e-9)


# --- stiffness --------------------------------------------------------------------------------


@pytest.mark.parametrize("coarsening", [1.0, 2.0])
def test_joint_stiffness_follows_its_spacing(coarsening):
    """At the real brick the stated values, at any size stiffness times spacing unchanged."""
    building = build(single_wall(2.4, 0.96, 0.48), coarsening=coarsening)
    faces, names = building.interfaces, np.array(KINDS)
    for kind, jkn, jks in (
        ("bed", 5120e6, 1690e6),
        ("collar", 2560e6, 845e6),
        ("head", 1280e6, 422e6),
    ):
        of_kind = names[faces.kind] == kind
        # half bricks at the wall's ends stiffen their head joint alone
        assert np.median(faces.jkn_pa_m[of_kind]) == pytest.approx(jkn / coarsening)
        assert np.median(faces.jks_pa_m[of_kind]) == pytest.approx(jks / coarsening)


@pytest.mark.parametrize("coarsening", [4.0, 2.0, 1.0])
def test_compression_is_exact_at_any_brick_size(coarsening):
    """δ = σ(h − H/2)/E for a load at the centres of the top course of height H."""
    building = build(single_wall(1.2, 1.44), coarsening=coarsening)
    solver = Solver(building.scene)
    top = building.bricks.course == building.bricks.course.max()
    stress, force = 1e5, np.zeros(len(solver.mass))
    sizes = building.bricks.high_m - building.bricks.low_m
    for i in np.flatnonzero(top):
        force[(solver.dof[:, 0] == i) & (solver.dof[:, 1] == 2)] = (
            -stress * sizes[i, 0] * sizes[i, 1]
        )
    u = spsolve(solver.k, force)
    assert solver.static(force) == pytest.approx(u, rel=1e-6, abs=1e-9 * np.abs(u).max())
    moved = u[np.isin(solver.dof[:, 0], np.flatnonzero(top)) & (solver.dof[:, 1] == 2)]
    expected = -stress * (1.44 - sizes[top][0, 2] / 2.0) / E_BED
    assert moved == pytest.approx(expected, rel=1e-9)


def test_rigid_motions_strain_the_base_alone():
    building = build(read_plan(BUILDINGS / "case_study.yaml"), coarsening=6.0)
    solver, nodes = Solver(building.scene), building.scene.nodes
    base = np.array(KINDS)[nodes.joint] == "ground"
    for axis, expected in ((0, nodes.ks_n_m), (1, nodes.ks_n_m), (2, nodes.kn_n_m)):
        r = (solver.dof[:, 1] == axis).astype(float)
        assert r @ (solver.k @ r) == pytest.approx(expected[base].sum(), rel=1e-9)


def test_rigid_rotations_turn_every_block_about_the_centre_of_mass():
    """Displacement e × r of the centroid and a unit rotation, for blocks of any mass."""
    building = build(single_wall(0.96, 0.72), coarsening=4.0)
    solver = Solver(building.scene)
    rigid = rigid_motions(building.scene, solver.dof, solver.mass)
    block, letter = solver.dof.T
    weight = np.array([b.mass_kg for b in building.scene.blocks])[np.unique(block)]
    place = np.array([b.centre_m for b in building.scene.blocks], float)
    arm = place - weight @ place[np.unique(block)] / weight.sum()
    for axis in range(3):
        moved = np.cross(np.eye(3)[axis], arm)
        turned = np.where(letter - 3 == axis, 1.0, 0.0)
        expected = np.where(letter < 3, moved[block, letter % 3], turned)
        assert rigid[:, 3 + axis] == pytest.approx(expected, abs=1e-12)


def test_sparse_modes_equal_dense_modes_and_masses_sum_to_one():
    building = build(single_wall(0.96, 0.72), coarsening=4.0)
    solver = Solver(building.scene)
    dense, phi = stiffness.modes(building.scene)
    modes = solver.modes(len(dense) - 1)
    assert modes.omega == pytest.approx(dense[:-1], rel=1e-6)
    rigid = rigid_motions(building.scene, solver.dof, solver.mass)
    total = np.einsum("ni,n,ni->i", rigid, solver.mass, rigid)
    gamma = phi.T @ (solver.mass[:, None] * rigid)
    assert (gamma**2).sum(axis=0) == pytest.approx(total, rel=1e-9)
    assert modes.effective_ratio == pytest.approx((gamma**2 / total)[:-1], abs=1e-6)
    assert largest_frequency(solver.k, solver.mass) == pytest.approx(dense[-1], rel=1e-3)


def timoshenko_periods(e, g, density, depth, width, height, count=2):
    """First periods of a Timoshenko cantilever, shear coefficient 5/6, from its transfer matrix."""
    area, inertia = depth * width, width * depth**3 / 12.0

    def free_end(omega):
        rate = np.zeros((4, 4))  # of deflection, rotation, moment, shear
        rate[0, 1], rate[0, 3] = 1.0, 1.0 / (5.0 / 6.0 * g * area)
        rate[1, 2] = 1.0 / (e * inertia)
        rate[2, 1], rate[2, 3] = -density * inertia * omega**2, -1.0
        rate[3, 0] = -density * area * omega**2
        return np.linalg.det(expm(rate * height)[2:, 2:])

    grid = np.linspace(1.0, 300.0, 400)
    values = [free_end(w) for w in grid]
    roots = [
        brentq(free_end, grid[i], grid[i + 1])
        for i in range(len(grid) - 1)
        if values[i] * values[i + 1] < 0.0
    ]
    return 2.0 * np.pi / np.array(roots[:count])


def test_cantilever_wall_converges_to_timoshenko_in_its_plane():
    """Shear modulus of running bond with rigid bricks: bed joints in series with what resists
    vertical shear, head joints and the bending of bed joints over half a brick."""
    length, height, width = 1.44, 7.2, 0.12
    bed = JOINTS.bed_jks_pa_m * BRICK.height_m
    vertical = JOINTS.head_jks_pa_m * BRICK.length_m
    vertical += JOINTS.bed_jkn_pa_m * BRICK.length_m**2 / (4.0 * BRICK.height_m)
    g = 1.0 / (1.0 / bed + 1.0 / vertical)
    exact = timoshenko_periods(E_BED, g, DENSITY, length, width, height)
    errors = []
    for coarsening in (3.0, 1.5, 0.75):
        modes = Solver(
            build(single_wall(length, height, width), coarsening=coarsening).scene
        ).modes(12)
        in_plane = np.flatnonzero(modes.effective_ratio[:, 1] > 0.02)[:2]
        errors.append(np.abs(modes.period_s[in_plane] / exact - 1.0))
    assert errors[-1].max() < 0.01
    # half bricks at the two ends of every other course: an edge effect, first order in brick size
    rate = np.log2(errors[-2] / errors[-1])
    assert 0.7 < rate[0] < 1.5


def test_pile_converges_to_a_shear_rigid_section_beam_at_second_order():
    """A pile of slabs that do not bend is a Timoshenko beam with shear coefficient 1."""
    height, width = 3.0, 0.3
    exact = timoshenko_periods(E_BED, JOINTS.bed_jks_pa_m * 0.06 * 1.2, DENSITY, width, 1.0, height)
    errors = []
    for parts in (8, 16, 32):
        slab = Brick(4.0, height / parts, width)
        stiff = {
            "bed_jkn_pa_m": E_BED / slab.height_m,
            "bed_jks_pa_m": JOINTS.bed_jks_pa_m * 0.06 / slab.height_m,
        }
        joints = replace(JOINTS, **stiff)
        modes = Solver(
            build(single_wall(1.0, height, width), brick=slab, joints=joints).scene
        ).modes(8)
        out_of_plane = np.flatnonzero(modes.effective_ratio[:, 0] > 0.02)[:2]
        errors.append(np.abs(modes.period_s[out_of_plane] / exact - 1.0))
    rates = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert rates == pytest.approx(2.0, abs=0.3)
    assert errors[-1].max() < 0.005


def test_floor_load_fit_reaches_the_period():
    """The load found on one factorisation gives the same period when the scene is built with it."""
    plan = read_plan(BUILDINGS / "case_study.yaml")
    load, period = fit_floor_load(SETTINGS, plan)
    assert load > 0.0
    assert period == pytest.approx(0.25, rel=1e-5)
    rebuilt = Solver(build(plan.with_floor_load(load), coarsening=6.0).scene).modes(12)
    assert rebuilt.period_s[translation_mode(rebuilt)] == pytest.approx(0.25, rel=1e-5)


# --- refusals ---------------------------------------------------------------------------------


def mapping(**wall):
    base = {
        "name": "north",
        "start_m": [0, 0],
        "end_m": [3, 0],
        "thickness_m": 0.24,
        "height_m": 2.4,
    }
    return {"name": "test", "walls": [{**base, **wall}]}


def opening(name="gap", x=1.0, width=0.5, sill=0.6, height=0.6):
    return {"name": name, "from_start_m": x, "width_m": width, "sill_m": sill, "height_m": height}


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (mapping(openings=[opening(x=2.8)]), ["'north'", "'gap'", "2.8 to 3.3 m", "0 to 3 m"]),
        (mapping(openings=[opening(height=2.0)]), ["'north'", "'gap'", "0.6 to 2.6 m"]),
        (mapping(openings=[opening(), opening("b", x=1.2)]), ["'gap' and 'b' overlap"]),
        (mapping(heigth_m=2.4), ["'north'", "heigth_m", "unknown"]),
        (mapping(end_m=[3, 1]), ["'north'", "along x or along y"]),
        (mapping(height_m="tall"), ["'north'", "height_m", "'tall'"]),
        (mapping(thickness_m=-0.1), ["'north'", "thickness_m", "-0.1"]),
        ({"name": "test", "walls": []}, ["walls"]),
        (
            {
                **mapping(),
                "floors": [
                    {"name": "up", "level_m": 2.0, "walls": ["north", "south"], "extent_m": [0, 3]}
                ],
            },
            ["'up'", "'south'"],
        ),
        ({"name": "test", "walls": 9}, ["walls must be a list", "9"]),
        (mapping(openings=True), ["'north'", "openings must be a list", "True"]),
        (
            {
                **mapping(),
                "floors": [{"name": "up", "level_m": 2, "walls": None, "extent_m": [0, 3]}],
            },
            ["'up'", "walls must name the two walls"],
        ),
    ],
)
def test_bad_plans_are_refused_by_name(data, words):
    with pytest.raises(PlanError) as refusal:
        plan_from_dict(data, "plan.yaml")
    message = str(refusal.value)
    assert message.startswith("plan.yaml")
    assert "\n" not in message
    for word in words:
        assert word in message


def test_wall_without_support_is_refused_by_name():
    hanging = Plan(
        "p",
        (
            PlanWall("a", (0, 0), (3, 0), 0.24, 2.4),
            PlanWall("loft", (0.12, 0), (0.12, 3), 0.24, 1.2, base_m=1.2),
        ),
    )
    with pytest.raises(PlanError, match="wall 'loft' has no support.*1.2 m"):
        build(hanging, coarsening=2.0)
    on_top = Plan(
        "p",
        (
            PlanWall("a", (0, 0), (3, 0), 0.24, 1.2),
            PlanWall("b", (0, 0), (3, 0), 0.24, 1.2, base_m=1.2),
        ),
    )
    assert len(build(on_top, coarsening=2.0).bricks) > 0


def test_floating_brick_is_refused_by_name():
    ring = [
        opening("left", 0.5, 0.5, 0.6, 1.2),
        opening("right", 2.0, 0.5, 0.6, 1.2),
        opening("below", 0.5, 2.0, 0.0, 0.6),
        opening("above", 0.5, 2.0, 1.8, 0.3),
    ]
    plan = plan_from_dict(mapping(openings=ring))
    with pytest.raises(PlanError, match=r"brick 'north/c\d+/w\d/b\d+' at .* floats"):
        build(plan)


def test_missing_plan_file_is_one_line(tmp_path):
    with pytest.raises(PlanError, match="none.yaml: No such file"):
        read_plan(tmp_path / "none.yaml")
    broken = tmp_path / "broken.yaml"
    broken.write_text("walls: [")
    with pytest.raises(PlanError, match=r"broken.yaml line 1: "):
        read_plan(broken)
