"""Collapse under one motion over the sample of material, for every form of the model."""

import json

from rocking import Case, Motion
from rocking.records import read_csv
from rocking.runtime.script import run
from rocking.tables import write_table
from studies.uncertainty import design, sampling


def main(job):
    p, settings = job.params, json.loads(job.params.settings)
    motion, factors = Motion(read_csv(job.input.record)), sampling.factors(settings)
    rows = []
    for path in job.input.cases:
        cases = design.forms(Case.read(path), settings["bases"], job.input.law)
        for name, case in cases.items():
            rows += design.collapse(name, case, motion, p.direction, factors, settings)
    write_table(rows, job.output[0], design.COLUMNS)


run(main, globals())
