"""The short climb: where 10 and 50 % of the realisations first collapse, for thousands of curves.

The dense scan finds every range of collapse of a curve; this takes some forty histories at steps
four times as long (`search.crossings`), few of them where the façade is calm. A separate range
further below, narrower than a step of its climb, may be missed: what that changes is measured in
docs/record.md#assessment.
"""

from rocking.collapse.curve import collapse_curves
from rocking.collapse.probability import outcomes, ranges
from rocking.collapse.search import SPREAD

LONG_STEP = 0.3  # of the stable step
PGA = ("pga_p10_g", "pga_median_g")
ENDS = ("pga_median_low_g", "pga_median_high_g")
RATIO = ("ratio", "ratio_low", "ratio_high")


def crossings(case, motion, direction, settings=None, step=LONG_STEP, ends=False):
    """First crossings of a curve of a model of one block, and the histories behind them.

    `PGA` [g], NaN where fewer fall up to max_pga_g, and runs_planar; with `ends` `ENDS` too,
    between which half collapse may be by its own few realisations, the upper one NaN where they
    leave it open. `step` is over the stable one; None takes the dense scan's. Else as
    `collapse_curve`.
    """
    return crossings_of(case, [(motion, direction)], settings, step, ends)[0]


def crossings_of(case, shaken, settings=None, step=LONG_STEP, ends=False, brief=False):
    """`crossings` under some motions, (Motion, direction) each, as `collapse_curves` has them.

    Histories may be `brief`, see `scan.Screen`.
    """
    how = {"search": "crossings", "settings": settings, "fraction": step, "brief": brief}
    rows = []
    for curve in collapse_curves(case, shaken, **how):
        rows.append({**dict(zip(PGA, curve.found, strict=True)), "runs_planar": curve.runs})
        if ends:
            (at,) = ranges(outcomes(curve.table), SPREAD, levels=(0.5,))
            rows[-1] |= dict(zip(ENDS, at, strict=True))
    return rows


def over_first(table):
    """A table of variants of one curve with RATIO: half collapse over that of the first row.

    And what the scatter of both (`ENDS`) leaves of it; blank where one of the two never falls, or
    where its realisations leave the end open.
    """
    (low, high), half = (table[name] for name in ENDS), table["pga_median_g"]
    ends = (half / half.iloc[0], low / high.iloc[0], high / low.iloc[0])
    return table.assign(**dict(zip(RATIO, ends, strict=True)))
