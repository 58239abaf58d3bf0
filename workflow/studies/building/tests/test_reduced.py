"""The reduction of the complete building: exact in statics and mass, and YADE's answer."""

from dataclasses import replace

import numpy as np
import pytest
from rocking.solver.plane import matrices as plane_matrices
from rocking.solver.plane import to_plane
from rocking.solver.runs import history, stable_step
from rocking.solver.substructure import bodies
from scipy.linalg import block_diag, eigh
from scipy.sparse.linalg import spsolve
from studies.building.modes import matrices
from studies.building.reduced import ReducedScan, in_plane, reduction
from studies.building.yade.complete import apart
from test_complete import THICKNESS_M, T, job, pulses, scene_of
from yade_process import in_yade

from yade_scripts.model.scene import from_dict


@pytest.mark.parametrize("count", [3, 12])
def test_ends_give_way_as_the_whole_building_does(count):
    """Whatever the number of modes, H ω⁻² Hᵀ is the flexibility of the ends: y, z, rotation x."""
    scene = scene_of("CB")
    found = reduction(scene, count)
    k, _, dof = matrices(apart(scene))
    nodes, back = scene.nodes, scene.nodes.b == scene.index(scene.monitor)
    ends = len(found.ends)
    force, unit = np.zeros((k.shape[0], 3 * ends)), np.eye(3)
    for column, end in enumerate(found.ends):  # unit forces there with their moments, a moment
        arm = nodes.position_m[back & (nodes.a == end)].mean(axis=0) - scene.blocks[end].centre_m
        mine = dof[:, 0] == end
        loads = [np.concatenate([unit[axis], np.cross(arm, unit[axis])]) for axis in (1, 2)]
        for turn, load in enumerate([*loads, np.eye(6)[3]]):
            force[mine, column + turn * ends] = load[dof[mine, 1]]
    flexibility = force.T @ spsolve(k.tocsc(), force)
    rows = np.vstack([found.hang, found.lift, found.roll])
    got = (rows / found.omega**2) @ rows.T
    size = np.sqrt(np.diag(flexibility))  # forces and moments have different units
    assert np.abs((got - flexibility) / np.outer(size, size)).max() < 1e-6


def test_first_period_of_the_bonded_building_is_that_of_the_bricks():
    """Façade in its plane on the reduction beside it on every brick; without roll it is stiffer."""
    scene = scene_of("CBc")
    found = reduction(scene, 30)
    mass, own, _ = plane_matrices(to_plane(in_plane(scene, found.ends)), len(found.ends))
    blocks, facade = list(scene.blocks), scene.index(scene.monitor)
    blocks[facade] = replace(blocks[facade], free="yzX")
    k, m, dof = matrices(replace(scene, blocks=blocks))
    squared, phi = eigh(k.toarray(), np.diag(m), subset_by_index=[0, 7])
    along = np.abs(phi.T @ (m * (dof[:, 1] == 1)))
    expected = squared[along.argmax()]

    def lowest(roll):
        whole = block_diag(np.eye(3), np.vstack([found.hang, found.lift, roll * found.roll]))
        stiff = whole.T @ own @ whole
        stiff[3:, 3:] += np.diag(found.omega**2)
        inertia = np.diag(np.concatenate([mass, np.ones(len(found.omega))]))
        values, shapes = eigh(stiff, inertia)
        ground = np.concatenate([[mass[0], 0.0, 0.0], found.participation])
        return values[np.abs(ground @ shapes).argmax()]

    assert lowest(1.0) == pytest.approx(expected, rel=2e-3)
    assert lowest(0.0) > 1.005 * lowest(1.0)


