"""What friction is worth: collapse PGA by the friction angle of the façade's joints."""

import pandas as pd
from rocking.collapse.case import Variant
from rocking.collapse.ratios import spread
from rocking.collapse.varied import collapses

SPREAD = {"n": "n", "n_censored": "n_censored", "median": 50, "least": 0, "most": 100}


def variants(settings):
    """One façade an angle; the first is what the others are compared with.

    Parameters
    ----------
    settings : dict
        Section friction: angles_deg.
    """
    return [
        Variant(f"{angle:g}°", {"facade.friction_deg": angle}, about={"friction_deg": angle})
        for angle in settings["angles_deg"]
    ]


def collapse(case, motion, direction, settings):
    """Where 10 and 50 % of the realisations first collapse, by friction angle.

    Returns
    -------
    DataFrame
        model, record, direction, friction_deg, pga_p10_g, pga_median_g, runs_planar; ratio of
        pga_median_g to that of the first angle, blank where one of the two never collapsed.
    """
    rows = collapses([case], motion, [direction], variants=variants(settings))
    table = pd.DataFrame(rows)
    return table.assign(ratio=table["pga_median_g"] / table["pga_median_g"].iloc[0])


def summary(table):
    """Spread of the ratios by model and angle."""
    return spread(table, ["model", "friction_deg"], SPREAD)
