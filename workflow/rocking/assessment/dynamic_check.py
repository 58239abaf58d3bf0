"""The Circolare's check by non-linear dynamic analysis, C8.7.1.2.1.9.

SLV and SLC are fulfilled if no analysis exceeds d0 and the mean of the largest displacements does
not exceed d_SLV (d_SLC), with d0, d_SLV and d_SLC those of the capacity curve. The motions are
those of `selection`; the model follows the façade block by block. Displacements are those of the
top relative to the base, and so are the limits; d/b is cut off at 1, where a façade has fallen.

Near collapse a history turns on its last digits. So every motion is run as realisations too, which
differ in amplitude, node layout and step, and the verdict is drawn over and over with one
realisation of each motion.
"""

from typing import NamedTuple

import numpy as np
import pandas as pd

from rocking.collapse.case import Case
from rocking.collapse.curve import run_by
from rocking.collapse.motion import Motion
from yade_scripts.model.shape import shape_of

DRAWS = 2000
COLUMNS = ["model", "record", "direction", "realisation", "pga_g", "d_over_b", "d_m", "status"]


class Limits(NamedTuple):
    """Displacements of the top [m] at which α vanishes, of SLV and of SLC."""

    d0_m: float
    slv_m: float
    slc_m: float


def limits_of(mechanism):
    """`Limits` of a mechanism whose control point is the façade's top."""
    d0 = mechanism.ultimate()[1]
    return Limits(d0, mechanism.limit(0.4)[0], 0.6 * d0)


def width_of(facade):
    """b of d/b [m]."""
    return shape_of(facade).overturning_m


def histories(job, record, direction, pga_g, realisations, fraction=None):
    """Largest displacements of one model under one motion at some intensities.

    Parameters
    ----------
    job : dict
        A scene file.
    record : rocking.records.Record
    direction : str
    pga_g : sequence of float
    realisations : int
        Perturbed ones beside the first, within ± `ensemble.amplitude_spread`.
    fraction : float or None
        Of the stable step; None takes the dense scan's.

    Returns
    -------
    DataFrame
        See COLUMNS; realisation 0 is the one as it is.
    """
    screen = run_by("planar", Case(job), Motion(record), direction, fraction=fraction)
    spread, b = job["ensemble"]["amplitude_spread"], width_of(job["facade"])
    parts = []
    for level in pga_g:
        own = screen.run([level], scatter=False)
        if realisations:
            factors = np.linspace(1.0 - spread, 1.0 + spread, realisations)
            own = pd.concat([own, screen.run(level * factors, scatter=True)], ignore_index=True)
        own["realisation"] = np.arange(len(own))
        own["pga_g"] = level
        parts.append(own)
    found = pd.concat(parts, ignore_index=True)
    found["model"], found["record"], found["direction"] = job["model"], record.name, direction
    found["d_m"] = b * found["d_over_b"]
    return found[COLUMNS]


def exceeds(table, limits):
    """Whether each history exceeds d0."""
    return ((table["status"] == "overturned") | (table["d_m"] > limits.d0_m)).to_numpy()


def verdict(table, limits, seed):
    """The code's verdict on one model, and how far it hangs on the numerics.

    Parameters
    ----------
    table : DataFrame
        Histories of one model at one intensity; failed ones are left out and counted.
    limits : Limits
    seed : int
        Of the draws of one realisation a motion.

    Returns
    -------
    dict
        motions, exceed_d0, mean_d_m, d0_m, d_slv_m, d_slc_m, slv, slc (fulfilled or not), agree
        (share of draws with the same verdict on SLV), failed, worst, nearest (motions).
    """
    failed = table["status"] == "failed"
    kept = table[~failed].copy()
    kept["over"] = exceeds(kept, limits)
    first = kept[kept["realisation"] == 0]
    mean, over = float(first["d_m"].mean()), int(first["over"].sum())
    slv = over == 0 and mean <= limits.slv_m
    rng = np.random.default_rng(seed)
    d, out = np.zeros(DRAWS), np.zeros(DRAWS, bool)
    groups = list(kept.groupby(["record", "direction"], sort=True))
    for _, part in groups:
        pick = rng.integers(0, len(part), DRAWS)
        d += part["d_m"].to_numpy()[pick]
        out |= part["over"].to_numpy()[pick]
    held = ~out & (d / max(len(groups), 1) <= limits.slv_m)
    worst = first.sort_values(["d_m", "record"]).iloc[-1]
    nearest = first.iloc[(first["d_m"] - limits.slv_m).abs().argmin()]
    return {
        "motions": len(first),
        "exceed_d0": over,
        "mean_d_m": mean,
        "d0_m": limits.d0_m,
        "d_slv_m": limits.slv_m,
        "d_slc_m": limits.slc_m,
        "slv": bool(slv),
        "slc": bool(over == 0 and mean <= limits.slc_m),
        "agree": float(np.mean(held == slv)),
        "failed": int(failed.sum()),
        "worst": worst["record"],
        "worst_d_m": worst["d_m"],
        "nearest": nearest["record"],
        "nearest_d_m": nearest["d_m"],
    }
