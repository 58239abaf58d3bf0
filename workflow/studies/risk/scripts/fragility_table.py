"""Fragility of every model by every intensity measure, and how efficient the measures are.

Writes tables/fragility.csv, tables/intensity_measures.csv and tables/im_sufficiency.csv (slopes of
the collapse intensity on properties of the motion), and what they rest on:
fragility/brackets.csv (the collapse intervals of the curves, in every measure),
fragility/curves.csv (fitted probability with its band, and the share that falls there) and
fragility/factors.csv (every measure over PGA, by record).
"""

import pandas as pd
from rocking.mechanics.closed_forms import block
from rocking.records import read_csv
from rocking.records.intensity_measures import per_pga, record_measures
from rocking.runtime.script import run
from rocking.tables import read_frame, write_table
from studies.risk import fragility_tables
from studies.risk.fragility_tables import CURVES, FACTORS, share_at, shares
from studies.shared import sufficiency


def main(job):
    settings, facade, chain = job.params.fragility, job.params.facade, job.params.smdof
    p_rad_s = block(facade["height_m"], facade["thickness_m"]).p_rad_s
    records = [read_csv(path) for path in job.input.records]
    properties = {record.name: sufficiency.properties(record) for record in records}
    factors = {
        record.name: per_pga(
            record_measures(record, chain["period_s"], chain["damping_ratio"], p_rad_s)
        )
        for record in records
    }
    curves = read_frame(job.input.collapse)
    stations = job.params.stations
    slopes = fragility_tables.slopes(curves, factors, properties, settings, stations)
    dense = read_frame(job.input.probability)
    names = settings["measures"]
    brackets = fragility_tables.brackets(
        curves, dense, factors, names, stations, job.params.hazard_slope
    )
    fits, efficiency, fitted = fragility_tables.fits(brackets, settings)
    known = [
        (r, stations[r], im, by_measure[im]) for r, by_measure in factors.items() for im in names
    ]
    write_table(slopes, job.output.sufficiency)
    write_table(brackets, job.output.brackets)
    write_table(fits, job.output.fragility, fragility_tables.FITS)
    write_table(efficiency, job.output.measures, fragility_tables.EFFICIENCY)
    write_table(with_shares(fitted, curves, dense, factors), job.output.curves, CURVES)
    write_table(known, job.output.factors, FACTORS)


def with_shares(fitted, curves, dense, factors):
    """Rows of fitted curves with the share that falls there, as it is."""
    table = pd.DataFrame(fitted, columns=CURVES[:-1])
    parts = []
    for (model, im), part in table.groupby(["model", "im"], sort=False):
        per_pga = {record: by_measure[im] for record, by_measure in factors.items()}
        mine = shares(curves[curves["model"] == model], dense, per_pga)
        parts.append(part.assign(share=share_at(mine.values(), part["intensity"])))
    return pd.concat(parts) if parts else table.assign(share=None)


run(main, globals())
