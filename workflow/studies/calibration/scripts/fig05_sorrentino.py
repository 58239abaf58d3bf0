"""Figure 5: free rocking of the Sorrentino wall at several β, and e_exp against the targets."""

import json

import matplotlib.pyplot as plt
import numpy as np
from rocking.figures import style
from rocking.figures.panels import band, intervals, ticks
from rocking.mechanics import beta as calibration
from rocking.runtime.script import run
from studies.calibration import fits
from studies.calibration import free_rocking as study
from studies.shared.restitution import IMPACTS, TARGETS

MEASURED = {"marker": "D", "mfc": "white", "mec": "k", "color": "k", "ms": 4, "capsize": 4}
MEASURED |= {"lw": 1.2, "zorder": 5, "label": "test, from e$_{exp}$"}
RANGE = {"color": "#D55E00", "alpha": 0.45, "lw": 0}
RANGE["label"] = "test: 64–72, 74–86, 100 % of |e$_{1SR}$|"
SINGLE = (("first", "#0072B2"), ("second", "#009E73"), ("third", "#CC79A7"))


def main(job):
    settings = json.loads(job.params.settings)["calibration"]
    walls = fits.walls_of(job.input.cases, job.input.histories)
    wall = walls[0]  # with its width as assumed; the others vary its return walls
    listed = settings["free_rocking_beta_s"]
    colours = plt.get_cmap("viridis")(np.linspace(0.0, 0.92, len(listed)))
    figure, axes = plt.subplot_mosaic("aa;bc;dd", figsize=(7.4, 7.6))
    at, impacts = fits.at_listed(wall, listed), range(1, IMPACTS + 1)
    for i, beta, colour in zip(at, listed, colours, strict=True):
        history = wall["histories"][i]
        for key in "ab":
            line = history["time_s"], history["theta_over_alpha"]
            axes[key].plot(*line, c=colour, lw=1.0, label=f"{beta:g} s")
        axes["c"].plot(impacts, wall["e"][i], "o-", c=colour, lw=0.8)
    time_s, low, high = fits.rebounds_meant(wall)
    for key in "ab":
        intervals(axes[key], time_s, 0.5 * (low + high), low, high, **MEASURED)
    first = float(wall["found"][0].impact_time_s[0])
    end = max((t for i in at for t in wall["found"][i].peak_time_s[:IMPACTS]), default=0.0)
    axes["a"].legend(title="β", ncols=2)
    axes["a"].set(xlabel="time [s]", ylabel="θ/α [-]", xlim=(0.0, None))
    axes["a"].set_title("(a) complete histories", loc="left")
    axes["b"].set(xlabel="time [s]", xlim=(first - 0.02, 1.05 * end))
    axes["b"].set(ylabel="θ/α [-]", ylim=(-0.02, 0.2))
    axes["b"].set_title("(b) after the first impact", loc="left")
    low, high = wall["e_1sr"] * np.array(TARGETS).T
    axes["c"].bar(impacts, high - low + 0.008, 0.4, low - 0.004, **RANGE)
    axes["c"].axhline(wall["e_1sr"], c="k", ls=":", label=f"|e$_{{1SR}}$| = {wall['e_1sr']:.3f}")
    axes["c"].set(xlabel="impact n", xticks=impacts, ylabel="e$_{exp}$ [-]", ylim=(0.0, 0.9))
    axes["c"].set_title("(c) restitution, eq. 4 (colours as in a)", loc="left")
    axes["c"].legend(loc="upper right")
    panel_ratio(axes["d"], walls, calibration.read_law(job.input.law, settings["base"]))
    style.save(figure, job.output)


def panel_ratio(axes, walls, law):
    """(d) What the unknown widths of wall and return walls change."""
    whole, rows = walls[0], fits.by_ratio(walls)
    config, r, rows = whole["case"]["config"], rows[:, 0], 1e3 * rows
    axes.plot(r, rows[:, 1], "ko-", label="best fit to three impacts")
    for n, (name, colour) in enumerate(SINGLE, 2):
        axes.plot(r, rows[:, n], "s--", c=colour, lw=0.8, label=f"{name} impact alone")
    first_s, r0 = fits.beta_of_one_sided(whole), calibration.groups(config)["return_wall_ratio"]
    axes.plot(r0, 1e3 * first_s, "*", c="#D55E00", ms=9, label="first impact with e = |e$_{1SR}$|")
    grid = np.geomspace(r[0], r[-1], 40)
    beta, low, high = 1e3 * law.along(study.at_ratio(config, ratio) for ratio in grid)
    band(axes, grid, beta, low, high, "0.4", lw=0.9, label="fitted law, 90 % band")
    printed = 1e3 * fits.printed(config["facade"])
    axes.axhline(printed, c="k", ls=":", label=f"eq. 5: {printed:.3f} ms")
    for beta, text in ((0.25, "first bounce"), (1.0, "second and third")):
        axes.axhline(beta, c="#56B4E9", ls="-.", lw=1.0)
        axes.text(r[0], beta + 0.015, f"the study: {text}", fontsize=6.5)
    axes.set(xscale="log", xlabel="return-wall ratio r = total thickness/width [-]")
    axes.set(ylabel="β [ms]", ylim=(0.0, 1.3))
    ticks(axes.xaxis, r)
    title = "(d) sensitivity to the widths, which are not stated; β of the study's text"
    axes.set_title(title, loc="left")
    axes.legend(ncols=2, fontsize=6.5)


run(main, globals())