def one_by_one(plane, carried):
    """The same with a support of its own for each node of an end; none of them turns."""
    held = np.repeat(plane.support, np.diff(plane.first))
    group = np.repeat(np.arange(len(plane.support)), np.diff(plane.first))
    alone = np.flatnonzero(held >= 0)
    whole = np.flatnonzero(plane.support < 0)
    order = np.concatenate([np.flatnonzero(np.isin(group, whole)), alone])
    sizes = np.concatenate([np.diff(plane.first)[whole], np.ones(len(alone), int)])
    groups = np.concatenate([whole, group[alone]])
    reach = plane.place_m[alone, None] * plane.along[group[alone]]
    arm = plane.arm_m[group[alone]] + reach
    more = {name: getattr(plane, name)[groups] for name in GROUPED}
    more |= {name: getattr(plane, name)[order] for name in NODAL}
    more["origin_m"][len(whole) :] += reach
    more["place_m"][-len(alone) :] = 0.0
    more["support"][len(whole) :] = np.arange(len(alone))
    more["first"] = np.concatenate([[0], np.cumsum(sizes)])
    own = held[alone]
    return plane._replace(**more), bodies(
        carried.mass_kg,
        carried.k_n_m,
        carried.c_n_s_m,
        hang=carried.hang[own] - arm[:, 1:] * carried.roll[own],
        lift=carried.lift[own] + arm[:, :1] * carried.roll[own],
        ground=carried.ground,
    )


GROUPED = (
    *("origin_m", "along", "normal", "arm_m", "level_m", "carried", "support"),
    *("beta_s", "shear_ratio", "friction"),
)
NODAL = ("place_m", "kn_n_m", "pull_m", "hold_m", "bonded", "tie")


@pytest.mark.parametrize(("model", "size"), [("CB", 1.5), ("CBc", 1.5), ("CBc", 40.0)])
def test_an_end_that_turns_moves_its_nodes_as_a_support_for_each_would(model, size):
    """Peaks before uplift, as bonds break and as the façade rocks; stable steps alike."""
    scene = scene_of(model)
    screen = ReducedScan([scene], 12, job(model)["numerics"], T, size * pulses(), "pos")
    plane, carried = screen.planes[0], screen.carried
    numerics, step = job(model)["numerics"], screen.steps_s[0]
    found = [
        history(p, screen.motions, numerics, carried=c, step_s=step, sample_s=0.0)
        for p, c in ((plane, carried), one_by_one(plane, carried))
    ]
    turned, split = found
    assert turned.broken == split.broken
    assert (turned.broken > 0) == (size > 2.0)
    assert turned.pose == pytest.approx(split.pose, rel=1e-6, abs=1e-7 * np.ptp(split.pose[:, 0]))
    assert turned.spent_j == pytest.approx(split.spent_j, rel=1e-5, abs=1e-6 * split.spent_j.max())
    steps = [stable_step(p, c) for p, c in ((plane, carried), one_by_one(plane, carried))]
    assert steps[0] == pytest.approx(steps[1], rel=1e-6)
    own = carried.mass_kg, carried.k_n_m, carried.c_n_s_m
    still = bodies(*own, carried.hang, carried.lift, 0.0 * carried.roll, carried.ground)
    other = history(plane, screen.motions, numerics, carried=still, step_s=step, sample_s=0.0)
    assert np.abs(other.peak_d_over_b / turned.peak_d_over_b - 1.0) > 1e-6


def test_the_step_is_stable_for_what_carries_the_walls_and_for_the_facade():
    """Neither beyond the whole building's critical step nor near the façade's; answers converge."""
    scene = scene_of("CB")
    numerics, ground = job("CB")["numerics"], 1.5 * pulses()
    screen = ReducedScan([scene], 12, numerics, T, ground, "pos")
    assert screen.steps_s[0] < scene.notes["critical_step_s"]
    assert screen.steps_s[0] <= 0.1 * stable_step(screen.planes[0])
    height_m = scene.blocks[scene.index(scene.monitor)].size_m[2]
    assert screen.static_g == pytest.approx(THICKNESS_M / height_m, rel=1e-6)  # of a rigid wall
    slow = replace(scene, notes={**scene.notes, "critical_step_s": 1e-5})
    assert ReducedScan([slow], 12, numerics, T, ground, "pos").steps_s[0] < 1e-5


