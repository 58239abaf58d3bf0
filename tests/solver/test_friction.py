"""Joints keep their friction, |T| ≤ μN: node by node in each solver, and blocks that slide."""

import numpy as np
import pytest
import reference_solver as reference
from friction_cases import thrown
from reference_solver import contact
from rocking.collapse.scan import BRICKS_STEP, driving
from rocking.mechanics.closed_forms import GRAVITY_M_S2
from rocking.solver import Motions, history, law, march, stack_kernel, to_plane
from rocking.solver.runs import _set_up, stable_step
from test_bricks import job, shaking
from yade_process import in_yade, resolved

from yade_scripts.model.floor_motions import motion_columns
from yade_scripts.model.models import build_scene
from yade_scripts.model.stiffness import critical_step

FRICTION = np.tan(np.radians(8.0))
SPEED_M_S = 0.5
BRICKS = {"W3": 0.1, "W3m": 0.2}  # models and peaks of the ground [g]


def test_spring_and_dashpot_together_keep_coulombs_limit():
    """Whatever moves a node, and no dashpot along the joint gives energy."""
    draw = np.random.default_rng(1).normal
    slides = 0
    for _ in range(4000):
        depth, slip = abs(draw(scale=1e-3)), draw(scale=1e-3)
        rate, speed, step = draw(scale=0.5), draw(scale=0.5), draw(scale=1e-4)
        for drag in (0.0, 1.0):
            normal, shear, _, kept, _, drags, _, _ = law.dry(
                depth, rate, speed, slip, step, False, (2.76e-3, 0.4, 0.6), 1e-4, drag
            )
            assert abs(shear) <= 0.6 * normal * (1.0 + 1e-12)
            assert abs(0.4 * kept) <= 0.6 * normal * (1.0 + 1e-12)
            assert (shear - 0.4 * kept) * speed >= -1e-15
            assert not (drags and drag == 0.0)
            slides += abs(shear) >= 0.6 * normal * (1.0 - 1e-12)
    assert 1000 < slides < 7000


@pytest.mark.slow
@pytest.mark.parametrize("model", BRICKS)
def test_every_node_of_the_bricks_at_every_step(model, monkeypatch):
    """The loop as Python runs it, half a second of shaking that breaks and slides."""
    data = job(model)
    t, columns = shaking(BRICKS[model])
    t, columns = t[:130], {name: values[:130] for name, values in columns.items()}
    scene = build_scene(data)
    plane = to_plane(scene)
    given = motion_columns(scene, columns)
    motions = driving(scene, t, given) if model == "W3" else Motions(t, columns["ground"])
    numerics, seen = {**data["numerics"], "after_motion_s": 0.0}, []
    step = BRICKS_STEP * stable_step(plane)
    shaken = _set_up(plane, motions, numerics, 1.0, None, step)

    dry = law.dry

    def watched(*given):
        seen.append((given, dry(*given)))
        return seen[-1][1]

    monkeypatch.setattr(law, "dry", watched)
    loop = stack_kernel.STACK._replace(one=stack_kernel.march_stack.py_func)
    march.one(loop, plane, shaken, 0, 1, np.zeros((0, 14)))
    normal, shear = np.array([found[:2] for _, found in seen]).T
    most = np.array([given[6][2] for given, _ in seen]) * normal
    assert normal.size > 20000
    assert np.all(np.abs(shear) <= most * (1.0 + 1e-12))
    assert np.mean(np.abs(shear) >= most * (1.0 - 1e-12)) > 0.02  # some slide


