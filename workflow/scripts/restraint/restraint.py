"""Collapse intensities of one curve against a roof's load and friction, and what YADE confirms."""

import json

from rocking import Case, Motion
from rocking.runtime.script import run
from rocking.studies import restraint
from rocking.tables import write_json, write_table


def main(job):
    settings, w = json.loads(job.params.settings)["restraint"], job.wildcards
    case, motion = Case.read(job.input.scene), Motion.read_floors(job.input.motion, w.record)
    found = restraint.table(case, motion, w.direction, settings)
    write_table(found, job.output.table)
    cases = restraint.to_confirm(case, found)
    write_json(job.output.plan, {"ahead": restraint.AHEAD, "cases": cases})


run(main, globals())
