"""Floors and roof on a façade: statics against closed forms, YADE against the compiled solver."""

import math

import numpy as np
import pytest
from both_solvers import BETA_S, FEW, agreed, pulses, same_matrices, slow
from rocking.configuration.config import ConfigError
from rocking.solver.plane import matrices, to_plane
from rocking.solver.runs import Motions, history
from study_cases import study_settings
from test_ties import G
from yade_process import resolved

from yade_scripts.model.facade import facade_scene
from yade_scripts.model.stiffness import assemble

ROOF = {"height_m": 6.48, "load_kn": 60.0, "arm_m": 0.12, "friction": 0.3}
PERIODS = {"stiff": 0.008, "soft": 100.0}  # of a roof on its spring [s]


def floored(*rows, model="W1", build=True, **sections):
    """Configuration and scene of a façade with floors."""
    facade = {**sections.pop("facade", {}), "floors": list(rows)}
    config = resolved(facade=facade, **sections)
    return config, facade_scene(config, model, BETA_S) if build else None


CAPACITIES = {
    "load alone": [{**ROOF, "friction": 0.0}],
    "load beyond the middle": [{**ROOF, "friction": 0.0, "arm_m": 0.3}],
    "friction": [ROOF],
    "two floors": [ROOF, {**ROOF, "height_m": 3.24, "load_kn": 40.0, "arm_m": 0.0}],
    "anchors alone": [{"height_m": 5.0, "anchor_kn": 12.0}],
    "a mass that rides": [{**ROOF, "friction": 0.9, "mass_t": 4.0, "period_s": PERIODS["soft"]}],
}


@pytest.mark.parametrize("name", CAPACITIES)
def test_static_capacity(name):
    """Moments about the toe of a rigid façade, θ → 0, with s the arm of a load:

    λ (W h/2 + Σ m g z) = W b/2 + Σ P (b − s) + Σ F z, m of floors that ride and F of the others:
    a push held at 0.99 of it is borne, at 1.01 it fells.
    """
    config, scene = floored(*CAPACITIES[name], facade={"e_mpa": 1e5}, numerics=FEW)
    f = config["facade"]
    h, b = f["height_m"], f["thickness_m"]
    weight = f["density_kg_m3"] * h * b * f["width_m"] * G
    resisting, pushed = 0.5 * weight * b, 0.5 * weight * h
    for row in f["floors"]:
        arm = 0.5 * b if row["arm_m"] is None else row["arm_m"]
        resisting += 1e3 * row["load_kn"] * (b - arm)
        if row["mass_t"]:
            pushed += 1e3 * row["mass_t"] * G * row["height_m"]
        else:
            held = row["friction"] * row["load_kn"] + row["anchor_kn"]
            resisting += 1e3 * held * row["height_m"]
    for share, status in ((0.99, "ok"), (1.01, "overturned")):
        t, pull = slow(share * G * resisting / pushed)
        got = history(to_plane(scene), Motions(t, -pull), config["numerics"], sample_s=0.01)
        assert got.status == status


@pytest.mark.parametrize("model", ["W1", "W2"])
def test_matrices_of_the_plane_are_those_of_the_scene(model):
    """Nodes, a tie, a floor that is held and one with a mass: M, K and C by both routes."""
    facade = {"ties": [{"height_m": 5.0, "diameter_mm": 12.0}]}
    rows = [{**ROOF, "mass_t": 3.0}, {**ROOF, "height_m": 3.24}]
    _, scene = floored(*rows, model=model, facade=facade, numerics=FEW)
    same_matrices(scene, *matrices(to_plane(scene)))


def test_energy_of_the_plane():
    """Input = kinetic + potential + stored in nodes, springs and loads + taken, at every sample."""
    config, scene = floored(ROOF, {**ROOF, "height_m": 3.24, "load_kn": 40.0})
    plane = to_plane(scene)
    t, ground = pulses(4.0)
    h = history(plane, Motions(t, ground), config["numerics"], sample_s=0.0)
    y, z, turn = (h.rates[:, k] for k in range(3))
    kinetic = 0.5 * plane.mass_kg * (y**2 + z**2) + 0.5 * plane.inertia_kg_m2 * turn**2
    stored = kinetic + plane.mass_kg * plane.gravity_m_s2 * h.pose[:, 1] + h.elastic_j
    ag = np.interp(h.time_s, t, ground, right=0.0)
    power = -plane.mass_kg * ag * y
    work = np.concatenate(([0.0], np.cumsum(0.5 * np.diff(h.time_s) * (power[1:] + power[:-1]))))
    assert h.peak_d_over_b > 0.05
    assert h.spent_j[-1] > 10.0
    residual = stored - stored[0] + h.spent_j - work
    assert np.abs(residual).max() < 0.005 * np.abs(work).max()


