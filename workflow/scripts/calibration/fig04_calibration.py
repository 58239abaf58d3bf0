"""Figure 4: β of the parametric study with their misfit, best fits, and the laws through them."""

import json

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.colors import Normalize
from rocking.calibration import beta as calibration
from rocking.calibration import study
from rocking.calibration.restitution import misfit, read_archive
from rocking.figures import style
from rocking.mechanics import closed_forms
from rocking.runtime.script import run
from rocking.tables import read_json

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7")
RATIO_MARKERS = "v^sDP*X<>"
MS = 1e3  # β is drawn in ms


def panel_runs(axes, cases_path, histories_path, walls, limits):
    """(a) Every β of one batch, coloured by misfit; the best is ringed."""
    cases = [c for c in read_json(cases_path) if c["about"]["role"] == "reference"]
    keep = {c["id"] for c in cases}
    histories = [h for h in read_archive(histories_path) if h["id"] in keep]
    scale = Normalize(0.0, 0.6)
    for wall in study.evaluate(cases, histories):
        facade = wall["case"]["config"]["facade"]
        s = facade["height_m"] / facade["thickness_m"]
        error = misfit(wall["e"] / wall["e_1sr"], 1.0)
        missing = np.isnan(error)
        axes.plot(np.full(missing.sum(), s), wall["beta_s"][missing] * MS, "x", c="0.6", ms=4)
        judged = wall["beta_s"][~missing] * MS
        drawn = axes.scatter(
            np.full(len(judged), s),
            judged,
            c=error[~missing],
            cmap="viridis",
            norm=scale,
            s=16,
            zorder=3,
        )
        row = walls[walls.wall == wall["case"]["id"]].iloc[0]
        axes.plot(s, row.beta_fit_s * MS, "o", mfc="none", mec="#D55E00", ms=8, mew=1.4, zorder=4)
    x, low, high = limits
    axes.plot(x, low * MS, "k:", lw=1, label="two stacked blocks, single block")
    axes.plot(x, high * MS, "k:", lw=1)
    axes.plot([], [], "x", c="0.6", label="fewer than three impacts")
    axes.plot([], [], "o", mfc="none", mec="#D55E00", ms=7, label="best fit")
    axes.set(yscale="log", xlabel="h/b [–]", ylabel="β [ms]")
    axes.legend(loc="upper left", fontsize=6.5)
    axes.yaxis.set_major_formatter("{x:g}")
    axes.set_ylim(None, 120.0)
    plt.colorbar(
        drawn, ax=axes, label="misfit of e$_{exp}$/|e$_{1SR}$| [–]", pad=0.01, extend="max"
    )


def law_curve(law, config, b, slenderness, level=0.9):
    """β of the law and its band along h/b, for a wall like `config` with thickness b."""
    rows = []
    for s in slenderness:
        facade = {**config["facade"], "height_m": s * b}
        rows.append(law.predict(calibration.groups({**config, "facade": facade}), level))
    return np.array(rows).T


def main(job):
    settings = json.loads(job.params.settings)["calibration"]
    walls = pd.read_csv(job.input.walls)
    law = calibration.read_law(job.input.law, settings["base"])
    figure, axes = plt.subplot_mosaic("ab;cc", figsize=(7.4, 6.0))
    x = np.linspace(min(settings["slenderness"]), max(settings["slenderness"]), 60)
    r0 = settings["reference_ratio"]

    first_b, first_e = study.batches(settings)[0]
    ends = []
    for s in x:
        config = study.batch_wall(settings, first_b, first_e, s, r0)
        ends.append((study.two_block_minimum(config), study.single_block_maximum(config)))
    panel_runs(axes["a"], job.input.cases, job.input.histories, walls, (x, *np.array(ends).T))
    axes["a"].set_title(f"(a) b = {first_b:g} m, E = {first_e:g} MPa, r = {r0:g}", loc="left")

    for (b, e_mpa), colour in zip(study.batches(settings), COLOURS, strict=False):
        part = walls[(walls.role == "reference") & (walls.b_m == b) & (walls.e_mpa == e_mpa)]
        part = part.sort_values("slenderness")
        config = study.batch_wall(settings, b, e_mpa, x[0], r0)
        beta, low, high = law_curve(law, config, b, x)
        axes["b"].fill_between(x, low * MS, high * MS, color=colour, alpha=0.13, lw=0)
        axes["b"].plot(x, beta * MS, c=colour)
        printed = np.array([closed_forms.beta_one_sided(b, s * b, e_mpa) for s in x])
        axes["b"].plot(x, printed * MS, "--", c=colour, lw=0.9)
        axes["b"].plot(
            part.slenderness,
            part.beta_fit_s * MS,
            "o",
            c=colour,
            label=f"b = {b:g} m, E = {e_mpa:g} MPa",
        )
    axes["b"].plot([], [], "0.4", label="fitted law, 90 % band")
    axes["b"].plot([], [], "--", c="0.4", lw=0.9, label="eq. 5")
    axes["b"].set(xlabel="h/b [–]", ylabel="best-fitting β [ms]", yscale="log")
    axes["b"].set_title(f"(b) best fits at r = {r0:g}", loc="left")
    axes["b"].set_ylim(0.4 * axes["b"].get_ylim()[0], None)
    axes["b"].set_yticks([0.1, 0.2, 0.5, 1.0, 2.0], ["0.1", "0.2", "0.5", "1", "2"])
    axes["b"].minorticks_off()
    axes["b"].legend(loc="lower right", ncols=2, fontsize=6, columnspacing=0.8, handletextpad=0.3)

    fitted = walls[walls.role.isin(["reference", "ratio"])]
    for ratio, marker in zip(
        sorted(fitted.return_wall_ratio.unique()), RATIO_MARKERS, strict=False
    ):
        for (b, e_mpa), colour in zip(study.batches(settings), COLOURS, strict=False):
            part = fitted[
                (fitted.return_wall_ratio == ratio) & (fitted.b_m == b) & (fitted.e_mpa == e_mpa)
            ]
            axes["c"].plot(
                part.slenderness,
                part.beta_fit_s * part.omega_c_rad_s,
                marker,
                c=colour,
                ms=4.5,
                alpha=0.85,
            )
        axes["c"].plot([], [], marker, c="0.3", label=f"r = {ratio:g}")
    config = study.batch_wall(settings, first_b, first_e, x[0], r0)
    band = law_curve(law, config, first_b, x)
    omega = np.array(
        [
            calibration.groups(study.batch_wall(settings, first_b, first_e, s, r0))["omega_c_rad_s"]
            for s in x
        ]
    )
    axes["c"].fill_between(x, band[1] * omega, band[2] * omega, color="0.5", alpha=0.15, lw=0)
    axes["c"].plot(x, band[0] * omega, "0.3", label=f"fitted law at r = {r0:g}, 90 % band")
    axes["c"].set(xlabel="h/b [–]", ylabel="β·ω$_c$ [–]", ylim=(0.5, 1.45))
    axes["c"].set_title(
        "(c) the same and the other return-wall ratios r, "
        "ω$_c$ = √(j$_{kn}$r/ρb); colours as in (b)",
        loc="left",
    )
    axes["c"].legend(ncols=4)
    style.save(figure, job.output)


run(main, globals())
