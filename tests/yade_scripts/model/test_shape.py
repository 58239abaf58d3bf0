"""Shapes of a façade: mass and moments another way, statics, rest, and YADE beside the plane."""

import math

import numpy as np
import pytest
from both_solvers import BETA_S, FEW, agreed
from rocking.configuration.config import ConfigError
from rocking.solver.plane import to_plane
from rocking.solver.runs import Motions, history
from scipy.integrate import solve_ivp
from study_cases import study_settings
from yade_process import in_yade, resolved

from yade_scripts.model import floor_motions, models
from yade_scripts.model.facade import facade_scene
from yade_scripts.model.shape import shape_of
from yade_scripts.model.stiffness import assemble

G = 9.80665
STEP = {"z_m": 3.24, "thickness_m": 0.25}
WINDOW = {"x_m": -1.2, "z_m": 4.0, "width_m": 1.0, "height_m": 1.5}
SIDE = {"x_m": 1.8, "z_m": 1.0, "width_m": 0.6, "height_m": 1.2}  # before the right wall
DOOR = {"x_m": 0.4, "z_m": 0.0, "width_m": 1.2, "height_m": 2.2}
SHAPES = {
    "gable": {"gable_height_m": 1.5},
    "parapet": {"parapet_height_m": 1.0, "parapet_thickness_m": 0.2},
    "thinner, outer face flush": {"thickness_steps": [STEP]},
    "thinner, inner face flush": {"thickness_steps": [STEP], "flush_face": "inner"},
    "openings": {"openings": [WINDOW, DOOR, SIDE]},
}
ALL = {"gable_height_m": 1.5, "thickness_steps": [STEP], "openings": [WINDOW, DOOR, SIDE]}


def inside(facade, x, y, z):
    """Whether points belong to the façade, by its drawing."""
    h, b, w = facade["height_m"], facade["thickness_m"], facade["width_m"]
    thick = np.full(z.shape, b)
    for row in facade["thickness_steps"]:
        thick[z > row["z_m"]] = row["thickness_m"]
    if facade["parapet_thickness_m"]:
        thick[z > h] = facade["parapet_thickness_m"]
    outer = facade["flush_face"] == "outer"
    found = (y > b - thick) & (y < b) if outer else (y > 0.0) & (y < thick)
    if facade["gable_height_m"]:
        found &= np.abs(x) < 0.5 * w * np.minimum(1.0, (h - z) / facade["gable_height_m"] + 1.0)
    for row in facade["openings"]:
        high = (z > row["z_m"]) & (z < row["z_m"] + row["height_m"])
        found &= ~(high & (np.abs(x - row["x_m"]) < 0.5 * row["width_m"]))
    return found


def summed(facade, low, high):
    """Mass, centroid and moments of the cells of a drawing between two heights."""
    axes = [
        np.arange(a + 0.5 * step, b, step)
        for a, b, step in ((-2.2, 2.2, 0.05), (0.0, 0.375, 0.025), (low, high, 0.02))
    ]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    kept = grid[inside(facade, *grid.T)]
    cell = facade["density_kg_m3"] * 0.05 * 0.025 * 0.02
    about = kept - kept.mean(axis=0)
    second = about.T @ about
    tensor = cell * (np.trace(second) * np.eye(3) - second)
    return cell * len(kept), kept.mean(axis=0), tensor


@pytest.mark.parametrize("name", [*SHAPES, "all"])
def test_mass_and_moments_are_those_of_the_drawing(name):
    """Sums over cells of 50 × 25 × 20 mm: mass, centroid and all moments within 0.2 %."""
    facade = resolved(facade={**SHAPES, "all": ALL}[name])["facade"]
    shape = shape_of(facade)
    mass, centre, tensor = summed(facade, 0.0, shape.top_m)
    assert shape.mass_kg == pytest.approx(mass, rel=2e-3)
    assert shape.centre_m == pytest.approx(centre, abs=3e-3)
    assert shape.tensor_kg_m2 == pytest.approx(tensor, rel=2e-3, abs=2e-3 * tensor[2, 2])


