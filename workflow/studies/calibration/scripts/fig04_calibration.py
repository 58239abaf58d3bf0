"""Figure 4: β of the parametric study with their misfit, best fits, and the laws through them."""

import json

import matplotlib.pyplot as plt
from matplotlib.colors import Normalize
from rocking.figures import style
from rocking.figures.panels import band, ticks
from rocking.mechanics import beta as calibration
from rocking.runtime.script import run
from rocking.tables import read_frame
from studies.calibration import fits
from studies.calibration import free_rocking as study

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7")
RATIO_MARKERS = "v^sDP*X<>"
MS = 1e3  # β is drawn in ms
FEWER = "fewer than three impacts"
TITLE_C = (
    "(c) the same and the other return-wall ratios r, ω$_c$ = √(j$_{kn}$r/ρb); colours as in (b)"
)


def of_batch(table, b, e_mpa):
    """Rows of the walls of one thickness and stiffness."""
    return table[(table.b_m == b) & (table.e_mpa == e_mpa)]


def panel_runs(axes, runs, best, limits):
    """(a) Every β of one batch, coloured by misfit; the best is ringed."""
    judged, missing = runs[runs.misfit.notna()], runs[runs.misfit.isna()]
    axes.plot(missing.slenderness, missing.beta_s * MS, "x", c="0.6", ms=4, label=FEWER)
    colours = {"c": judged.misfit, "cmap": "viridis", "norm": Normalize(0.0, 0.6)}
    drawn = axes.scatter(judged.slenderness, judged.beta_s * MS, **colours, s=16, zorder=3)
    ring = {"mfc": "none", "mec": "#D55E00", "ms": 8, "mew": 1.4, "zorder": 4, "label": "best fit"}
    axes.plot(best.slenderness, best.beta_fit_s * MS, "o", **ring)
    x, low, high = limits
    axes.plot(x, low * MS, "k:", lw=1, label="two stacked blocks, single block")
    axes.plot(x, high * MS, "k:", lw=1)
    axes.set(yscale="log", xlabel="h/b [-]", ylabel="β [ms]")
    axes.legend(loc="upper left", fontsize=6.5)
    axes.yaxis.set_major_formatter("{x:g}")
    axes.set_ylim(None, 120.0)
    label = "misfit of e$_{exp}$/|e$_{1SR}$| [-]"
    plt.colorbar(drawn, ax=axes, label=label, pad=0.01, extend="max")


def main(job):
    settings = json.loads(job.params.settings)["calibration"]
    walls = read_frame(job.input.walls)
    law = calibration.read_law(job.input.law, settings["base"])
    figure, axes = plt.subplot_mosaic("ab;cc", figsize=(7.4, 6.0))
    figure.get_layout_engine().set(wspace=0.06)
    r0, curves = settings["reference_ratio"], fits.along_slenderness(settings, law)
    reference = walls[walls.role == "reference"].sort_values("slenderness")
    batches = study.batches(settings)
    (b, e_mpa), first = batches[0], of_batch(curves, *batches[0])
    ends = fits.study_range(settings, b, e_mpa, first.slenderness)
    runs = fits.misfits(fits.walls_of(job.input.cases, job.input.histories, "reference"))
    panel_runs(axes["a"], runs, of_batch(reference, b, e_mpa), (first.slenderness, *ends))
    axes["a"].set_title(f"(a) b = {b:g} m, E = {e_mpa:g} MPa, r = {r0:g}", loc="left")

    for (b, e_mpa), colour in zip(batches, COLOURS, strict=False):
        part, curve = of_batch(reference, b, e_mpa), of_batch(curves, b, e_mpa)
        law_ms = (curve[name] * MS for name in ("beta_s", "low_s", "high_s"))
        band(axes["b"], curve.slenderness, *law_ms, colour, alpha=0.13)
        axes["b"].plot(curve.slenderness, curve.eq5_s * MS, "--", c=colour, lw=0.9)
        label = f"b = {b:g} m, E = {e_mpa:g} MPa"
        axes["b"].plot(part.slenderness, part.beta_fit_s * MS, "o", c=colour, label=label)
    axes["b"].plot([], [], "0.4", label="fitted law, 90 % band")
    axes["b"].plot([], [], "--", c="0.4", lw=0.9, label="eq. 5")
    axes["b"].set(xlabel="h/b [-]", ylabel="best-fitting β [ms]", yscale="log")
    axes["b"].set_title(f"(b) best fits at r = {r0:g}", loc="left")
    axes["b"].set_ylim(0.4 * axes["b"].get_ylim()[0], None)
    ticks(axes["b"].yaxis, (0.1, 0.2, 0.5, 1.0, 2.0))
    axes["b"].legend(loc="lower right", ncols=2, fontsize=6, columnspacing=0.8, handletextpad=0.3)

    fitted = walls[walls.role.isin(["reference", "ratio"])]
    by_ratio = fitted.groupby("return_wall_ratio")
    for (ratio, of_ratio), marker in zip(by_ratio, RATIO_MARKERS, strict=False):
        for (b, e_mpa), colour in zip(batches, COLOURS, strict=False):
            part = of_batch(of_ratio, b, e_mpa)
            scaled = part.beta_fit_s * part.omega_c_rad_s
            axes["c"].plot(part.slenderness, scaled, marker, c=colour, ms=4.5, alpha=0.85)
        axes["c"].plot([], [], marker, c="0.3", label=f"r = {ratio:g}")
    law_omega = (first[name] * first.omega_c_rad_s for name in ("beta_s", "low_s", "high_s"))
    label = f"fitted law at r = {r0:g}, 90 % band"
    band(axes["c"], first.slenderness, *law_omega, "0.3", label=label)
    axes["c"].set(xlabel="h/b [-]", ylabel="β·ω$_c$ [-]", ylim=(0.5, 1.45))
    axes["c"].set_title(TITLE_C, loc="left")
    axes["c"].legend(ncols=4)
    style.save(figure, job.output)


run(main, globals())
