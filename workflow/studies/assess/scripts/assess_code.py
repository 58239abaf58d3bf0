"""The code's answer for one façade: checks with every number, sensitivity, ties, spectra."""

import json

from rocking import Case
from rocking.records import load_as
from rocking.runtime.script import run
from rocking.tables import write_table
from studies.assess import code_tables, shaken, site
from studies.assess.anchors import completed_settings
from studies.assess.code_checks import family_of, governing
from studies.assess.sites import site_of


def main(job):
    settings, out = completed_settings(json.loads(job.params.settings)), job.output
    records = [load_as(settings, name, job.params.table) for name in job.params.records]
    demand = site.demand_from(settings, records, job.input.spectrum, job.input.hazard)
    ranked = governing(family_of(settings, demand).all(), settings, demand)
    least = ranked[0][1]
    checks, steps, curves = code_tables.checks_of(ranked)
    write_table(checks, out.checks, code_tables.CHECKS)
    write_table(steps, out.steps, code_tables.STEPS)
    write_table(curves, out.curve)
    write_table(code_tables.sensitivity(settings, demand, site_of(least)), out.sensitivity)
    write_table(code_tables.mechanisms(settings, demand, ranked), out.mechanisms)
    write_table(code_tables.spectra(records, settings, demand, least.place), out.spectra)
    within = settings["assessment"]["shaken_within"]
    assessment = settings["assessment"]
    tried = [shaken.settled(Case.read(path), assessment) for path in job.input.cases]
    parts = shaken.chosen(ranked, tried, demand.pga_g, within)
    write_table(parts, out.shaken, digits=None)  # heights to the digit


run(main, globals())
