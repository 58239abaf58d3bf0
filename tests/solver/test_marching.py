"""Motions on the grid of steps, stop rules, and the largest step: in closed form, without a run."""

import numpy as np
import pytest
from rocking.mechanics import closed_forms
from rocking.solver import Motions, bodies, stable_step
from rocking.solver import motions as solver_motions
from rocking.solver.runs import _largest_step, _set_up, limits
from test_plane import BETA_S, case

NUMERICS = {
    "quiet_ratio": 0.1,
    "after_motion_s": 7.0,
    "overturn_ratio": 2.0,
    "rest_velocity_m_s": 1e-3,
    "rest_time_s": 0.5,
    "max_speed_ratio": 3.0,
}


def test_motions_on_the_steps_are_exact():
    """ẅ = 2 + 3t before a ground of 1 − t: v = t + 2t², u = t²/2 + 2t³/3, whatever the samples."""
    t = np.array([0.0, 0.3, 0.7, 1.0])
    motions = Motions(t, 1.0 - t, [2.0 + 3.0 * t], 0.5 * t)
    table = motions.table(0.01)
    ground, vertical, places, speeds = table.rows.reshape(-1, 4).T
    at = 0.01 * np.arange(101)
    assert table.step_s == 0.01
    assert ground[:101] == pytest.approx(1.0 - at)
    assert vertical[:101] == pytest.approx(0.5 * at)
    assert speeds[:101] == pytest.approx(at + 2.0 * at**2)
    assert places[:101] == pytest.approx(0.5 * at**2 + 2.0 * at**3 / 3.0)
    # from 1 to 1.3 s accelerations fall to zero: then the ground rests, and what moves coasts
    assert ground[-1] == pytest.approx(0.0, abs=1e-12)
    relative = 4.0 + 0.0
    speed = 3.0 + 0.5 * 0.3 * (5.0 - 0.0)
    place = 0.5 + 2.0 / 3.0 + 3.0 * 0.3 + relative * 0.0 + 5.0 * 0.3**2 / 3.0
    assert speeds[-1] == pytest.approx(speed)
    assert places[-1] == pytest.approx(place)


def test_tables_are_kept_up_to_a_size(monkeypatch):
    """Twelve steps of a scan are tabulated once; beyond the size the oldest go, the last stays."""
    t = np.linspace(0.0, 1.0, 11)
    motions, steps = Motions(t, 0.0 * t, [t]), 0.01 + 1e-4 * np.arange(12)
    first = [motions.table(step) for step in steps]
    assert all(motions.table(step) is table for step, table in zip(steps, first, strict=True))
    monkeypatch.setattr(solver_motions, "KEPT", 1)
    last = motions.table(0.02)
    assert motions.table(0.02) is last
    assert motions.table(steps[0]) is not first[0]
    assert np.array_equal(motions.table(steps[0]).rows, first[0].rows)


def test_a_grid_that_ends_after_the_motion_coasts():
    motions = Motions([0.0, 0.1, 0.2], np.zeros(3), [[1.0, 1.0, 0.0]])
    table, end = motions.table(0.07), 0.3
    *_, places, speeds = table.rows.reshape(-1, 4).T
    last = 0.07 * (len(places) - 1)
    assert last > end
    speed = 0.15
    assert speeds[-1] == pytest.approx(speed)
    place = 0.1**2 / 2 + 0.1 * 0.1 + 0.1**2 / 3 + speed * (last - 0.2)
    assert places[-1] == pytest.approx(place)


def test_a_history_ends_by_rules_that_follow_the_motion():
    """Quiet below a tenth of what uplifts, or of the motion; failed from thrice its speed."""
    t = np.arange(0.0, 2.0001, 0.1)
    ground = np.where(t < 0.95, 1.0, np.where(t < 1.45, -0.15, 0.01))
    ground[(t > 1.05) & (t < 1.35)] = 0.01  # a quiet spell is not the end
    motions, factors = Motions(t, ground), np.array([0.5, -10.0])
    _, planar = case("free", 0.0)
    uplift = 2.0 * planar.height_m / 0.4  # gravity that makes b/h of it 2 m/s²
    flat = planar._replace(gravity_m_s2=uplift, thickness_m=0.4)
    end, quiet, speed, limit, last = limits(flat, motions, NUMERICS, factors, 0.01).T
    assert limit == pytest.approx([900.0, 900.0])  # 2 s and 7 after them, in steps
    assert last == pytest.approx([210.0, 210.0])  # it ends at zero one sample after its last
    rules = _set_up(flat, motions, NUMERICS, factors, None, 0.01).rules
    assert rules.overturn_m == pytest.approx(0.8)
    assert rules.rest_m == pytest.approx(0.2)  # half the thickness: beyond it nothing is at rest
    assert (rules.rest_velocity_m_s, rules.rest_time_s) == (1e-3, 0.5)
    assert quiet == pytest.approx([0.05, 0.2])  # of the motion's 0.5, of the uplift's 2 m/s²
    assert end == pytest.approx([1.4, 1.4])  # 0.15 counts in both, 0.01 in none
    most = motions.peak_speed()
    assert most == pytest.approx(1.0 * 0.9 + 0.5 * 0.1 * 0.85, rel=0.01)
    assert speed == pytest.approx(3.0 * (np.array([0.5, 10.0]) * most + 1.0))


