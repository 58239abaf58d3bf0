"""W3 in the compiled solver: against YADE by every rule, its matrices, and what falls out."""

import numpy as np
import pytest
from both_solvers import same_matrices
from rocking.collapse.scan import BRICKS_STEP, driving
from rocking.solver import Motions, peaks, to_plane
from rocking.solver.runs import stable_step
from rocking.solver.stack import stack_matrices
from yade_process import in_yade, resolved

from yade_scripts.model.floor_motions import motion_columns
from yade_scripts.model.models import build_scene

FLOORS = [f"floor{j}" for j in range(1, 5)]
FEW = {"nodes_thickness": 9, "after_motion_s": 0.5}


def job(model="W3", **sections):
    """A scene file with courses of twice the default height: half the blocks."""
    w3 = {"course_height_m": 0.648, **sections.pop("w3", {})}
    wall = {"building_mass_kg": 66e3}
    config = resolved(w3=w3, return_wall=wall, numerics=FEW, **sections)
    return {**config, "model": model, "beta_s": 0.00276}


def shaking(peak_g, rise=0.3):
    """A second of ground and floors, the floors moving more with height."""
    t = np.arange(0.0, 1.6, 0.005)
    wave = np.sin(2 * np.pi * 1.6 * t) * np.sin(np.pi * np.minimum(t, 1.25) / 1.25) ** 2
    ground = -peak_g * 9.81 * wave / np.abs(wave).max()
    return t, {"ground": ground} | {
        name: ground * (1.0 + rise * j) for j, name in enumerate(FLOORS, 1)
    }


def compiled(data, t, columns, factors=(1.0,)):
    """Peaks of a scene by the compiled solver, at the step of the scans."""
    scene = build_scene(data)
    plane = to_plane(scene)
    given = motion_columns(scene, columns)
    motions = driving(scene, t, given) if data["model"] == "W3" else Motions(t, columns["ground"])
    step = BRICKS_STEP * stable_step(plane)
    return peaks(plane, motions, data["numerics"], factors, step_s=step)


CUT = {"lower_courses": 9, "split_inclination_deg": 5.0}
CASES = {  # peak [g], model, keys of w3
    "hinged headers": (0.06, "W3", {}),
    "headers that leave their slots": (0.09, "W3", {"lower_courses": 0}),
    "sliding headers": (0.06, "W3", {"header_joint": "sliding"}),
    "headers that break, bricks cut": (0.1, "W3", {"header_joint": "study", **CUT}),
    "hung on the masses": (0.2, "W3m", {}),
}


@pytest.mark.yade
@pytest.mark.parametrize("name", CASES)
def test_yade_and_the_compiled_solver(name):
    """Peak d/b of a history that repeats, within 1 %: each at the step of its own long runs."""
    peak_g, model, w3 = CASES[name]
    data = job(model, w3=w3)
    t, columns = shaking(peak_g)
    one = compiled(data, t, columns)
    given = {key: values.tolist() for key, values in columns.items()}
    ((status, peak),) = in_yade(
        "w3_cases",
        "shake_case",
        job=data,
        fractions=[data["w3"]["step_fraction"]],
        time_s=t.tolist(),
        columns=given,
    )
    assert status == "ok"
    assert peak > 0.02
    assert one.d_over_b[0] == pytest.approx(peak, rel=0.01)


@pytest.mark.parametrize("model", ["W3", "W3m"])
def test_matrices_are_those_of_the_scene(model):
    scene = build_scene(job(model))
    same_matrices(scene, *stack_matrices(to_plane(scene))[:3])