def test_a_façade_in_pieces_is_the_whole():
    """A step to the same thickness changes no mass, no stiffness and no static capacity."""
    cut = {"thickness_steps": [{"z_m": 3.0, "thickness_m": 0.375}]}
    whole, parts = (
        facade_scene(resolved(facade=f, numerics={"nodes_height": 9}), "W1", BETA_S)
        for f in ({}, cut)
    )
    assert len(parts.joints) == 1 + len(whole.joints)
    for one, other in zip(whole.blocks, parts.blocks, strict=True):
        assert one.mass_kg == pytest.approx(other.mass_kg, rel=1e-12)
        assert one.centre_m == pytest.approx(other.centre_m, rel=1e-12)
        assert one.inertia_kg_m2 == pytest.approx(other.inertia_kg_m2, rel=1e-12)
    assert parts.thickness_m == pytest.approx(whole.thickness_m, rel=1e-12)
    k, c = assemble(whole).dense()
    assert assemble(parts).dense()[0] == pytest.approx(k, rel=1e-9, abs=1e-6 * k.max())


def test_openings_take_width_from_base_and_walls():
    """Σ kn: jkn b (w − 1.2) at the base, jkn (2·0.375·6.48 − 0.275·1.2) at the walls."""
    config = resolved(facade={"openings": [WINDOW, DOOR, SIDE]})
    scene = facade_scene(config, "W1", BETA_S)
    n, jkn = scene.nodes, 1.8e9 / 6.48
    up = n.normal[:, 2] > 0.5
    assert n.kn_n_m[up].sum() == pytest.approx(jkn * 0.375 * 3.2, rel=1e-12)
    wall = 2.0 * jkn * (0.75 * 6.48 - 0.275 * 1.2)  # 0.275 m of the right wall's 0.375
    assert n.kn_n_m[~up].sum() == pytest.approx(wall, rel=1e-12)


@pytest.mark.parametrize("name", SHAPES)
def test_static_multiplier(name):
    """λ = b_g/z_g on a stiff base: a push held at 0.99 of it is borne, at 1.01 it fells."""
    facade = {**SHAPES[name], "base_stiffness_pa_m": 1e12}
    config = resolved(facade=facade, numerics=FEW)
    scene, shape = facade_scene(config, "W1", BETA_S), shape_of(config["facade"])
    arm, height = 0.375 - shape.centre_m[1], shape.centre_m[2]
    job = {**config, "model": "W1"}
    assert models.static_multiplier(job) == pytest.approx(arm / height, rel=1e-12)
    time_s = np.linspace(0.0, 14.0, 1401)
    for share, status in ((0.99, "ok"), (1.01, "overturned")):
        push = share * arm / height * G * 0.5 * (1.0 - np.cos(np.pi * np.minimum(time_s / 5, 1)))
        found = history(to_plane(scene), Motions(time_s, -push), config["numerics"])
        assert found.status == status
    # at d/b = 1 the centroid stands above the toe
    turned = -found.pose[-1, 2]
    assert arm * math.cos(turned) - height * math.sin(turned) == pytest.approx(0.0, abs=2e-3)


def test_a_leaning_façade_rests():
    """Weight e = y_g − b/2 off the middle: θ = W e/(K − W z_g), K = jkn w b³/12; it stays there."""
    config = resolved(facade={"thickness_steps": [{"z_m": 3.24, "thickness_m": 0.32}]})
    scene, shape = facade_scene(config, "W1", BETA_S), shape_of(config["facade"])
    weight = shape.mass_kg * 9.81
    k = 1.8e9 / 6.48 * 4.4 * 0.375**3 / 12.0
    theta = weight * (shape.centre_m[1] - 0.1875) / (k - weight * shape.centre_m[2])
    assert -scene.blocks[1].rotation_rad[0] == pytest.approx(theta, rel=2e-3)
    time_s = np.linspace(0.0, 3.0, 301)
    still = history(to_plane(scene), Motions(time_s, 0.0 * time_s), config["numerics"])
    assert np.ptp(still.d_m) < 1e-3 * theta * 6.48


