"""Intensity measures over PGA of the motions of an atlas, at the periods of its façades."""

import numpy as np
import pandas as pd
from rocking.records import G_M_S2, measures

from smdof.spectra import response_spectrum

AVERAGE_S = (0.2, 2.0)  # ends of the average Sa's periods [s], of which level scatters least
POINTS = 10  # of these, evenly in the logarithm
AT_T1 = 0.3  # share of Sa(T1) in the logarithm, before walls that follow the building


def factors(records, design, damping_ratio=0.05):
    """PGV, average Sa, Sa(T1) and a mean of the last two, of a motion whose PGA is 1 g.

    The average is the geometric mean over `AVERAGE_S` (Eads, Miranda and Lignos, 2015), the same
    for every façade. What overturns a façade before walls that follow the building has two parts:
    what the ground has at the façade's own long periods, and what the building makes of T1. Hence
    Sa_avg^(1 − a) Sa(T1)^a with a = `AT_T1`. By measure a table of façades (rows, period_s of the
    design) and records (columns).
    """
    names, periods = [record.name for record in records], design["period_s"].to_numpy()
    every = np.unique(np.append(periods, np.geomspace(*AVERAGE_S, POINTS)))
    middle = np.searchsorted(every, np.geomspace(*AVERAGE_S, POINTS))
    at = np.searchsorted(every, periods)
    pgv, average, sa, both = [], [], [], []
    for record in records:
        peaks = measures(record)
        spectrum = response_spectrum(record.acceleration_m_s2, record.dt_s, every, damping_ratio)
        psa = spectrum.psa_m_s2 / G_M_S2 / peaks["pga_g"]
        sa.append(psa[at])
        average.append(np.full(len(periods), np.exp(np.log(psa[middle]).mean())))
        both.append(average[-1] ** (1.0 - AT_T1) * sa[-1] ** AT_T1)
        pgv.append(np.full(len(periods), peaks["pgv_cm_s"] / peaks["pga_g"]))
    return {
        name: pd.DataFrame(np.transpose(values), index=design.index, columns=names)
        for name, values in (
            ("pgv_cm_s", pgv),
            ("sa_avg_2s_g", average),
            ("sa_t1_g", sa),
            ("sa_avg_2s_t1_g", both),
        )
    }
