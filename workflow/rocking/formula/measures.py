"""Intensity measures over PGA of the motions of an atlas, at the periods of its façades."""

import numpy as np
import pandas as pd

from rocking.records import G_M_S2, measures
from smdof.spectra import response_spectrum


def factors(records, design, damping_ratio=0.05):
    """PGV and Sa(T1) of a motion whose PGA is 1 g.

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
    pgv, sa = [], []
    for record in records:
        peaks = measures(record)
        found = response_spectrum(
            record.acceleration_m_s2, record.dt_s, np.unique(periods), damping_ratio
        )
        at = np.searchsorted(np.unique(periods), periods)
        sa.append(found.psa_m_s2[at] / G_M_S2 / peaks["pga_g"])
        pgv.append(np.full(len(periods), peaks["pgv_cm_s"] / peaks["pga_g"]))
    return {
        name: pd.DataFrame(np.transpose(values), index=design.index, columns=names)
        for name, values in (("pgv_cm_s", pgv), ("sa_t1_g", sa))
    }