def test_base_above_the_ground():
    """Base at a third of the height of a chain of four: between masses 1 and 2, a block less."""
    config = resolved(facade={"height_m": 6.0, "base_height_m": 3.0})
    scene = facade_scene(config, "W2", BETA_S)
    t = np.linspace(0.0, 1.0, 11)
    columns = {"ground": t, **{f"floor{j}": 10.0**j * t for j in range(1, 5)}}
    found = floor_motions.motion_columns(scene, columns)
    # masses at 2.25, 4.5, 6.75, 9 m
    assert found[scene.blocks[0].motion] == pytest.approx((2 / 3 * 10.0 + 1 / 3 * 100.0) * t)
    walls = [b for b in scene.blocks if b.name.startswith("return wall")]
    assert [b.motion for b in walls] == ["floor2", "floor3", "floor4"]
    assert [b.centre_m[2] for b in walls] == pytest.approx([0.75, 2.625, 4.875])
    assert [b.size_m[2] for b in walls] == pytest.approx([1.5, 2.25, 2.25])
    assert facade_scene(config, "W1", BETA_S).motions == [scene.blocks[0].motion]


@pytest.mark.yade
def test_yade_and_the_compiled_solver():
    """A façade with everything on top of a storey, W2: peak d/b within 1 %, its energy closes."""
    config = resolved(facade={**ALL, "base_height_m": 2.0}, numerics=FEW)
    scene = facade_scene(config, "W2", BETA_S)
    planar, _ = agreed(config, scene, "W2", 1.2, 0.15)
    assert planar.peak_d_over_b > 0.1


# Elevations as polygons (x, z), holes clockwise, each with its faces y0, y1.
OUTLINES = {
    "plain": ({}, [([(-2.2, 0), (2.2, 0), (2.2, 6.48), (-2.2, 6.48)], 0.0, 0.375)]),
    "gable, setback, openings": (
        {**ALL, "flush_face": "inner"},
        [
            (
                [(-2.2, 0), (-0.2, 0), (-0.2, 2.2), (1, 2.2), (1, 0), (2.2, 0)]
                + [(2.2, 3.24), (-2.2, 3.24)],
                *(0.0, 0.375),
            ),
            ([(1.5, 1), (1.5, 2.2), (2.1, 2.2), (2.1, 1)], 0.0, 0.375),
            ([(-2.2, 3.24), (2.2, 3.24), (2.2, 6.48), (0, 7.98), (-2.2, 6.48)], 0.0, 0.25),
            ([(-1.7, 4), (-1.7, 5.5), (-0.7, 5.5), (-0.7, 4)], 0.0, 0.25),
        ],
    ),
}


def half_cycle(outlines, top_m, time_s, ground):
    """Displacement of the top's middle by Housner's equation about the toe (b, 0), rigid and sharp:

    I θ'' = −m g (b_g cos θ − z_g sin θ) − m a_g (z_g cos θ + b_g sin θ), θ ≥ 0, with m, b_g, z_g
    and I of unit density from the areas and moments of polygons (Green), until it comes back.
    """
    b, sums = 0.375, np.zeros(4)  # m, m b_g, m z_g, I
    for points, y0, y1 in outlines:
        (x, z), (x1, z1) = np.transpose(points), np.transpose(np.roll(points, -1, axis=0))
        cross = x * z1 - x1 * z
        area, first = 0.5 * cross.sum(), ((z + z1) * cross).sum() / 6.0
        second = ((z * z + z * z1 + z1 * z1) * cross).sum() / 12.0
        far, near = b - y0, b - y1
        arm, square = 0.5 * (far**2 - near**2), (far**3 - near**3) / 3.0
        sums += (y1 - y0) * area, arm * area, (y1 - y0) * first, (y1 - y0) * second + square * area
    mass, inward, upward, inertia = sums

    def rates(t, state):
        sin, cos = np.sin(state[0]), np.cos(state[0])
        turning = -G * (inward * cos - upward * sin)
        turning -= np.interp(t, time_s, ground) * (upward * cos + inward * sin)
        return state[1], turning / inertia if state[0] > 0.0 else max(turning / inertia, 0.0)

    end = (0.0, time_s[-1])
    theta = solve_ivp(rates, end, (0.0, 0.0), t_eval=time_s, max_step=2e-3, rtol=1e-8, atol=1e-10).y
    y, top = b - 0.5 * (outlines[-1][1] + outlines[-1][2]), top_m  # of the top's middle
    return top * np.sin(theta[0]) + y * (1.0 - np.cos(theta[0])), top * inward / upward


