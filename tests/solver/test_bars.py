"""Forces of ties and floors at one pose: closed forms, and the slope of the energy they store."""

import math

import numpy as np
import pytest
from rocking.solver import bars as module
from rocking.solver.inputs import Supports
from rocking.solver.plane import to_plane
from yade_process import resolved

from yade_scripts.model.facade import facade_scene
from yade_scripts.model.facades import Rods

TIE = {"height_m": 6.0, "count": 2, "diameter_mm": 16.0, "length_m": 4.0, "slack_mm": 3.0}
ROOF = {"height_m": 5.0, "load_kn": 30.0, "arm_m": 0.1, "friction": 17.0 / 30.0}
ROOF |= {"stiffness_kn_m": 2e4}
OWN = {**ROOF, "mass_t": 1.5, "period_s": 0.4}


def held(ties=(), floors=(), **sections):
    """Resolved configuration, scene and its ties and floors."""
    config = resolved(facade={"ties": list(ties), "floors": list(floors)}, **sections)
    scene = facade_scene(config, "W1", 0.002)
    return config, scene, to_plane(scene).bars


def at_rest(bars):
    """Memory of a history that begins."""
    return module.Memory(*np.zeros((2, len(bars.tie_k_n_m))), *np.zeros((4, len(bars.mass_kg))))


def act(bars, y=0.0, z=0.0, turn=0.0, support=0.0, memory=None, **more):
    """Force and moment on the façade, force on the support, energy; of a pose from rest."""
    memory = memory or at_rest(bars)
    push, place = np.zeros(3), np.array([y, z, turn])
    angle = np.array([math.cos(turn), math.sin(turn)])
    supports = Supports(*np.zeros((12, 1)))
    supports.y[:], supports.vy[:] = support, more.get("speed", 0.0)
    ratio, ground = more.get("weight_ratio", 1.0), more.get("ground", 0.0)
    elastic, spent, lost = module.act(
        bars, memory, place, angle, 5e-5, supports, ground, ratio, push
    )
    return push, supports.fy[0], elastic, spent, lost


@pytest.mark.parametrize("which", ["tie", "roof", "both"])
def test_forces_are_the_slope_of_the_energy(which):
    """−∂E/∂y, −∂E/∂z, −∂E/∂θ and, on the support, −∂E/∂u, before anything yields or slides."""
    ties = [] if which == "roof" else [TIE]
    floors = [] if which == "tie" else [ROOF]
    _, _, bars = held(ties, floors)
    at = {"y": 3.3e-3, "z": 1e-3, "turn": -2e-4, "support": 2.9e-3}
    if which == "tie":
        at |= {"y": 6e-3, "support": 1e-3}
    push, force, *_ = act(bars, **at)
    for key, expected, step in (
        ("y", push[0], 1e-7),
        ("z", push[1], 1e-7),
        ("turn", push[2], 1e-8),
        ("support", force, 1e-7),
    ):
        above, below = (act(bars, **{**at, key: at[key] + s * step})[2] for s in (1, -1))
        assert -(above - below) / (2.0 * step) == pytest.approx(expected, rel=1e-5), key
    assert np.abs(push).min() > 1.0


