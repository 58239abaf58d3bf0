"""Collapse intensities of one curve against a roof's load and friction, and what YADE confirms."""

import json
from pathlib import Path

from rocking import Case, Motion
from rocking.runtime.script import run
from rocking.studies import restraint
from rocking.tables import write_table


def main(job):
    settings, w = json.loads(job.params.settings)["restraint"], job.wildcards
    case, motion = Case.read(job.input.scene), Motion.read_floors(job.input.motion)
    found = restraint.table(case, motion, w.direction, settings)
    plan = {"ahead": restraint.AHEAD, "cases": restraint.to_confirm(case, found)}
    for place, name in enumerate(("model", "record", "direction")):
        found.insert(place, name, getattr(w, name))
    write_table(found, job.output.table)
    Path(job.output.plan).write_text(json.dumps(plan, indent=1) + "\n")


run(main, globals())
