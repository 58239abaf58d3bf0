"""Two horizontal components: the full scene in YADE, beside the plane and closed forms."""

import math

import numpy as np
import pytest
from rocking import Case, Motion
from rocking.collapse.scan import driving
from rocking.records.table import read_table, second_component
from rocking.solver.plane import to_plane
from rocking.solver.runs import history as planar_history
from yade_process import ROOT, in_yade, resolved

from studies.two_components.study import Comparison
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


def both(config, model, t, columns, factor=1.0):
    """Peak, status, twist and slide of YADE's façade in three dimensions."""
    return in_yade(
        "facade_cases", "shaken", config=config, model=model, beta_s=BETA_S, factor=factor,
        time_s=t.tolist(), columns={k: v.tolist() for k, v in columns.items()},
        planar=False, two_components=True,
    )  # fmt: skip


@pytest.mark.yade
@pytest.mark.parametrize(("model", "factor"), [("W1", 1.0), ("W2", 1.0), ("W1", -0.5)])
@pytest.mark.parametrize("up", [0.0, 3.0])
def test_one_component_is_the_plane(model, factor, up):
    """Without motion along the façade, with a vertical one or none: the planar scene's d/b.

    In both directions, which leave the vertical motion as it is; and no twist.
    """
    config = resolved(numerics=SHORT)
    t, columns = shaken(1.4, 0.0)
    columns[VERTICAL] = up * np.sin(np.pi * t / t[-1]) ** 2
    scene = facade_scene(config, model, BETA_S)
    motions = driving(scene, t, columns)
    plane = planar_history(to_plane(scene), motions, config["numerics"], factor)
    found = both(config, model, t, columns, factor)
    assert found["status"] == plane.status == "ok"
    assert plane.peak_d_over_b > 0.05
    assert found["peak"] == pytest.approx(plane.peak_d_over_b, rel=3e-3)
    assert found["twist_rad"] < 1e-9
    assert found["slid_m"] < 1e-9


@pytest.mark.yade
def test_a_mirrored_motion_mirrors_the_facade():
    """The motion along it reversed: it twists and slides as far, the other way."""
    config = resolved(numerics=SHORT)
    t, columns = shaken(1.4, 6.0)
    mirror = {name: -v if name.startswith("along") else v for name, v in columns.items()}
    found, other = (both(config, "W1", t, moved) for moved in (columns, mirror))
    alone = both(config, "W1", t, {k: 0 * v if "along" in k else v for k, v in columns.items()})
    assert found["status"] == "ok"
    assert found["slid_m"] > 0.05
    assert found["twist_rad"] > 1e-6
    assert abs(found["peak"] / alone["peak"] - 1.0) > 0.02  # else nothing was mirrored
    assert other["peak"] == pytest.approx(found["peak"], rel=1e-6)
    assert other["slid_m"] == pytest.approx(found["slid_m"], rel=1e-6)
    assert other["twist_rad"] == pytest.approx(found["twist_rad"], rel=1e-3)


@pytest.mark.slow
@pytest.mark.yade
@pytest.mark.parametrize("direction_deg", [60.0, "corner", 40.0])
def test_static_capacity_of_a_pier_pushed_obliquely(direction_deg):
    """λ = min(b/(h |sin φ|), w/(h |cos φ|)), at φ = atan(b/w) about the corner alone."""
    h, b, w = 3.0, 0.5, 0.6
    phi = math.atan2(b, w) if direction_deg == "corner" else math.radians(direction_deg)
    facade = {
        "height_m": h, "thickness_m": b, "width_m": w, "friction_deg": 80.0, "sides": "two",
        "base_stiffness_pa_m": 1e11,
    }  # fmt: skip
    numerics = {**FEW, "nodes_thickness": 3, "step_fraction": 0.3}
    config = resolved(facade=facade, models=["W1"], numerics=numerics)
    capacity = min(b / (h * math.sin(phi)), w / (h * max(math.cos(phi), 1e-9)))
    t = np.linspace(0.0, 7.0, 701)
    for share, falls in ((0.99, False), (1.01, True)):
        push = share * capacity * G * 0.5 * (1.0 - np.cos(np.pi * np.minimum(t / 3.0, 1.0)))
        columns = {"ground": -push * math.sin(phi), along("ground"): -push * math.cos(phi)}
        found = both(config, "W1", t, columns)
        tilted = (
            found["status"] == "overturned" or found["slid_m"] > 0.1
        )  # of the centroid, along x
        assert found["status"] != "failed"
        assert tilted == falls


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


@pytest.mark.parametrize("block", [1, 2, 5])
def test_lowest_collapse_from_any_start(block):
    """The lowest of levels that fall in one go above or below the start; None up to the end."""
    curve = object.__new__(Comparison)
    curve.start_g, curve.max_g, curve.settings = 0.1, 0.5, {"level_ratio": 0.1}
    fall, asked = {curve.level(k) for k in (4, 5, 6, 9)}, []

    def outcomes(pga_g):
        asked.extend(pga_g)
        return ["overturned" if g in fall else "ok" for g in pga_g]

    assert [curve.lowest(outcomes, k, block) for k in (0, 4, 6, 7)] == [4, 4, 4, 9]
    asked.clear()
    assert curve.lowest(lambda pga_g: asked.extend(pga_g) or ["ok"] * len(pga_g), 0, block) is None
    assert asked[-2] < curve.max_g <= asked[-1]


@pytest.mark.slow
@pytest.mark.yade
def test_curve_of_both_components():
    """A second component that is still changes no collapse; one that moves, slides the façade."""
    ida = {"max_pga_g": 1.0}
    config = resolved(numerics=SHORT, ida=ida)
    settings = {**config["two_components"], "nodes_width": 3, "level_ratio": 0.2}
    case, found = Case({**config, "model": "W1", "beta_s": BETA_S}), []
    for beside in (0.0, 4.0):
        t, columns = shaken(1.0, beside)
        names = [name for name in columns if not name.startswith("along")]
        motions = [{name: columns[of(name)] for name in names} for of in (str, along)]
        across, second = (Motion(floors=(t, floors), label="pulse") for floors in motions)
        found.append(Comparison(case, across, second, "pos", settings).compare())
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
    """Masses that are not driven: one line."""
    config = resolved(numerics=FEW, return_wall={"building_mass_kg": 8e4})
    with pytest.raises(ValueError, match="W2m: two components need"):
        facade_scene(config, "W2m", BETA_S, planar=False, two_components=True)
