"""Two horizontal components: the full scene in the compiled solver, beside the plane and YADE."""

import math

import numpy as np
import pytest
from rocking.records.table import read_table, second_component
from rocking.solver import spatial
from rocking.solver.plane import moving_supports, to_plane
from rocking.solver.runs import Motions
from rocking.solver.runs import history as planar_history
from rocking.solver.spatial_kernel import roll
from rocking.studies.two_components import Comparison
from yade_process import ROOT, in_yade, resolved

from yade_scripts.model import floor_motions
from yade_scripts.model.facade import facade_scene
from yade_scripts.model.floor_motions import VERTICAL
from yade_scripts.model.motion import along

BETA_S = 0.002
G = 9.80665
FEW = {"nodes_thickness": 5, "nodes_height": 5, "nodes_per_block": 5}
SHORT = {**FEW, "step_fraction": 0.1, "after_motion_s": 0.2}


def pulses(amplitude, delay_s=0.0):
    """Pulses of 1 s that end where they began [m/s²]."""
    t = np.arange(0.0, 2.4, 0.01)
    s = t - delay_s
    place = np.sin(2.0 * np.pi * s) * np.exp(-(((s - 1.1) / 0.4) ** 2)) / (2.0 * np.pi) ** 2
    return t, -amplitude * np.gradient(np.gradient(place, t), t)


def shaken(amplitude, beside):
    """Floor motions of both components, floors stronger than the ground by 10 % a mass."""
    t, ground = pulses(amplitude)
    _, other = pulses(beside, 0.13)
    shares = {"ground": 1.0, **{f"floor{j}": 1.0 + 0.1 * j for j in range(1, 5)}}
    columns = {name: share * ground for name, share in shares.items()}
    return t, columns | {along(name): share * other for name, share in shares.items()}


def both(config, model, t, columns, step_fraction=spatial.STEP_FRACTION, **how):
    """Outcome of the compiled solver under both components."""
    scene = facade_scene(config, model, BETA_S, planar=False, two_components=True)
    motions = spatial.two_motions(scene, t, columns)
    block = spatial.to_block(scene, step_fraction)
    return spatial.history(block, motions, config["numerics"], **how)


@pytest.mark.slow
@pytest.mark.parametrize("model", ["W1", "W2"])
def test_one_component_is_the_plane(model):
    """Without motion along the façade: the planar scene's d/b within 0.1 %, and no twist."""
    config = resolved(numerics=SHORT)
    t, columns = shaken(1.4, 0.0)
    scene = facade_scene(config, model, BETA_S)
    motions = Motions(t, columns["ground"], [columns[n] for n in moving_supports(scene)])
    plane = planar_history(to_plane(scene), motions, config["numerics"])
    found = both(config, model, t, columns)
    assert found.status == plane.status == "ok"
    assert plane.peak_d_over_b > 0.1
    assert found.d_over_b == pytest.approx(plane.peak_d_over_b, rel=1e-3)
    assert found.twist_rad < 1e-9
    assert found.slid_m < 1e-9


@pytest.mark.parametrize("model", ["W1", "W2"])
@pytest.mark.parametrize("factor", [1.0, -0.5])
def test_one_component_and_the_vertical_one_are_the_plane(model, factor):
    """In both directions, which leave the vertical motion as it is; without it d/b is another."""
    config = resolved(numerics=SHORT)
    t, columns = shaken(1.4, 0.0)
    scene, found = facade_scene(config, model, BETA_S), []
    floors = [columns[n] for n in moving_supports(scene)]
    for up in (3.0 * np.sin(np.pi * t / t[-1]) ** 2, 0.0 * t):
        motions = Motions(t, columns["ground"], floors, up)
        plane = planar_history(to_plane(scene), motions, config["numerics"], factor)
        shaking = {**columns, VERTICAL: up}
        found.append(both(config, model, t, shaking, step_fraction=0.05, factor=factor))
        assert found[-1].status == plane.status == "ok"
        assert found[-1].d_over_b == pytest.approx(plane.peak_d_over_b, rel=1e-3)
    assert abs(found[0].d_over_b / found[1].d_over_b - 1.0) > 0.015


def test_a_mirrored_motion_mirrors_a_free_facade():
    """Both components reversed, the vertical one as it was: the half turn of the first history."""
    config = resolved(numerics=SHORT)
    t, columns = shaken(1.2, 3.0)
    columns[VERTICAL] = 3.0 * np.interp(t, t / 2.7, pulses(1.0)[1], right=0.0)
    first, turned = (both(config, "free", t, columns, factor=f, sample_s=0.01) for f in (1.0, -1.0))
    assert first.status == "ok"
    assert first.d_over_b > 0.02
    assert turned.rows[:, 3:5] == pytest.approx(-first.rows[:, 3:5], abs=1e-9)
    assert turned.rows[:, 5] == pytest.approx(first.rows[:, 5], abs=1e-9)


