"""Collapse under one record without, with a hundredth of, and with its vertical motion."""

import json

from rocking import Case, Motion
from rocking.runtime.script import run
from rocking.studies.vertical import collapse
from rocking.tables import write_table


def main(job):
    p = job.params
    settings = json.loads(p.settings)
    how = {key: settings[key] for key in ("baseline", "seed")}
    motion = Motion.named(job.wildcards.record, p.table, vertical_motion="on", **how)
    cases = [Case.read(path) for path in job.input.scenes]
    write_table(collapse(cases, motion, settings["directions"], p.station), job.output[0])


run(main, globals())