def test_only_nodes_of_a_support_turn_with_it():
    """A wall's nodes on the façade would stand on a plane that turns: refused in one line."""
    screen = ReducedScan([scene_of("CB")], 3, job("CB")["numerics"], T, pulses(), "pos")
    plane = screen.planes[0]
    with pytest.raises(ValueError, match="supports that turn to carry their own nodes"):
        history(
            plane._replace(carried=np.ones_like(plane.carried)),
            screen.motions,
            screen.numerics,
            carried=screen.carried,
        )


def test_mass_and_drag_are_those_behind_the_crack():
    """All coordinates together carry the moving mass; their drag acts on translations alone."""
    scene = scene_of("CB")
    few, many = reduction(scene, 5), reduction(scene, 80)
    mass = sum(b.mass_kg for b in scene.blocks if b.free and b.name != scene.monitor)
    assert many.participation @ many.participation == pytest.approx(mass, rel=0.02)
    own, whole = (one.participation @ one.participation for one in (few, many))
    assert own == pytest.approx(whole, rel=1e-9)  # static responses are among the fewest
    assert np.all((many.moving > 0.0) & (many.moving <= 1.0 + 1e-12))
    assert few.omega[0] == pytest.approx(many.omega[0], rel=1e-6)
    carried = many.carried(2.0)
    ratio = carried.hang / np.sqrt(carried.mass_kg)
    assert ratio == pytest.approx(many.hang)
    assert carried.ground * np.sqrt(carried.mass_kg) == pytest.approx(many.participation)


def test_drag_takes_the_share_of_translation_of_every_mode():
    """The lowest modes behind the crack, solved densely: Σ m φ² over translations alone."""
    scene, rate = scene_of("CB"), 2.0
    found = reduction(scene, 12)
    blocks, facade = list(scene.blocks), scene.index(scene.monitor)
    blocks[facade] = replace(blocks[facade], free="")
    k, mass, dof = matrices(apart(replace(scene, blocks=blocks)))
    squared, phi = eigh(k.toarray(), np.diag(mass), subset_by_index=[0, 3])
    moving = (mass[:, None] * phi**2)[dof[:, 1] < 3].sum(axis=0)
    assert found.omega[:4] == pytest.approx(np.sqrt(squared), rel=1e-4)
    assert found.moving[:4] == pytest.approx(moving, rel=1e-3)
    assert moving.min() < 0.99
    carried = found.carried(rate)
    drag = np.diag(carried.c_n_s_m) / carried.mass_kg
    assert drag[:4] == pytest.approx(rate * moving, rel=1e-3)


@pytest.mark.yade
@pytest.mark.parametrize("model", ["CB", "CBc"])
def test_the_reduction_rocks_as_yade_does(model):
    """Façade before its walls, or bonded to them, every brick in YADE: 1 % of its peak."""
    work, ground = job(model), 1.5 * pulses()
    got = in_yade(
        "studies.building.tests.complete_cases",
        "shaken",
        job=work,
        time_s=T.tolist(),
        ground=ground.tolist(),
        drop=False,
    )
    assert got["status"] == "ok", got
    rows = np.array(got["rows"])
    scene = from_dict(work["scene"])
    screen = ReducedScan([scene], 30, work["numerics"], T, ground, "pos")
    plane = to_plane(in_plane(scene, screen.reduction.ends))
    series = history(
        plane,
        screen.motions,
        work["numerics"],
        carried=screen.carried,
        step_s=screen.steps_s[0],
    )
    expected = np.interp(rows[:, 0], series.time_s, series.pose[:, 0])
    assert (np.abs(rows[:, 2]).max() > 0.1 * 0.5 * THICKNESS_M) == (model == "CB")  # else it holds
    shaken = rows[:, 0] < T[-1]
    error = np.abs(rows[:, 2] - rows[0, 2] - expected)[shaken].max()
    assert error < 0.01 * np.abs(rows[:, 2]).max()