def test_a_tie_pulls_past_its_slack_yields_and_snaps():
    """Moved straight outward: nothing up to 3 mm, then k e, then A f_y, then nothing for good."""
    config, _, bars = held([TIE])
    k, most, snap = Rods(**config["facade"]["ties"][0]).rod
    assert act(bars, y=2.9e-3)[0] == pytest.approx([0.0, 0.0, 0.0])
    push, force, elastic, spent, _ = act(bars, y=4e-3)
    assert push[0] == pytest.approx(-k * 1e-3, rel=1e-9)
    assert push[2] == pytest.approx(-push[0] * (6.0 - 0.5 * 6.48), rel=1e-9)  # about x, from y to z
    assert (force, spent) == (-push[0], 0.0)
    assert elastic == pytest.approx(0.5 * k * 1e-6)
    memory = at_rest(bars)
    stretch = 3e-3 + 4.0 * most / k
    push, _, elastic, spent, _ = act(bars, y=stretch, memory=memory)
    assert push[0] == pytest.approx(-most)
    assert memory.yielded_m[0] == pytest.approx(3.0 * most / k)
    assert elastic == pytest.approx(0.5 * most**2 / k)
    assert spent == pytest.approx(3.0 * most**2 / k)
    assert act(bars, y=stretch - most / k, memory=memory)[0][0] == pytest.approx(0.0, abs=1e-3)
    *_, spent, lost = act(bars, y=1.01 * (3e-3 + snap), memory=memory)
    assert lost == 1
    assert spent == pytest.approx(0.5 * most**2 / k)
    assert act(bars, y=stretch, memory=memory)[0] == pytest.approx([0.0, 0.0, 0.0])


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_floor_holds_up_to_friction_both_ways(sign):
    """μP = 17 kN, k = 20 MN/m; the load and what holds turn the façade about its centroid."""
    _, scene, bars = held(floors=[ROOF])
    memory = at_rest(bars)
    push, force, _, spent, _ = act(bars, y=sign * 0.8e-3, memory=memory)
    y, z = 0.1 - 0.5 * 0.375, 5.0 - 0.5 * 6.48  # of the floor, from the centroid
    assert scene.floors[0].position_m[1:] == pytest.approx((0.1, 5.0))
    assert push[:2] == pytest.approx([-sign * 16e3, -30e3])
    assert push[2] == pytest.approx(y * push[1] - z * push[0])
    assert (force, spent) == (pytest.approx(-push[0]), 0.0)
    push, force, _, spent, _ = act(bars, y=sign * 2e-3, memory=memory)
    assert push[0] == pytest.approx(-sign * 17e3)
    assert memory.slid_m[0] == pytest.approx(sign * (2e-3 - 0.85e-3))
    assert spent == pytest.approx(17e3 * (2e-3 - 0.85e-3))
    assert act(bars, y=sign * 2e-3, memory=memory, weight_ratio=1.3)[0][1] == pytest.approx(-39e3)


def test_a_floor_with_a_mass_stands_on_its_own_spring():
    """m = 1.5 t on m(2π/T)² and 2ζm(2π/T): moved by its support alone it is driven by that."""
    config, _, bars = held(floors=[OWN])
    omega, zeta = 2.0 * math.pi / 0.4, config["smdof"]["damping_ratio"]
    assert bars.mass_kg == pytest.approx([1500.0])
    assert bars.spring_n_m == pytest.approx([1500.0 * omega**2])
    assert bars.dashpot_ns_m == pytest.approx([2.0 * zeta * 1500.0 * omega])
    memory = at_rest(bars)
    push, force, elastic, *_ = act(bars, support=0.01, speed=0.2, memory=memory, ground=0.7)
    back = -1500.0 * omega**2 * 0.01 - 2.0 * zeta * 1500.0 * omega * 0.2
    assert push[0] == pytest.approx(0.0, abs=1e-6)  # façade and floor have not moved
    assert force == pytest.approx(back)
    assert memory.rate_m_s2[0] == pytest.approx(-back / 1500.0 - 0.7)
    assert elastic == pytest.approx(0.5 * 1500.0 * omega**2 * 1e-4)
    module.advance(bars, memory, 5e-5, 1e-4)
    assert memory.speed_m_s[0] == pytest.approx(5e-5 * memory.rate_m_s2[0])
    assert memory.place_m[0] == pytest.approx(1e-4 * memory.speed_m_s[0])
    rate, speed = memory.rate_m_s2[0], memory.speed_m_s[0]
    *_, spent, _ = act(bars, support=0.01, speed=0.2, memory=memory)
    past = speed + 5e-5 * rate - 0.2  # speeds lag half a step
    assert spent == pytest.approx(2.0 * zeta * 1500.0 * omega * past**2 * 1e-4)
