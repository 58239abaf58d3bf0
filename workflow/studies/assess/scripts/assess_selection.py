"""Natural motions for the code's dynamic check: chosen and scaled to the demand's spectrum."""

import json

import pandas as pd
from rocking.records import load_as, measures
from rocking.runtime.script import run
from rocking.tables import write_table
from studies.assess import selection, site

ABOUT = ["event", "component", "source", "licence"]  # of a motion, where its file or table says it


def about(record):
    """What is known of a motion, by ABOUT; empty where it is not."""
    details = record.details
    event = details.get("about", {}).get("event", "")
    source = details.get("source", "") or details.get("file", "")
    return event, details.get("component", ""), source, details.get("licence", "")


def main(job):
    settings = json.loads(job.params.settings)
    assessment, stations = settings["assessment"], job.params.stations
    records = {name: load_as(settings, name, job.params.table) for name in stations}
    given = settings, list(records.values()), job.input.spectrum, job.input.hazard
    demand = site.demand_from(*given)
    motions = pd.DataFrame(columns=["record", "station", "factor", "pga_g", *ABOUT])
    spectra = pd.DataFrame(columns=["period_s", "target_g", "mean_g"])
    if len(set(stations.values())) >= assessment["motions"]:
        highest_s = selection.longest_period(settings, demand)
        period_s = selection.periods(assessment["match_low_s"], highest_s)
        spectra_g = selection.spectra_of(records.values(), period_s)
        chosen = selection.for_demand(demand, stations, spectra_g, period_s, assessment)
        scaled = list(zip(chosen.names, chosen.factors, strict=True))
        rows = [
            (n, stations[n], f, f * measures(records[n])["pga_g"], *about(records[n]))
            for n, f in scaled
        ]
        motions = pd.DataFrame(rows, columns=motions.columns)
        spectra = pd.DataFrame(
            {"period_s": period_s, "target_g": chosen.target_g, "mean_g": chosen.mean_g}
            | {name: factor * spectra_g[list(stations).index(name)] for name, factor in scaled}
        )
    write_table(motions, job.output.motions)
    write_table(spectra, job.output.spectra)


run(main, globals())
