"""Where the energy of a run goes: what is lost and stored over time, and the residual below."""

import matplotlib.pyplot as plt
from rocking.figures import style
from rocking.figures.panels import common_legend
from rocking.runtime.script import run
from rocking.tables import read_frame

LOSSES = {
    "dashpots_j": ("dashpots", "#0072B2"),
    "friction_j": ("friction", "#E69F00"),
    "fracture_j": ("broken bonds", "#CC79A7"),
}
STORED = ("kinetic_j", "potential_j", "elastic_j")
LEAST = 1e-6  # of the overturning energy, below which a residual is not drawn


def panel(top, bottom, history):
    """One run: terms over the energy that overturns the façade."""
    facts, t = history.iloc[0], history["time_s"]
    energy = history.drop(columns=["model", "record", "direction", "status"]).div(
        facts["overturning_j"]
    )
    lost = 0.0 * energy["input_j"]
    for column, (label, colour) in LOSSES.items():
        if energy[column].abs().max() > LEAST:
            top.fill_between(
                t, lost, lost + energy[column], color=colour, lw=0, alpha=0.6, label=label
            )
            lost = lost + energy[column]
    stored = energy[list(STORED)].sum(axis=1)
    top.fill_between(
        t, lost, lost + stored, color=style.GREY, lw=0, label="kinetic, potential, elastic"
    )
    top.plot(t, energy["input_j"], color="black", lw=0.8, label="input")
    sign = style.SIGNS[facts["direction"]]
    top.set_title(f"{facts['model']} {facts['record']} {sign}, {facts['pga_g']:.3f} g")
    bottom.semilogy(t, 100.0 * energy["residual_j"].abs().clip(lower=LEAST), color="#D55E00")
    bottom.set(xlabel="time (s)", ylim=(100.0 * LEAST, 10.0))
    bottom.axhline(1.0, color="0.4", lw=0.8, ls=":")


def main(job):
    histories = [read_frame(path) for path in job.input.histories]
    figure, axes = plt.subplots(
        2,
        len(histories),
        figsize=(2.3 * len(histories) + 1.8, 4.4),
        squeeze=False,
        sharex="col",
        height_ratios=[2, 1],
    )
    for (top, bottom), history in zip(axes.T, histories, strict=True):
        panel(top, bottom, history)
    axes[0, 0].set_ylabel("energy over m g (R − h/2) (-)")
    axes[1, 0].set_ylabel("|residual| (%)")
    common_legend(figure, loc="outside right upper", fontsize=7)
    style.save(figure, job.output, job.input.facts)


run(main, globals())
