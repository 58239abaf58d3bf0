"""Perturbed ensembles: every realisation of a curve, and the share that collapses, in one panel.

What stood lies at its d/b, what fell at 1. The collapse probability runs over the same unit scale:
that of the dense scan, and YADE's share at each level.
"""

from rocking.collapse.ida import by_curve
from rocking.collapse.probability import first_crossing, from_scan
from rocking.figures import style
from rocking.figures.panels import common_legend, panels
from rocking.runtime.script import run
from studies.accuracy.ensemble import bands

from yade_scripts.model.registry import MODELS

COLUMNS = 4  # panels side by side
LEAST_IN = 4.0  # width of the figure
AROUND = (0.9, 1.1)  # of the levels, as factors
SHARE_OF = 3  # realisations at one level that have a share


def main(job):
    tables, scans = by_curve(job.input.ensembles), by_curve(job.input.scans)
    figure, axes = panels(len(tables), COLUMNS, (2.3, 2.1), around=(0.0, 0.5), sharey=True)
    figure.set_figwidth(max(LEAST_IN, figure.get_figwidth()))
    for axis, (key, table) in zip(axes.flat, tables.items(), strict=False):
        draw(axis, table, from_scan(scans[key], job.params.spread), job.params.percentiles)
        axis.set_title(f"{key[0]} {key[1]} {style.SIGNS[key[2]]}", fontsize=8)
    if not tables:
        axes[0, 0].set_title("every history repeats: no ensemble was needed")
    common_legend(figure, loc="outside upper center", ncols=6)
    axes[0, 0].set(ylim=(-0.03, 1.06))
    figure.supxlabel("PGA [g]", fontsize=8)
    figure.supylabel("peak d/b; collapse probability [-]", fontsize=8)
    style.save(figure, job.output, job.input.facts)


def draw(axis, table, scan, percentiles):
    """One curve: its realisations, its shares, and the scan's probability near them."""
    colour = MODELS[table["model"].iloc[0]].colour
    levels = bands(table, percentiles)
    low, high = AROUND[0] * levels["pga_g"].min(), AROUND[1] * levels["pga_g"].max()
    stood, fell = (table[table["status"] == status] for status in ("ok", "overturned"))
    known = scan[scan["pga_g"].between(low, high)]
    axis.plot(known["pga_g"], known["probability"], color="0.3", lw=1.0, label="P, dense scan")
    axis.vlines(
        levels["pga_g"],
        levels["d_over_b_low"],
        levels["d_over_b_high"],
        color=colour,
        alpha=0.25,
        lw=5,
        label="d/b, {:g}–{:g} %".format(*percentiles),
    )
    axis.plot(stood["pga_g"], stood["d_over_b"], ".", color=colour, ms=4, label="d/b, stood")
    axis.plot(fell["pga_g"], [1.0] * len(fell), "o", color=colour, mfc="none", ms=4, label="fell")
    shares = levels[levels["realisations"] >= SHARE_OF]
    axis.plot(shares["pga_g"], shares["probability"], "kx", ms=5, label="P, YADE's share")
    half = first_crossing(known["pga_g"].to_numpy(), known["probability"].to_numpy(), 0.5)
    axis.axvline(half, color="0.4", lw=0.8, ls=":", label="first reaches ½")
    axis.set_xlim(low, high)


run(main, globals())