@pytest.mark.parametrize("direction_deg", [60.0, "corner", 40.0])
def test_static_capacity_of_a_pier_pushed_obliquely(direction_deg):
    """λ = min(b/(h |sin φ|), w/(h |cos φ|)), at φ = atan(b/w) about the corner alone."""
    h, b, w = 3.0, 0.5, 0.6
    phi = math.atan2(b, w) if direction_deg == "corner" else math.radians(direction_deg)
    facade = {
        "height_m": h, "thickness_m": b, "width_m": w, "friction_deg": 80.0, "sides": "two",
        "base_stiffness_pa_m": 1e11,
    }  # fmt: skip
    numerics = {**FEW, "nodes_thickness": 3}
    config = resolved(facade=facade, models=["W1"], numerics=numerics)
    capacity = min(b / (h * math.sin(phi)), w / (h * max(math.cos(phi), 1e-9)))
    t = np.linspace(0.0, 7.0, 701)
    scene = facade_scene(config, "W1", BETA_S, planar=False, two_components=True, width_nodes=3)
    block = spatial.to_block(scene, 0.3)
    for share, falls in ((0.99, False), (1.01, True)):
        push = share * capacity * G * 0.5 * (1.0 - np.cos(np.pi * np.minimum(t / 3.0, 1.0)))
        columns = {"ground": -push * math.sin(phi), along("ground"): -push * math.cos(phi)}
        motions = spatial.two_motions(scene, t, columns)
        found = spatial.history(block, motions, config["numerics"], sample_s=0.1)
        tilt = abs(found.rows[-1, 3]) + abs(found.rows[-1, 4])  # of the centroid, along x and y
        assert (tilt > 0.1) == falls


def test_energy_balance_and_mirror():
    """What supports and inertia give is stored or lost; a mirrored motion twists the other way."""
    config = resolved(numerics=SHORT)
    t, columns = shaken(1.4, 6.0)  # slides along x
    found = both(config, "W1", t, columns, sample_s=0.01)
    assert found.status == "ok"
    assert found.slid_m > 0.05
    stored = found.rows[:, 8:11].sum(axis=1)
    residual = stored - stored[0] + found.rows[:, 11] - found.rows[:, 12]
    assert np.abs(residual).max() < 1.5e-3 * found.rows[-1, 11]  # 7e-3 with friction's last force
    assert np.all(np.diff(found.rows[:, 11]) > -1e-6 * found.rows[-1, 11])
    mirror = {name: -v if name.startswith("along") else v for name, v in columns.items()}
    other = both(config, "W1", t, mirror, sample_s=0.01)
    assert other.d_over_b == pytest.approx(found.d_over_b, rel=1e-6)
    assert other.rows[:, 7] == pytest.approx(-found.rows[:, 7], abs=1e-5 * found.twist_rad)


def test_a_free_body_precesses():
    """J1 = J2: its axis goes round the momentum at L/J1 (Euler); second order in the step."""
    inertia, momentum = np.array([2.0, 2.0, 5.0]), np.array([0.3, 0.0, 1.0])
    rate = np.linalg.norm(momentum) / inertia[0]
    axis = momentum / np.linalg.norm(momentum)
    end, errors = 2.0, []
    turn = rate * end
    z = np.array([0.0, 0.0, 1.0])  # Rodrigues
    expected = z * math.cos(turn) + np.cross(axis, z) * math.sin(turn)
    expected += axis * (axis @ z) * (1.0 - math.cos(turn))
    for steps in (20, 40):
        q, spin, matrix, other = (
            np.array([1.0, 0, 0, 0]),
            np.zeros(3),
            np.zeros((3, 3)),
            np.zeros(4),
        )
        for _ in range(steps):
            roll(q, momentum, inertia, end / steps, spin, matrix, other)
        w, x, y, zz = q
        now = np.array([2 * (x * zz + y * w), 2 * (y * zz - x * w), 1 - 2 * (x * x + y * y)])
        errors.append(np.linalg.norm(now - expected))
    assert errors[1] < 1e-3
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)


@pytest.mark.yade
@pytest.mark.parametrize(("model", "beside"), [("W1", 6.0), ("W2", 4.0)])
def test_yade_and_the_compiled_solver(model, beside):
    """Peak d/b under both components within 1 %: W1 slides along x, W2's walls drag it."""
    config = resolved(numerics=SHORT)
    t, columns = shaken(1.4, beside)
    found = both(config, model, t, columns)
    got = in_yade(
        "facade_cases", "shaken", config=config, model=model, beta_s=BETA_S, factor=1.0,
        time_s=t.tolist(), columns={k: v.tolist() for k, v in columns.items()},
        planar=False, two_components=True,
    )  # fmt: skip
    alone = both(config, model, t, {**columns, **{k: 0 * t for k in columns if "along" in k}})
    assert got["status"] == found.status == "ok"
    assert found.d_over_b > 0.1
    assert got["peak"] == pytest.approx(found.d_over_b, rel=0.01)
    assert abs(found.d_over_b / alone.d_over_b - 1.0) > 0.02  # else nothing was compared


