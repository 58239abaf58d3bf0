"""Fragility of every model by every intensity measure, and how efficient the measures are.

Writes tables/fragility.csv, tables/intensity_measures.csv and tables/im_sufficiency.csv (slopes of
the collapse intensity on properties of the motion), and what they rest on:
fragility/brackets.csv (the collapse intervals of the curves, in every measure) and
fragility/curves.csv (fitted probability with its band).
"""

import pandas as pd
from rocking.mechanics.closed_forms import block
from rocking.records import read_csv
from rocking.records.intensity_measures import per_pga, record_measures
from rocking.runtime.script import run
from rocking.studies import fragility_tables, sufficiency
from rocking.tables import write_table


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
    curves = pd.read_csv(job.input.collapse)
    stations = job.params.stations
    slopes = fragility_tables.slopes(curves, factors, properties, settings, stations)
    dense = pd.read_csv(job.input.probability)
    brackets = fragility_tables.brackets(curves, dense, factors, settings["measures"], stations)
    fits, efficiency, fitted = fragility_tables.fits(brackets, settings)
    write_table(slopes, job.output.sufficiency)
    write_table(brackets, job.output.brackets)
    write_table(fits, job.output.fragility, fragility_tables.FITS)
    write_table(efficiency, job.output.measures, fragility_tables.EFFICIENCY)
    write_table(fitted, job.output.curves, fragility_tables.CURVES)


run(main, globals())
