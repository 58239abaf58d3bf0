"""The reduction of the complete building: exact in statics and mass, and YADE's answer."""

from dataclasses import replace

import numpy as np
import pytest
from rocking.building.modes import matrices
from rocking.building.reduced import ReducedScan, in_plane, reduction
from rocking.solver.plane import to_plane
from rocking.solver.runs import history
from scipy.linalg import eigh
from scipy.sparse.linalg import spsolve
from test_complete import THICKNESS_M, T, job, pulses, scene_of
from yade_process import in_yade

from yade_scripts.model.building.complete import apart
from yade_scripts.model.scene import from_dict


@pytest.mark.parametrize("count", [3, 12])
def test_ends_give_way_as_the_whole_building_does(count):
    """Whatever the number of modes, H ω⁻² Hᵀ is the flexibility of the ends along y and z."""
    scene = scene_of("CB")
    found = reduction(scene, count)
    k, _, dof = matrices(apart(scene))
    nodes, back = scene.nodes, scene.nodes.b == scene.index(scene.monitor)
    for rows, axis in ((found.hang, 1), (found.lift, 2)):
        force, unit = np.zeros((k.shape[0], len(found.ends))), np.eye(3)[axis]
        for column, end in enumerate(found.ends):  # a unit force there, and its moment
            arm = nodes.position_m[back & (nodes.a == end)].mean(axis=0)
            moment = np.cross(arm - scene.blocks[end].centre_m, unit)
            mine = dof[:, 0] == end
            force[mine, column] = np.concatenate([unit, moment])[dof[mine, 1]]
        flexibility = force.T @ spsolve(k.tocsc(), force)
        got = (rows / found.omega**2) @ rows.T
        assert np.abs(got - flexibility).max() < 1e-6 * np.abs(flexibility).max()


def test_mass_and_drag_are_those_behind_the_crack():
    """All coordinates together carry the moving mass; their drag acts on translations alone."""
    scene = scene_of("CB")
    few, many = reduction(scene, 5), reduction(scene, 80)
    mass = sum(b.mass_kg for b in scene.blocks if b.free and b.name != scene.monitor)
    assert many.participation @ many.participation == pytest.approx(mass, rel=0.02)
    assert few.participation @ few.participation < many.participation @ many.participation
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
def test_the_reduction_rocks_as_yade_does():
    """Top of the façade before its walls, every brick in YADE beside 30 modes: 1 % of its peak."""
    work, ground = job("CB"), 1.5 * pulses()
    got = in_yade(
        "complete_cases", "shaken", job=work, time_s=T.tolist(), ground=ground.tolist(), drop=False
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
    assert np.abs(rows[:, 2]).max() > 0.1 * 0.5 * THICKNESS_M
    shaken = rows[:, 0] < T[-1]
    error = np.abs(rows[:, 2] - rows[0, 2] - expected)[shaken].max()
    assert error < 0.01 * np.abs(rows[:, 2]).max()
