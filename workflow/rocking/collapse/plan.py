"""What YADE is to run, once a dense scan has shown where the outcomes change."""

import itertools

import numpy as np

from rocking.collapse.agreement import SHIFT, alternatives, told
from rocking.collapse.crossing import first_crossing
from rocking.collapse.probability import collapse_ranges, from_scan
from yade_scripts.commands import perturb
from yade_scripts.commands.search import DIGITS, climb_sequence

BELOW = 0.97  # of the lowest collapse: the side where nothing falls
SLIGHT = 0.3  # peak d/b up to which the climb is run once: below, both solvers have the same
APART = 1.05  # a level of the climb nearer than this to another run tells nothing of its own
NARROW = 1.03  # p90 over p10 up to which realisations just outside of both say all


def plan(scan, settings, ensemble):
    """Intensities of single runs and of ensembles in YADE [g].

    Single runs: the climb from the last level that stays below `SLIGHT` up to the first crossing of
    50 %, but for levels that another run is next to (`APART`); both sides of the lowest collapse,
    the middle of each range of collapse and of the gap above it, and the amplitude from which all
    collapse. Ensembles: where the probability first crosses the lower percentile, one half and the
    upper one; where these lie together, just below the first and above the last.

    `scan` is the table of a dense one; section ida comes with a number for start_g. Returned are
    runs and levels, ascending; probability, by level and realisation those of
    `agreement.alternatives` at its own amplitude; told, by run those of `agreement.told`.
    """
    spread = ensemble["amplitude_spread"]
    table = from_scan(scan, spread)
    pga_g, share = table["pga_g"].to_numpy(), table["probability"].to_numpy()
    full = settings["confirm"] == "full"
    climb = climb_sequence(settings)
    fallen = scan.loc[scan["status"] == "overturned", "pga_g"]
    slight = scan.loc[~(scan["d_over_b"] < SLIGHT), "pga_g"].min()
    climb = climb[max(0, sum(g < slight for g in climb) - 1) :]
    if fallen.empty:
        runs = climb if full else climb[-1:]
        return {"runs": runs, "told": [None] * len(runs), "levels": [], "probability": []}
    lowest = float(fallen.min())
    low, high = (p / 100.0 for p in ensemble["percentiles"])
    middle = first_crossing(pga_g, share, 0.5)
    runs = [BELOW * lowest, lowest]
    if full:
        gaps = itertools.pairwise(collapse_ranges(pga_g, share))
        for (a, b), (c, _) in itertools.islice(gaps, settings["max_collapse_ranges"]):
            runs += [0.5 * (a + b), 0.5 * (b + c)]
        standing = scan.loc[scan["status"] == "ok", "pga_g"].max()
        runs += [g for g in climb if g > standing][:1]
        near = [(g / APART, g * APART) for g in runs]
        runs += [g for g in climb if not g >= middle and not any(a < g < b for a, b in near)]
    levels = [first_crossing(pga_g, share, level) for level in (low, 0.5, high)]
    levels = [g for g in levels if np.isfinite(g)]
    if len(levels) == 3 and levels[2] <= NARROW * levels[0]:
        beyond = SHIFT**0.25  # a shift by the whole of it shows on either side
        levels = [levels[0] / beyond, levels[2] * beyond]
    if ensemble["enabled"] == "off":
        levels = []
    limit = settings["max_pga_g"]
    runs, levels = (
        sorted({round(float(g), DIGITS) for g in at if g <= limit}) for at in (runs, levels)
    )
    factors = [r.amplitude_factor for r in perturb.draw_realisations(ensemble)]
    shares = [alternatives(scan, np.multiply(g, factors), spread).round(4).tolist() for g in levels]
    alone = told(scan, runs, spread)
    return {"runs": runs, "told": alone, "levels": levels, "probability": shares}