@pytest.mark.parametrize("beta_s", [0.0, BETA_S])
def test_step_of_a_block_alone_is_that_of_its_modes(beta_s):
    """Its dashpots are taken at the step's own velocity, so 2/ω of the stiffest mode, with or
    without: on a base of k along z, k·r along y and k b²/12 in rotation, uncoupled but for the
    shear's arm h/2."""
    config, planar = case("free", beta_s)
    f = config["facade"]
    h, b, w, r = f["height_m"], f["thickness_m"], f["width_m"], f["shear_stiffness_ratio"]
    k = f["e_mpa"] * 1e6 / h * b * w
    m, inertia = planar.mass_kg, planar.inertia_kg_m2
    arm, turn = 0.5 * h, k * b**2 / 12.0
    stiffness = np.array([[r * k, r * k * arm], [r * k * arm, r * k * arm**2 + turn]])
    values = np.linalg.eigvals(np.linalg.solve(np.diag([m, inertia]), stiffness))
    stiffest = np.sqrt(max(k / m, values.real.max()))
    assert stable_step(planar) == pytest.approx(2.0 / stiffest, rel=1e-6)
    assert closed_forms.block(h, b).p_rad_s < stiffest


def test_step_before_masses():
    """Stiff walls bound it by their own 2/ω; dashpots that masses feel shorten it."""
    config, planar = case("W1", 0.0)
    alone, mass, omega = stable_step(planar), 1e6, 5e3
    walls = int(planar.support.max()) + 1
    assert walls == 0  # W1 stands before walls that do not move against the ground
    _, planar = case("W2", 0.0)
    four = np.eye(4)
    stiff = bodies(mass * np.ones(4), mass * omega**2 * four, 0.0 * four)
    assert stable_step(planar, stiff) == pytest.approx(2.0 / omega, rel=1e-3)
    soft = bodies(mass * np.ones(4), 1.0 * four, 0.0 * four)
    assert stable_step(planar, soft) == pytest.approx(alone, rel=0.01)
    light = bodies(1e3 * np.ones(4), 1.0 * four, 0.0 * four)
    _, damped = case("W2", BETA_S)
    assert stable_step(damped, light) < 0.9 * stable_step(planar, light)
    zeta = 0.5
    own = bodies(mass * np.ones(4), mass * omega**2 * four, 2.0 * zeta * mass * omega * four)
    late = 2.0 / omega * (np.sqrt(1.0 + zeta**2) - zeta)  # dashpots half a step behind
    assert stable_step(planar, own) < 1.2 * late


@pytest.mark.parametrize("seed", range(3))
def test_beyond_the_stable_step_the_scheme_grows(seed):
    """Marched as the loop does: forces at the velocity that the last acceleration predicts, then
    the dashpots of each block alone at the velocity of the step itself."""
    draw, n = np.random.default_rng(seed), 4
    one = draw.normal(size=(n, n))
    k, mass = 100.0 * one @ one.T, np.diag(1.0 + draw.random(n))
    c, alone = 0.05 * k, np.kron(np.eye(2), np.ones((2, 2))) > 0
    own = np.where(alone, c, 0.0)
    step = _largest_step(mass, k, c, alone)

    def size(h):
        x, v, a = draw.normal(size=n), np.zeros(n), np.zeros(n)
        for _ in range(4000):
            force = -k @ x - c @ (v + 0.5 * h * a)
            a = np.linalg.solve(mass + 0.5 * h * own, force + 0.5 * h * own @ a)
            v = v + h * a
            x = x + h * v
        return np.abs(x).max()

    assert step < 2.0 / np.sqrt(np.linalg.eigvals(np.linalg.solve(mass, k)).real.max())
    assert size(0.99 * step) < 10.0
    assert not size(1.01 * step) < 1e6
