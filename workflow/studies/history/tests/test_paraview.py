"""Histories for ParaView: bodies, forces and instants read back as physics."""

import json
import re

import meshio
import numpy as np
import pytest
from studies.history import paraview
from yade_process import resolved, run_study

from yade_scripts.model import floor_motions

TIME_S = np.linspace(0.0, 0.4, 41)
GROUND = 2.0 * np.sin(2 * np.pi * TIME_S / 0.4)


@pytest.fixture(scope="module", params=["W1", "W1c"])
def written(request, tmp_path_factory):
    """A short history of a model, dry and bonded, written for ParaView."""
    folder = tmp_path_factory.mktemp(request.param)
    job = {**resolved(), "model": request.param, "beta_s": 0.002}
    job["numerics"] = {**job["numerics"], "after_motion_s": 0.0}
    (folder / "scene.json").write_text(json.dumps(job))
    floor_motions.write(folder / "motion.csv", TIME_S, GROUND, [GROUND] * 4)
    words = ["--scene", "scene.json", "--motion", "motion.csv", "--record", "R"]
    more = ["--pga", "0.2", "--contacts", "--output", "f.json"]
    done = run_study("frames", *words, "--direction", "pos", *more, folder=folder)
    assert done.returncode == 0, done.stderr
    frames = json.loads((folder / "f.json").read_text())
    paraview.write(folder / "h.pvd", frames, job["return_wall"]["count"], job)
    return job, frames, folder


@pytest.mark.xdist_group("paraview")
@pytest.mark.yade
def test_blocks_keep_their_volume_and_move_as_their_velocity_says(written):
    job, frames, folder = written
    facade = job["facade"]
    names = [b["name"] for b in frames["blocks"]]
    before, after = (meshio.read(folder / "h" / f"blocks_{k:04d}.vtu") for k in (8, 9))
    mine = before.cell_data["block"][0] == names.index("façade")
    assert mine.sum() == 1
    for mesh in (before, after):
        corner = mesh.points[mesh.cells[0].data[mine][0]]
        edges = corner[[1, 3, 4]] - corner[0]
        volume = facade["height_m"] * facade["thickness_m"] * facade["width_m"]
        assert abs(np.linalg.det(edges)) == pytest.approx(volume, rel=1e-6)
    step_s = frames["time_s"][9] - frames["time_s"][8]
    mean = 0.5 * (before.point_data["velocity_m_s"] + after.point_data["velocity_m_s"])
    moved = after.points - before.points
    assert np.abs(moved[:, 1]).max() > 1e-4
    assert np.abs(moved - step_s * mean)[:, 1].max() < 0.02 * np.abs(moved[:, 1]).max()


@pytest.mark.xdist_group("paraview")
@pytest.mark.yade
def test_contacts_at_rest_carry_the_weight_and_preloads_cancel(written):
    """Of a bonded joint at rest nothing is left, though its two springs are preloaded."""
    job, _, folder = written
    facade = job["facade"]
    volume = facade["height_m"] * facade["thickness_m"] * facade["width_m"]
    weight = 9.80665 * facade["density_kg_m3"] * volume
    mesh = meshio.read(folder / "h" / "contacts_0001.vtu")
    force = mesh.point_data["force_n"].sum(axis=0)
    assert force[2] == pytest.approx(weight, rel=0.01)
    assert abs(force[1]) < 0.15 * weight  # the ground has begun to move
    assert np.abs(mesh.point_data["force_n"]).max() < 0.5 * weight


@pytest.mark.xdist_group("paraview")
@pytest.mark.yade
def test_the_collection_names_every_instant_and_file(written):
    _, frames, folder = written
    text = (folder / "h.pvd").read_text("utf-8")
    times = [float(t) for t in re.findall(r'timestep="([^"]+)" part="0"', text)]
    assert times == pytest.approx(frames["time_s"])
    files = re.findall(r'file="([^"]+)"', text)
    assert len(files) == len(set(files))
    assert all((folder / name).stat().st_size > 100 for name in files)
