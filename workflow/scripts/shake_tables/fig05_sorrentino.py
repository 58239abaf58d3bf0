"""Figure 5: free rocking of the Sorrentino wall at several β, and e_exp against the targets."""

import json

import matplotlib.pyplot as plt
import numpy as np
from rocking.calibration import beta as calibration
from rocking.calibration import study
from rocking.calibration.restitution import IMPACTS, TARGETS, misfit, read_archive
from rocking.figures import style
from rocking.mechanics import closed_forms
from rocking.runtime.script import run
from rocking.tables import read_json

MEASURED = {"fmt": "D", "mfc": "white", "mec": "k", "ecolor": "k", "ms": 4, "capsize": 4}
MEASURED |= {"lw": 1.2, "zorder": 5}
SINGLE = (("first", "#0072B2"), ("second", "#009E73"), ("third", "#CC79A7"))


def nearest(wall, beta):
    """Index of the run at the listed β."""
    return int(np.argmin(np.abs(np.log(wall["beta_s"] / beta))))


def main(job):
    settings = json.loads(job.params.settings)["calibration"]
    cases = read_json(job.input.cases)
    walls = study.evaluate(cases, read_archive(job.input.histories))
    wall, others = walls[0], walls[1:]
    facade = wall["case"]["config"]["facade"]
    listed = settings["free_rocking_beta_s"]
    colours = plt.get_cmap("viridis")(np.linspace(0.0, 0.92, len(listed)))
    figure, axes = plt.subplot_mosaic("aa;bc;dd", figsize=(7.4, 7.6))
    end = 0.0
    for beta, colour in zip(listed, colours, strict=True):
        i = nearest(wall, beta)
        history = wall["histories"][i]
        t, theta = history["time_s"], history["theta_over_alpha"]
        for key in "ab":
            axes[key].plot(t, theta, c=colour, lw=1.0, label=f"{beta:g} s")
        found = wall["found"][i]
        if len(found):
            end = max(end, float(found.peak_time_s[:IMPACTS][-1]))
        n = np.arange(1, IMPACTS + 1)
        axes["c"].plot(n, wall["e"][i], "o-", c=colour, lw=0.8)
    measured_rebounds(axes, wall)
    first = float(wall["found"][0].impact_time_s[0])
    axes["a"].legend(title="β", ncols=2)
    axes["a"].set(xlabel="time [s]", ylabel="θ/α [–]", xlim=(0.0, None))
    axes["a"].set_title("(a) complete histories", loc="left")
    axes["b"].set(
        xlabel="time [s]", ylabel="θ/α [–]", xlim=(first - 0.02, 1.05 * end), ylim=(-0.02, 0.2)
    )
    axes["b"].set_title("(b) after the first impact", loc="left")
    for n, (low, high) in enumerate(TARGETS, 1):
        low, high = low * wall["e_1sr"], high * wall["e_1sr"]
        label = "test: 64–72, 74–86, 100 % of |e$_{1SR}$|" if n == 1 else None
        bar = [n - 0.2, n + 0.2], low - 0.004, high + 0.004
        axes["c"].fill_between(*bar, color="#D55E00", alpha=0.45, lw=0, label=label)
    axes["c"].axhline(wall["e_1sr"], c="k", ls=":", label=f"|e$_{{1SR}}$| = {wall['e_1sr']:.3f}")
    axes["c"].set(
        xlabel="impact n", ylabel="e$_{exp}$ [–]", xticks=range(1, IMPACTS + 1), ylim=(0.0, 0.9)
    )
    axes["c"].set_title("(c) restitution, eq. 4 (colours as in a)", loc="left")
    axes["c"].legend(loc="upper right")
    law = calibration.read_law(job.input.law, settings["base"])
    panel_ratio(axes["d"], [wall, *others], facade, law)
    style.save(figure, job.output)


def measured_rebounds(axes, wall):
    """Rebounds θ_n/α that the test's ranges of e_exp mean, at the time of the best run's."""
    error = misfit(wall["e"] / wall["e_1sr"], 1.0)
    best = wall["found"][int(np.nanargmin(error))]
    for n, limits in enumerate(TARGETS, 1):
        restitution = np.array(limits) * wall["e_1sr"]
        low, high = closed_forms.amplitude_after_impacts(best.release, restitution, n)
        label = "test, from e$_{exp}$" if n == 1 else None
        for key in "ab":
            at = best.peak_time_s[n - 1], 0.5 * (low + high), 0.5 * (high - low)
            axes[key].errorbar(*at, label=label, **MEASURED)


def panel_ratio(axes, walls, facade, law):
    """(d) What the unknown widths of wall and return walls change."""
    rows = []
    for wall in walls:
        groups = calibration.groups(wall["case"]["config"])
        fit = study.best_fit(wall["beta_s"], wall["e"] / wall["e_1sr"])
        rows.append((groups["return_wall_ratio"], fit["beta_s"], *fit["single_s"]))
    rows = 1e3 * np.array(sorted(rows))
    r = rows[:, 0] / 1e3
    axes.plot(r, rows[:, 1], "ko-", label="best fit to three impacts")
    for n, (name, colour) in enumerate(SINGLE, 2):
        axes.plot(r, rows[:, n], "s--", c=colour, lw=0.8, label=f"{name} impact alone")
    whole = next(w for w in walls if w["case"]["id"].count(" r") == 0)
    e = whole["e"][:, 0] / whole["e_1sr"]
    x = np.log(whole["beta_s"])
    keep = np.isfinite(e)
    order = np.argsort(-e[keep])
    one = np.exp(np.interp(-1.0, -e[keep][order], x[keep][order]))
    r0 = calibration.groups(whole["case"]["config"])["return_wall_ratio"]
    axes.plot(r0, 1e3 * one, "*", c="#D55E00", ms=9, label="first impact with e = |e$_{1SR}$|")
    grid = np.geomspace(r[0], r[-1], 40)
    config = whole["case"]["config"]
    beta, low, high = 1e3 * law.along(study.at_ratio(config, ratio) for ratio in grid)
    axes.fill_between(grid, low, high, color="0.5", alpha=0.18, lw=0)
    axes.plot(grid, beta, c="0.4", lw=0.9, label="fitted law, 90 % band")
    own = (facade[key] for key in ("thickness_m", "height_m", "e_mpa"))
    printed = closed_forms.beta_one_sided(*own)
    axes.axhline(1e3 * printed, c="k", ls=":", label=f"eq. 5: {1e3 * printed:.3f} ms")
    for beta, text in ((0.25, "first bounce"), (1.0, "second and third")):
        axes.axhline(beta, c="#56B4E9", ls="-.", lw=1.0)
        axes.text(r[0], beta + 0.015, f"the study: {text}", fontsize=6.5)
    axes.set(xscale="log", xlabel="return-wall ratio r = total thickness/width [–]")
    axes.set(ylabel="β [ms]", ylim=(0.0, 1.3), xticks=list(r), xticklabels=[f"{v:g}" for v in r])
    axes.minorticks_off()
    title = "(d) sensitivity to the widths, which are not stated; β of the study's text"
    axes.set_title(title, loc="left")
    axes.legend(ncols=2, fontsize=6.5)


run(main, globals())
