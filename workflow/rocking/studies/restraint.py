"""What a roof's load and friction are worth: collapse intensities by the planar solver."""

import pandas as pd

from rocking.collapse.scan import Screen
from rocking.configuration import schema

BELOW, ABOVE = 0.95, 1.05  # of the 10 and 90 % intensities: where few and most should fall
FLOOR = schema.whole()["properties"]["facade"]["properties"]["floors"]["items"]
INTENSITIES = tuple(f"pga_{name}_g" for name in ("collapse", "p10", "median", "p90", "max"))


def held(job, load_kn, friction):
    """Scene file or configuration of a façade with one more floor on its top; none without load."""
    if load_kn == 0.0:
        return job
    facade = job["facade"]
    row = {"height_m": facade["height_m"], "load_kn": load_kn, "friction": friction}
    floors = [*facade["floors"], schema.complete(row, FLOOR)]
    return {**job, "facade": {**facade, "floors": floors}}


def table(job, time_s, columns, direction, settings, scan_settings):
    """Collapse intensities by load and friction, those without a load first.

    Parameters
    ----------
    job : dict
        A scene file of a model with a planar twin.
    time_s, columns, direction
        See `Screen`.
    settings : dict
        Section restraint: loads_kn, frictions.
    scan_settings : dict
        As `Screen.scan` takes.

    Returns
    -------
    DataFrame
        load_kn, friction, capacity_kn (μ P), then `INTENSITIES`.
    """
    pairs = [(0.0, 0.0), *((p, mu) for p in settings["loads_kn"] for mu in settings["frictions"])]
    rows = []
    for load, friction in pairs:
        screen = Screen(held(job, load, friction), time_s, columns, direction)
        found = screen.intensities(scan_settings)
        rows.append((load, friction, load * friction, *(found[name] for name in INTENSITIES)))
    return pd.DataFrame(rows, columns=["load_kn", "friction", "capacity_kn", *INTENSITIES])


def to_confirm(job, found):
    """Cases for YADE: the largest load with least and most friction, below and above collapse.

    Parameters
    ----------
    job : dict
    found : DataFrame
        Of `table`.

    Returns
    -------
    list of dict
        height_m, force_kn (μ P), pga_g and the section facade; none beyond what was scanned.
    """
    most = found[found["load_kn"] == found["load_kn"].max()]
    return [
        {
            "height_m": job["facade"]["height_m"],
            "force_kn": round(row.capacity_kn, 6),
            "pga_g": round(pga_g, 4),
            "facade": held(job, row.load_kn, row.friction)["facade"],
        }
        for row in most.iloc[[0, -1]].itertuples()
        for pga_g in (BELOW * row.pga_p10_g, ABOVE * row.pga_p90_g)
        if pga_g <= row.pga_max_g
    ]
