"""The short climb: where 10 and 50 % of the realisations first collapse, for thousands of curves.

The dense scan finds every range of collapse of a curve; this takes some forty histories at steps
four times as long (`search.crossings`). A separate range further below, narrower than a step of its
climb, may be missed: what that changes is measured in docs/log/assessment.md.
"""

from rocking.collapse.curve import collapse_curve

LONG_STEP = 0.3  # of the stable step
PGA = ("pga_p10_g", "pga_median_g")


def crossings(case, motion, direction, settings=None, step=LONG_STEP):
    """First crossings of a curve of a model of one block, and the histories behind them.

    Parameters
    ----------
    case, motion, direction, settings
        As of `collapse_curve`.
    step : float or None
        Of the stable step; None takes the dense scan's.

    Returns
    -------
    dict
        `PGA` [g], NaN where fewer fall up to max_pga_g, and runs_planar.
    """
    how = {"search": "crossings", "fraction": step}
    found = collapse_curve(case, motion, direction, settings=settings, **how)
    return {**dict(zip(PGA, found.found, strict=True)), "runs_planar": found.runs}
