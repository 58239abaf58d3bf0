"""Collapse under one record without, with a hundredth of, and with its vertical motion."""

import json

from rocking import Case, Motion
from rocking.records import load_as
from rocking.runtime.script import run
from rocking.studies.vertical import collapse
from rocking.tables import write_table


def main(job):
    p = job.params
    settings = {**json.loads(p.settings), "vertical_motion": "on"}
    motion = Motion(load_as(settings, job.wildcards.record, p.table))
    cases = [Case.read(path) for path in job.input.scenes]
    write_table(collapse(cases, motion, settings["directions"], p.station), job.output[0])


run(main, globals())
