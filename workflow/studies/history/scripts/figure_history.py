"""One history: displacement, motions, contact forces and energies over time."""

import matplotlib.pyplot as plt
import numpy as np
from rocking.figures import style
from rocking.runtime.script import run
from rocking.tables import read_frame, read_json

from yade_scripts.model.registry import MODELS

FORCES = {
    "base_z_n": ("base, upward", "#0072B2"),
    "base_y_n": ("base, outward", "#56B4E9"),
    "walls_y_n": ("return walls, outward", "#D55E00"),
    "walls_z_n": ("return walls, upward", "#E69F00"),
    "ties_y_n": ("ties, outward", "#009E73"),
    "floors_y_n": ("floors, outward", "#CC79A7"),
}
ENERGIES = {
    "input_j": ("input", "black"),
    "kinetic_j": ("kinetic", "#0072B2"),
    "potential_j": ("potential", "#009E73"),
    "elastic_j": ("elastic", "#CC79A7"),
    "lost_j": ("lost", "#D55E00"),
}


def curves(axis, history, named, scale):
    """Draw the columns that are ever other than zero."""
    for column, (label, colour) in named.items():
        if column in history and np.abs(history[column]).max() > 0.0:
            axis.plot(history["time_s"], history[column] / scale, color=colour, lw=0.8, label=label)


def main(job):
    history = read_frame(job.input.history)
    provenance = style.provenance(read_json(job.input.facts))
    first, t = history.iloc[0], history["time_s"]
    figure, axes = plt.subplots(4, 1, figsize=(7.4, 6.6), sharex=True)
    moved, pulled, pushed, stored = axes
    moved.plot(t, history["d_over_b"], color=MODELS[first["model"]].colour)
    moved.set_ylabel("top displacement\nd/b (-)")
    driven = [c for c in history if c.endswith("_m_s2")]
    top = driven[-1]
    if len(driven) > 1:
        name = top.removesuffix("_m_s2").replace("floor", "floor ")
        pulled.plot(t, history[top], color="#D55E00", lw=0.8, label=name)
    pulled.plot(t, history[driven[0]], color="0.3", lw=0.8, label="ground")
    pulled.set_ylabel("acceleration\n(m/s²)")
    curves(pushed, history, FORCES, 1e3)
    pushed.set_ylabel("force on façade\n(kN)")
    curves(stored, history, ENERGIES, 1e3)
    stored.set(ylabel="energy (kJ)", xlabel="time (s)", xlim=(0.0, t.iloc[-1]))
    for axis in axes[1:]:  # beside the axes: it can lie on no curve
        axis.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    ending = "" if first["status"] == "ok" else f", {first['status']} at {t.iloc[-1]:.2f} s"
    sign = style.SIGNS[first["direction"]]
    figure.suptitle(
        f"{first['model']}, {provenance} {sign}, PGA {first['pga_g']:g} g: "
        f"largest |d|/b {history['d_over_b'].abs().max():.3f}{ending}",
        fontsize=9,
    )
    style.save(figure, job.output, job.input.facts)


run(main, globals())
