"""One history by the compiled solver and by YADE, which have to agree."""

import numpy as np
import pytest
from rocking.solver.plane import moving_supports, to_plane
from rocking.solver.runs import Motions, history
from yade_process import in_yade

from yade_scripts.model.floor_motions import motion_columns
from yade_scripts.model.stiffness import assemble

BETA_S = 0.002
FEW = {  # the end nodes are stiff: a sharp toe
    "nodes_thickness": 3,
    "nodes_height": 3,
    "nodes_per_block": 3,
    "after_motion_s": 0.5,
}


def pulses(amplitude):
    """Pulses of 1 s that end where they began [m/s²]."""
    t = np.arange(0.0, 3.0, 0.01)
    place = np.sin(2.0 * np.pi * t) * np.exp(-(((t - 1.5) / 0.7) ** 2)) / (2.0 * np.pi) ** 2
    return t, -amplitude * np.gradient(np.gradient(place, t), t)


def slow(peak_m_s2):
    """A push that grows in 3 s and stays for 5 s."""
    t = np.linspace(0.0, 8.0, 801)
    return t, peak_m_s2 * 0.5 * (1.0 - np.cos(np.pi * np.minimum(t / 3.0, 1.0)))


def same_matrices(scene, mass, k, c):
    """M, K and C of a plane are those of its scene."""
    found = assemble(scene)
    assert mass == pytest.approx(found.mass)
    for one, other in zip((k, c), found.dense(), strict=True):
        assert one == pytest.approx(other, rel=1e-9, abs=1e-9 * np.abs(other).max())


def agreed(config, scene, model, amplitude, fraction):
    """Shake a scene in both: peaks d/b within 1 %, and YADE's energy balance closes.

    Floors of the building move by the ground's motion times 1.1 to 1.4. `fraction` is YADE's
    share of its critical step. Returns the compiled solver's history and YADE's values.
    """
    t, ground = pulses(amplitude)
    columns = {f"floor{j}": ground * (1.0 + 0.1 * j) for j in range(1, 5)} | {"ground": ground}
    moved = motion_columns(scene, columns)
    supports = [moved[m] for m in moving_supports(scene)]
    motions = Motions(t, moved[scene.blocks[0].motion], supports)
    planar = history(to_plane(scene), motions, config["numerics"], sample_s=0.01)
    got = in_yade(
        "accuracy_cases", "balanced", config=config, model=model, beta_s=BETA_S,
        fraction=fraction, time_s=t.tolist(), columns={k: v.tolist() for k, v in columns.items()},
    )  # fmt: skip
    assert got["status"] == planar.status == "ok"
    assert got["peak"] > 0.05
    assert got["peak"] == pytest.approx(planar.peak_d_over_b, rel=0.01)
    assert got["residual"] < 2e-3 * got["overturning"]
    return planar, got
