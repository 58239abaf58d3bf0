"""Time histories of brick buildings: modal against direct and explicit integration."""

import numpy as np
import pytest
from rocking.mechanics.closed_forms import rayleigh_ratio
from scipy.sparse.linalg import spsolve
from studies.building.comparison import chain_top, top_motion
from studies.building.history import LOADS, mass_damping_rate, modal_history
from studies.building.model.assembly import build
from studies.building.modes import Solver, largest_frequency
from studies.building.yade.explicit_building import corner
from yade_process import run_study

import smdof
from yade_scripts.model.building.plan import Opening, Plan, PlanWall
from yade_scripts.model.scene import to_json


@pytest.fixture(scope="module")
def wall():
    """A wall out of plane along y, a few bricks: the scene, its solver and all but one mode."""
    plan = Plan("wall", (PlanWall("wall", (0.0, 0.0), (0.96, 0.0), 0.24, 1.92),))
    building = build(plan, coarsening=4.0)
    solver = Solver(building.scene)
    return building.scene, solver, solver.modes(len(solver.mass) - 1)


@pytest.fixture(scope="module")
def ground():
    time = np.arange(201) * 0.01
    return time, 2.0 * np.sin(9.0 * time) * np.exp(-((time - 0.8) ** 2) / 0.2)


def test_modal_history_equals_direct_integration(wall, ground):
    """Newmark's average acceleration on the full matrices, a step far below the shortest period."""
    scene, solver, modes = wall
    time, motion = ground
    rate = mass_damping_rate(modes.omega[modes.largest("y")], 0.05)
    top = scene.index(scene.monitor)
    history = modal_history(modes, [top], motion, 0.01, rate)
    fine = np.linspace(0.0, 2.0, 8001)
    a_g, step = np.interp(fine, time, motion), fine[1]
    k, mass = solver.k.toarray(), solver.mass
    r = (solver.dof[:, 1] == 1).astype(float)
    inverse = np.linalg.inv(np.diag(mass * (1.0 + 0.5 * step * rate)) + 0.25 * step**2 * k)
    u, v, a = np.zeros(len(mass)), np.zeros(len(mass)), -r * a_g[0]
    row = np.flatnonzero((solver.dof[:, 0] == top) & (solver.dof[:, 1] == 1))[0]
    absolute = np.zeros(len(fine))
    for n in range(1, len(fine)):
        u_try = u + step * v + 0.25 * step**2 * a
        v_try = v + 0.5 * step * a
        a = inverse @ (-mass * r * a_g[n] - rate * mass * v_try - k @ u_try)
        u, v = u_try + 0.25 * step**2 * a, v_try + 0.5 * step * a
        absolute[n] = a[row] + a_g[n]
    modal = np.interp(fine, history.time_s, history.acceleration_m_s2[0])
    assert np.abs(modal - absolute).max() < 0.01 * np.abs(absolute).max()


def test_sudden_gravity_rings_about_the_static_deflection(wall):
    scene, solver, modes = wall
    top = scene.index(scene.monitor)
    history = modal_history(
        modes, [top], np.zeros(2001), 0.01, 8.0, direction="z", gravity_m_s2=9.81
    )
    down = solver.dof[:, 1] == 2
    static = spsolve(solver.k, -9.81 * solver.mass * down)
    row = np.flatnonzero((solver.dof[:, 0] == top) & down)[0]
    assert history.displacement_m[0, -1] == pytest.approx(static[row], rel=1e-4)
    assert history.displacement_m[0].min() == pytest.approx(2.0 * static[row], rel=0.1)


def test_mass_damping_gives_its_ratio_at_its_frequency():
    """Eq. 2 with β = 0: ζ = a/2ω; and a rate stated for 0.25 s gives less to what is faster."""
    omega = 2.0 * np.pi / 0.25
    rate = mass_damping_rate(omega, 0.05)
    assert rayleigh_ratio(omega, rate, 0.0) == pytest.approx(0.05)
    assert rayleigh_ratio(2.0 * omega, rate, 0.0) == pytest.approx(0.025)


def test_sudden_gravity_is_twice_the_static_deflection_and_its_absence_nothing(wall):
    """A weight applied at once swings about its static place; without it a still wall is still."""
    scene, solver, modes = wall
    top = scene.index(scene.monitor)
    static = solver.static(-9.81 * solver.mass * (solver.dof[:, 1] == 2))
    row = np.flatnonzero((solver.dof[:, 0] == top) & (solver.dof[:, 1] == 2))[0]
    lowest = {
        name: modal_history(
            modes, [top], np.zeros(400), 0.01, 8.0, direction="z", gravity_m_s2=gravity
        ).displacement_m.min()
        for name, gravity in LOADS.items()
    }
    assert lowest["sudden gravity"] == pytest.approx(2.0 * static[row], rel=0.1)
    assert lowest["without dead load"] == 0.0
    assert LOADS == {"sudden gravity": 9.81, "without dead load": 0.0}