def test_every_node_of_the_reference_solver():
    """Its rates at states drawn at random: each of two nodes alone on the base, and both."""
    wall = reference.Wall(6.48, 0.375, beta_s=0.00276, nodes_base=1 + 1, base_friction_deg=30.0)
    model, draw = contact.law_of(wall), np.random.default_rng(3).normal
    limit = np.zeros(wall.eta_m.size)
    state, out = contact.initial(wall), np.zeros(contact.SLIP + wall.eta_m.size)
    none = np.zeros(1)
    for turn, pressed in ((0.0, [0, 1]), (0.01, [1]), (-0.01, [0])):
        height, slides = wall.eta_m * np.sin(turn) - wall.zeta_m * np.cos(turn), 0
        for _ in range(500):
            state[contact.THETA], state[contact.Z] = turn, height.max() - abs(draw(scale=1e-4))
            state[contact.VY], state[contact.VZ] = draw(scale=0.5), draw(scale=0.01)
            state[contact.SLIP :] = draw(scale=1e-4)
            contact.rates(model, state, 0.0, 0.0, none, none, out, limit)
            assert set(np.flatnonzero(limit)) <= set(pressed)
            pushed = abs(out[contact.VY]) * wall.mass_kg
            assert pushed <= limit.sum() * (1.0 + 1e-12)
            slides += pushed >= limit.sum() * (1.0 - 1e-12)
        assert 50 < slides < 500


@pytest.mark.yade
@pytest.mark.parametrize("model", BRICKS)
def test_every_node_of_the_bricks_at_every_step_in_yade(model):
    """What acts on each node's sphere, taken apart."""
    t, columns = shaking(BRICKS[model])
    columns = {name: values[:200].tolist() for name, values in columns.items()}
    found = in_yade(
        "friction_cases", "shears", job=job(model), time_s=t[:200].tolist(), columns=columns
    )
    assert found["status"] == "ok"
    assert found["forces"] > 1e5
    assert found["excess"] < 1e-12


def slippery(e_mpa):
    """A stocky free block on a base with μ = tan 8°, pressed all over its base while it slides."""
    size = {"height_m": 0.8, "thickness_m": 0.4, "friction_deg": 8.0, "e_mpa": e_mpa}
    return resolved(facade=size)


def test_a_thrown_block_with_a_dashpot_along_its_joint():
    """v²/(2μg) less the spring's way back, in steps that the spring takes long to slide in.

    A dashpot without a limit would take β μ g off the speed before that, a quarter of the way.
    """
    config = slippery(500.0)
    plane = to_plane(thrown(config, 0.05, SPEED_M_S))
    numerics = {**config["numerics"], "after_motion_s": 1.0, "rest_time_s": 9.0}
    still = Motions([0.0, 0.5], [0.0, 0.0])
    found = history(plane, still, numerics, step_s=4e-6, sample_s=0.01)
    weight = GRAVITY_M_S2 * plane.mass_kg
    spring = float(np.sum(plane.kn_n_m) * plane.shear_ratio[0])
    way = SPEED_M_S**2 / (2.0 * FRICTION * GRAVITY_M_S2) - FRICTION * weight / spring
    assert found.d_m[-1] == pytest.approx(way, rel=1e-3)


@pytest.mark.yade
def test_both_solvers_slide_a_thrown_block_as_far():
    """With a dashpot along the joint, which friction outweighs once it slides, and without."""
    config, beta = slippery(50000.0), 1e-3
    way = SPEED_M_S**2 / (2.0 * FRICTION * GRAVITY_M_S2)
    scene = thrown(config, beta, SPEED_M_S)
    numerics = {**config["numerics"], "after_motion_s": 1.0, "rest_time_s": 9.0}
    found = history(to_plane(scene), Motions([0.0, 0.5], [0.0, 0.0]), numerics)
    assert found.d_m[-1] == pytest.approx(way, rel=1e-3)
    for drag in (0.0, 1.0):
        given = {"config": config, "beta_s": beta, "speed_m_s": SPEED_M_S, "drag": drag}
        step = 0.2 * critical_step(scene)
        ways = in_yade("friction_cases", "slide", **given, dt_s=step, limit_s=1.0)
        assert ways == pytest.approx(way, rel=1e-3)
