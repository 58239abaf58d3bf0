"""The code's answer for one façade: checks with every number, sensitivity, ties, spectra."""

import json

from rocking import Case
from rocking.assessment import code_tables, shaken, site
from rocking.assessment.code_checks import governing
from rocking.assessment.family import Family
from rocking.records import load_as
from rocking.runtime.script import run
from rocking.tables import write_table


def main(job):
    settings, out = json.loads(job.params.settings), job.output
    records = [load_as(settings, name, job.params.table) for name in job.params.records]
    demand = site.demand_from(settings, records, job.input.spectrum, job.input.hazard)
    every = Family(settings).all()
    ranked = governing(every, settings, demand)
    least = ranked[0][1]
    place = [one.name for one in every].index(least.name), len(every)
    checks, steps, curves = code_tables.checks_of(ranked)
    write_table(checks, out.checks, code_tables.CHECKS)
    write_table(steps, out.steps, code_tables.STEPS)
    write_table(curves, out.curve)
    write_table(code_tables.sensitivity(settings, demand, place), out.sensitivity)
    write_table(code_tables.mechanisms(settings, demand, ranked), out.mechanisms)
    write_table(code_tables.spectra(records, settings, demand, least.place), out.spectra)
    within = settings["assessment"]["shaken_within"]
    parts = shaken.chosen(ranked, [Case.read(path) for path in job.input.cases], within)
    write_table(parts, out.shaken, digits=None)  # heights to the digit


run(main, globals())
