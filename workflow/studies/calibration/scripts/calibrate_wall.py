"""β of an own wall from its free rocking: table with band, and a picture."""

import json
import math

import matplotlib.pyplot as plt
import numpy as np
from rocking.figures import style
from rocking.figures.panels import ticks
from rocking.mechanics.beta import groups
from rocking.runtime.script import run
from rocking.tables import write_table
from studies.calibration import free_rocking as study
from studies.calibration.fits import WALL_COLUMNS, rows_of_own, walls_of
from studies.shared.restitution import misfit

COLOURS = ("#0072B2", "#009E73", "#CC79A7")


def main(job):
    config = json.loads(job.params.config)
    measured = config["calibration"]["measured_e"]
    wall = walls_of(job.input.cases, job.input.histories)[0]
    targets = study.targets_of(measured, wall["e_1sr"])
    fit = study.best_fit(wall["beta_s"], wall["e"] / wall["e_1sr"], targets)
    rows = list(rows_of_own(fit, measured, config, job.input.law))
    write_table(rows, job.output.table, WALL_COLUMNS)
    draw(job, config, wall, targets, rows, fit)


def draw(job, config, wall, targets, rows, fit):
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.4, 3.4))
    beta = wall["beta_s"] * 1e3
    for n, (colour, (low, high)) in enumerate(zip(COLOURS, targets, strict=True)):
        left.plot(beta, wall["e"][:, n], "o-", c=colour, label=f"impact {n + 1}")
        low, high = low * wall["e_1sr"], high * wall["e_1sr"]
        left.axhspan(low - 0.003, high + 0.003, color=colour, alpha=0.2, lw=0)
    left.axhline(wall["e_1sr"], c="k", ls=":", lw=0.9, label="|e$_{1SR}$|")
    if math.isfinite(fit["beta_s"]):
        left.axvline(1e3 * fit["beta_s"], c="#D55E00", label=f"best: {1e3 * fit['beta_s']:.3g} ms")
        left.axvspan(1e3 * fit["low_s"], 1e3 * fit["high_s"], color="#D55E00", alpha=0.1, lw=0)
    for row, line in zip(rows[1:], ("--", "-."), strict=False):
        at_ms = 1e3 * row["beta_s"]
        left.axvline(at_ms, c="0.4", ls=line, lw=0.9, label=f"{row['source']}: {at_ms:.3g} ms")
    left.set(xscale="log", xlabel="β [ms]", ylabel="e$_{exp}$ [-]", ylim=(0.0, None))
    ticks(left.xaxis, [float(f"{b:.2g}") for b in beta])
    left.set_title("(a) restitution against its targets (bars)", loc="left")
    left.legend(fontsize=6.3)
    error = misfit(wall["e"] / wall["e_1sr"], 1.0, targets)
    shown = range(0, len(beta), 2)
    colours = plt.get_cmap("viridis")(np.linspace(0.0, 0.85, len(shown)))
    for i, colour in zip(shown, colours, strict=False):
        h = wall["histories"][i]
        text = "fewer than 3 impacts" if np.isnan(error[i]) else f"misfit {error[i]:.2f}"
        label = f"β = {beta[i]:.2g} ms, {text}"
        right.plot(h["time_s"], h["theta_over_alpha"], c=colour, lw=0.9, label=label)
    right.set(xlabel="time [s]", ylabel="θ/α [-]")
    right.set_title("(b) free rocking", loc="left")
    right.legend(fontsize=6.3)
    facade, r = config["facade"], groups(config)["return_wall_ratio"]
    figure.suptitle(
        f"h = {facade['height_m']:g} m, b = {facade['thickness_m']:g} m, "
        f"E = {facade['e_mpa']:g} MPa, ρ = {facade['density_kg_m3']:g} kg/m³, r = {r:.3g}"
    )
    style.save(figure, job.output)


run(main, globals())