def first_swing(time_s, d):
    """Largest d, and when it has come back to half of that."""
    k = int(np.argmax(d))
    back = k + int(np.argmax(d[k:] < 0.5 * d[k]))
    return d[k], np.interp(-0.5 * d[k], -d[k : back + 1], time_s[k : back + 1])


@pytest.mark.yade
@pytest.mark.parametrize("name", OUTLINES)
def test_half_a_cycle_is_that_of_its_outline(name):
    """Peak and time of return of both solvers on a hard base, within 1 % of Housner's equation."""
    facade, outlines = OUTLINES[name]
    facade = {**facade, "base_stiffness_pa_m": 1e12, "friction_deg": 80.0}
    config = resolved(facade=facade, numerics={**FEW, "after_motion_s": 0.0})
    time_s = np.linspace(0.0, 1.8, 361)
    ground = -1.3 * np.where(time_s < 0.8, np.sin(np.pi * time_s / 0.8) ** 2, 0.0)
    scene = facade_scene(config, "W1", 1e-5)
    d, b = half_cycle(outlines, scene.monitor_point_m[2], time_s, ground)
    expected = first_swing(time_s, d)
    assert 0.2 < expected[0] / b < 0.8
    found = history(to_plane(scene), Motions(time_s, ground), config["numerics"], sample_s=0.002)
    got = in_yade(
        "accuracy_cases", "shaken", config=config, model="W1", beta_s=1e-5, fraction=0.2,
        time_s=time_s.tolist(), columns={"ground": ground.tolist()},
    )  # fmt: skip
    for times, swing in ((found.time_s, found.d_m), (np.array(got["time"]), np.array(got["d"]))):
        assert first_swing(times, swing) == pytest.approx(expected, rel=0.01)
    assert found.peak_d_over_b == pytest.approx(expected[0] / b, rel=0.01)


@pytest.mark.parametrize(
    ("facade", "models", "message"),
    [
        ({"openings": [{**WINDOW, "x_m": 2.0}]}, ["W1"], r"openings\[1\].x_m = 2.*half of"),
        ({"openings": [{**WINDOW, "z_m": 6.0}]}, ["W1"], r"openings\[1\].height_m = 1.5.*head"),
        ({"openings": [WINDOW, {**WINDOW, "x_m": -0.5}]}, ["W1"], r"openings\[2\].*apart from"),
        ({"openings": [{**WINDOW, "x_m": 0, "width_m": 4.4}]}, ["W1"], "masonry beside"),
        ({"thickness_steps": [{**STEP, "thickness_m": -0.2}]}, ["W1"], "thickness_m = -0.2"),
        ({"thickness_steps": [STEP, STEP]}, ["W1"], r"thickness_steps\[2\].z_m.*ascending"),
        ({"thickness_steps": [{"z_m": 1, "thickness_m": 3}]}, ["W1"], "weight falls"),
        ({"gable_height_m": 1.0, "parapet_height_m": 1.0}, ["W1"], "parapet_height_m.*gable"),
        ({"gable_height_m": 1.0}, ["W3"], "W3: expected a façade of one block"),
        ({"hinges_m": [3.0], "tilt_deg": 1.0}, ["W1"], "hinges_m: expected none with facade.tilt"),
    ],
)
def test_impossible_shapes(facade, models, message):
    """One line with key, value and what was expected."""

    with pytest.raises(ConfigError, match=message):
        study_settings({"facade": facade, "models": models})