@pytest.mark.yade
def test_energy_of_yade_closes_under_both():
    """Input of both supports' motions = stored + dashpots + friction, most of it along x."""
    few = {**SHORT, "nodes_thickness": 3, "nodes_height": 3}
    t, columns = shaken(1.4, 6.0)
    got = in_yade(
        "accuracy_cases", "balanced", config={**resolved(numerics=few), "width_nodes": 3},
        model="W1", beta_s=BETA_S, fraction=0.2, time_s=t.tolist(),
        columns={name: values.tolist() for name, values in columns.items()},
    )  # fmt: skip
    assert got["status"] == "ok"
    assert got["peak"] > 0.1
    _, put_in, _, _, _, dashpots, friction, _, _ = got["last"]
    assert friction > 10.0 * dashpots > 0.0
    assert got["residual"] < min(5e-4 * got["overturning"], 5e-5 * put_in)


@pytest.mark.yade
def test_energy_of_a_facade_that_tumbles():
    """Euler: ½ ωᵀ R J Rᵀ ω of a free body stays, though its axes turn by some 150°."""
    numerics = {**FEW, "nodes_thickness": 3, "nodes_height": 3}
    config = {**resolved(numerics=numerics), "width_nodes": 3}
    got = in_yade("accuracy_cases", "tumbling", config=config, seconds=2.0)
    assert got["start"] == pytest.approx(got["first"], rel=1e-3)
    assert np.abs(got["kinetic"]).max() < 1e-3 * got["first"]  # 0.13 with J along fixed axes
    assert abs(got["check"]) < 1e-3 * got["first"]


def test_lowest_collapse_from_any_start():
    """The lowest of levels that fall in one go above or below the start; None up to the end."""
    curve = object.__new__(Comparison)
    curve.start_g, curve.max_g, curve.settings = 0.1, 0.5, {"level_ratio": 0.1}
    fall = {curve.level(k) for k in (4, 5, 6, 9)}
    assert [curve.lowest(lambda g: g in fall, k) for k in (0, 4, 6, 7)] == [4, 4, 4, 9]
    assert curve.lowest(lambda g: False) is None


def test_curve_of_both_components():
    """A second component that is still changes no collapse; one that moves, slides the façade."""
    ida = {"max_pga_g": 1.0}
    config = resolved(numerics=SHORT, ida=ida)
    settings = {**config["two_components"], "nodes_width": 3, "level_ratio": 0.2}
    job = {**config, "model": "W1", "beta_s": BETA_S}
    found = []
    for beside in (0.0, 4.0):
        t, columns = shaken(1.0, beside)
        found.append(Comparison(job, t, columns, "pos", settings).compare())
    (one, again, two, half, d_one, d_two, twist, slid, *_), moved = found
    assert one == again == two
    assert half == pytest.approx(0.5 * one)
    assert d_two == pytest.approx(d_one, rel=5e-3)
    assert slid < 1e-9 < moved[7]


def test_components_on_one_time_axis():
    """The first one's step, to the end of the longer; zero after either's end."""
    t, s = np.arange(0.0, 0.05, 0.01), np.arange(0.0, 0.1, 0.005)
    longer, columns = floor_motions.with_second(t, {"ground": 1.0 + t}, s, {"ground": 2.0 + s})
    assert longer == pytest.approx(np.arange(0.0, 0.101, 0.01))
    assert columns["ground"] == pytest.approx(np.where(longer < 0.045, 1.0 + longer, 0.0))
    assert columns[along("ground")][:-1] == pytest.approx(2.0 + longer[:-1])


def test_components_that_belong_together():
    """By event and station of the table; a record without a mate has none."""
    suite = read_table(ROOT / "config/suites/recorded_suite.tsv")
    assert second_component(suite, "GMN_NS") == "GMN_WE"
    assert second_component(suite, "GMN_WE") == "GMN_NS"
    assert second_component(read_table(ROOT / "config/records.tsv"), "RRS228") is None
    alone = {name: row for name, row in suite.items() if name != "GMN_WE"}
    assert second_component(alone, "GMN_NS") is None


def test_scenes_that_cannot():
    """Bonded joints and masses that are not driven: one line."""
    config = resolved(numerics=FEW, return_wall={"building_mass_kg": 8e4})
    with pytest.raises(ValueError, match="W2m: two components need"):
        facade_scene(config, "W2m", BETA_S, planar=False, two_components=True)
    scene = facade_scene(config, "W1c", BETA_S, planar=False, two_components=True)
    with pytest.raises(ValueError, match="expected dry joints"):
        spatial.to_block(scene)