def test_a_roof_on_a_stiff_spring_moves_with_the_wall():
    """Its mass is then no part of the façade's motion."""
    t, ground = pulses(3.0)
    found = []
    for more in ({}, {"mass_t": 2.0, "period_s": PERIODS["stiff"]}):
        config, scene = floored({**ROOF, **more})
        got = history(to_plane(scene), Motions(t, ground), config["numerics"], sample_s=0.01)
        found.append(got.peak_d_over_b)
    assert found[0] > 0.05
    assert found[1] == pytest.approx(found[0], rel=0.01)


@pytest.mark.yade
def test_yade_and_the_compiled_solver():
    """Two floors, one with a mass: peak d/b within 1 %, and YADE's energy closes with them."""
    roof = {**ROOF, "load_kn": 30.0}
    rows = [{**roof, "mass_t": 5.0}, {**roof, "height_m": 3.24, "load_kn": 20.0}]
    config, scene = floored(*rows, model="W2", numerics=FEW)
    _, got = agreed(config, scene, "W2", 1.5, 0.1)
    assert got["last"][6] > 0.1 * got["overturning"]  # friction


def test_matrices_hold_the_floor():
    """K of the scene: k at the floor's point, about the centroid; a load alone adds nothing."""
    _, bare = floored()
    config, scene = floored({**ROOF, "friction": 0.0}, ROOF)
    row = np.array([1.0, 0.0, -0.5 * config["facade"]["height_m"]])
    k = 1e3 * config["facade"]["floors"][0]["stiffness_kn_m"]
    gain = assemble(scene).dense()[0] - assemble(bare).dense()[0]
    assert gain == pytest.approx(k * np.outer(row, row), rel=1e-9, abs=1e-6 * k)


def test_matrices_hold_a_roof_of_its_own():
    """One more mass: its spring m (2π/T)² and dashpot 2 ζ m (2π/T) to the driven wall."""
    _, bare = floored(ROOF)
    config, scene = floored({**ROOF, "mass_t": 3.0, "period_s": 0.4})
    omega, zeta = 2.0 * math.pi / 0.4, config["smdof"]["damping_ratio"]
    (k, c), matrices = assemble(scene).dense(), assemble(scene)
    held = 1e3 * config["facade"]["floors"][0]["stiffness_kn_m"]
    assert matrices.mass[3] == 3000.0
    assert k[3, 3] == pytest.approx(held + 3000.0 * omega**2)
    assert c[3, 3] == pytest.approx(2.0 * zeta * 3000.0 * omega)
    assert k[:3, :3] == pytest.approx(assemble(bare).dense()[0])


@pytest.mark.parametrize(
    ("floor", "given", "message"),
    [
        ({**ROOF, "height_m": 7.0}, {}, r"facade.floors\[1\].height_m = 7.*at most"),
        ({**ROOF, "load_kn": -1.0}, {}, r"floors\[1\].load_kn = -1"),
        ({**ROOF, "arm_m": 0.5}, {}, r"floors\[1\].arm_m = 0.5: expected at most the thick"),
        ({"load_kn": 10.0}, {}, r"floors\[1\].height_m: missing"),
        ({"height_m": 6.0}, {}, r"floors\[1\].load_kn = 0: expected a load"),
        (
            {**ROOF, "friction": 0.0, "mass_t": 2.0},
            {},
            r"floors\[1\].mass_t = 2: expected friction",
        ),
        (ROOF, {"models": ["W3"]}, "W3.*expected no facade.floors"),
        ({**ROOF, "load": 9}, {}, "unknown key"),
    ],
)
def test_impossible_floors(floor, given, message):
    """One line with key, value and what was expected."""
    with pytest.raises(ConfigError, match=message):
        study_settings({"facade": {"floors": [floor]}, "models": ["W1"], **given})
