"""Intensity measures over PGA of the motions of an atlas, at the periods of its façades."""

import numpy as np
import pandas as pd

from rocking.records import G_M_S2, measures
from smdof.spectra import response_spectrum

AVERAGE_S = (0.2, 2.0)  # ends of the average Sa's periods [s], of which level scatters least
POINTS = 10  # of these, evenly in the logarithm


def factors(records, design, damping_ratio=0.05):
    """PGV, average Sa and Sa(T1) of a motion whose PGA is 1 g.

    The average is the geometric mean over `AVERAGE_S` (Eads, Miranda and Lignos, 2015), the same
    for every façade.

    Parameters
    ----------
    records : list of rocking.records.Record
    design : DataFrame
        period_s, by façade.
    damping_ratio : float
        Of Sa.

    Returns
    -------
    dict of str to DataFrame
        By measure: façades (rows), records (columns).
    """
    names, periods = [record.name for record in records], design["period_s"].to_numpy()
    every = np.unique(np.append(periods, np.geomspace(*AVERAGE_S, POINTS)))
    middle = np.searchsorted(every, np.geomspace(*AVERAGE_S, POINTS))
    at = np.searchsorted(every, periods)
    pgv, average, sa = [], [], []
    for record in records:
        peaks = measures(record)
        found = response_spectrum(record.acceleration_m_s2, record.dt_s, every, damping_ratio)
        psa = found.psa_m_s2 / G_M_S2 / peaks["pga_g"]
        sa.append(psa[at])
        average.append(np.full(len(periods), np.exp(np.log(psa[middle]).mean())))
        pgv.append(np.full(len(periods), peaks["pgv_cm_s"] / peaks["pga_g"]))
    return {
        name: pd.DataFrame(np.transpose(values), index=design.index, columns=names)
        for name, values in (
            ("pgv_cm_s", pgv),
            ("sa_avg_g", average),
            ("sa_t1_g", sa),
        )
    }
