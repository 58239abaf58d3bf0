"""Natural motions for the code's dynamic check: chosen and scaled to the demand's spectrum."""

import json

import numpy as np
import pandas as pd
from rocking.assessment import selection, site
from rocking.assessment.code_checks import code_checks, mechanism_of
from rocking.records import G_M_S2, load
from rocking.runtime.script import run
from rocking.tables import write_table

from smdof.spectra import response_spectrum

SHORTEST_HIGH_S, LONGEST_HIGH_S = 2.0, 4.0  # of what stands for match_high_s


def longest_period(settings, demand):
    """Period up to which the motions are to fit: T_SLC of the whole façade, within bounds."""
    own = settings["assessment"]
    if own["match_high_s"] is not None:
        return own["match_high_s"]
    whole = mechanism_of(settings["facade"], settings["return_wall"], own)
    found = code_checks(whole, settings["facade"], settings["smdof"], own, demand)
    slc = next(v for s, _, v, _ in found["slc_height"].steps if s == "T_SLC")
    return float(np.clip(slc, SHORTEST_HIGH_S, LONGEST_HIGH_S))


def main(job):
    settings = json.loads(job.params.settings)
    own, stations = settings["assessment"], job.params.stations
    how = {"baseline": settings["baseline"], "seed": settings["seed"]}
    records = [load(name, job.params.table, **how) for name in stations]
    demand = site.demand_from(settings, records, job.input.spectrum, job.input.hazard)
    motions = pd.DataFrame(columns=["record", "station", "factor", "pga_g"])
    spectra = pd.DataFrame(columns=["period_s", "target_g", "mean_g"])
    if len(set(stations.values())) >= own["motions"]:
        period_s = selection.periods(own["match_low_s"], longest_period(settings, demand))
        found = []
        for record in records:
            one = response_spectrum(record.acceleration_m_s2, record.dt_s, period_s, 0.05)
            found.append(one.psa_m_s2 / G_M_S2)
        target = np.array([demand.acceleration(t) for t in period_s])
        chosen = selection.choose(
            list(stations),
            list(stations.values()),
            np.array(found),
            period_s,
            target,
            own["motions"],
            own["motion_factors"],
        )
        peak = {r.name: np.abs(r.acceleration_m_s2).max() / G_M_S2 for r in records}
        motions = pd.DataFrame(
            {
                "record": chosen.names,
                "station": [stations[name] for name in chosen.names],
                "factor": chosen.factors,
                "pga_g": [f * peak[n] for f, n in zip(chosen.factors, chosen.names, strict=True)],
            }
        )
        spectra = pd.DataFrame(
            {"period_s": period_s, "target_g": chosen.target_g, "mean_g": chosen.mean_g}
        )
        for name, factor in zip(chosen.names, chosen.factors, strict=True):
            spectra[name] = factor * found[list(stations).index(name)]
    write_table(motions, job.output.motions)
    write_table(spectra, job.output.spectra)


run(main, globals())