def test_history_refuses_supports_and_overdamping(wall, ground):
    scene, _, modes = wall
    with pytest.raises(ValueError, match="not free along y"):
        modal_history(modes, [len(scene.blocks) - 1], ground[1], 0.01, 1.0)
    with pytest.raises(ValueError, match="overdamps"):
        modal_history(modes, [0], ground[1], 0.01, 1e4)


def test_wme_is_zero_for_itself_and_grows_with_a_wrong_period(ground):
    _, motion = ground
    exact = top_motion(*chain_top(motion, 0.01, 4, 0.27, 0.05), 2.0, 25.0)
    errors = [
        exact.wme(top_motion(*chain_top(motion, 0.01, 4, period, 0.05), 2.0, 25.0))
        for period in (0.27, 0.28, 0.30)
    ]
    for quantity in exact.curves:
        values = [e[quantity] for e in errors]
        assert values[0] == 0.0
        assert values[0] < values[1] < values[2]


@pytest.mark.yade
def test_explicit_run_rings_under_sudden_gravity(tmp_path):
    """A wall with a door near one end leans as it settles: the corner's motion is the modal one."""
    door = Opening("door", 0.24, 0.72, 0.0, 1.2)
    plan = Plan("wall", (PlanWall("wall", (0.0, 0.0), (0.0, 1.92), 0.24, 1.92, openings=(door,)),))
    scene = build(plan, coarsening=4.0).scene
    solver = Solver(scene)
    modes = solver.modes(len(solver.mass) - 1)
    step = 0.8 * 2.0 / largest_frequency(solver.k, solver.mass)
    scene.notes.update(rate_1_s=5.0, duration_s=0.3, step_s=step)
    (tmp_path / "scene.json").write_text(to_json(scene))
    (tmp_path / "motion.csv").write_text("time_s,acceleration_m_s2\n0,0\n0.3,0\n")
    words = ["explicit_building", "--scene", "scene.json", "--motion", "motion.csv"]
    found = {}
    for load, gravity in (("plain", "0"), ("loaded", "9.81")):
        done = run_study(*words, "--gravity", gravity, "--output", f"{load}.csv", folder=tmp_path)
        assert done.returncode == 0, done.stderr
        found[load] = np.loadtxt(tmp_path / f"{load}.csv", delimiter=",", skiprows=1)
    assert np.abs(found["plain"][:, 4]).max() < 1e-12  # rounding
    history = modal_history(
        modes, [corner(scene)], np.zeros(31), 0.01, 5.0, gravity_m_s2=LOADS["sudden gravity"]
    )
    grid = smdof.common_grid(
        history.time_s, history.displacement_m[0], found["loaded"][:, 0], found["loaded"][:, 4]
    )
    assert smdof.weighted_mean_error(*grid) < 0.05


@pytest.mark.yade
def test_explicit_run_agrees_with_modal_superposition(wall, ground, tmp_path):
    scene, solver, modes = wall
    time, motion = ground
    rate = mass_damping_rate(modes.omega[modes.largest("y")], 0.05)
    scene.notes.update(
        rate_1_s=rate, duration_s=1.5, step_s=0.8 * 2.0 / largest_frequency(solver.k, solver.mass)
    )
    (tmp_path / "scene.json").write_text(to_json(scene))
    np.savetxt(
        tmp_path / "motion.csv",
        np.column_stack([time, motion]),
        delimiter=",",
        header="time_s,acceleration_m_s2",
        comments="",
    )
    words = ["explicit_building", "--scene", "scene.json", "--motion", "motion.csv"]
    done = run_study(*words, "--output", "out.csv", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    explicit = np.loadtxt(tmp_path / "out.csv", delimiter=",", skiprows=1)
    keep = time <= explicit[-1, 0] + 0.01
    history = modal_history(modes, [scene.index(scene.monitor)], motion[keep], 0.01, rate)
    for column, values in ((1, history.acceleration_m_s2[0]), (3, history.displacement_m[0])):
        grid = smdof.common_grid(history.time_s, values, explicit[:, 0], explicit[:, column])
        assert smdof.weighted_mean_error(*grid) < 0.02
    # the step that the stability limit forbids is noticed, not reported as a motion
    scene.notes["step_s"] *= 1.4
    (tmp_path / "scene.json").write_text(to_json(scene))
    failed = run_study(*words, "--output", "bad.csv", folder=tmp_path)
    assert failed.returncode != 0
    assert "step is too long" in failed.stderr
    assert not (tmp_path / "bad.csv").exists()
