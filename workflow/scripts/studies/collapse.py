"""Collapse of one curve, as a study's module finds it, and what YADE is to confirm of it.

`params.study` names the module of `rocking.studies`, `params.given` holds what its `collapse` takes
beside case, motion and direction. `input.first`, where there is one, is a motion before the other.
"""

from importlib import import_module

from rocking import Case, Motion
from rocking.runtime.script import run
from rocking.tables import write_json, write_table


def main(job):
    study = import_module(f"rocking.studies.{job.params.study}")
    given, w = dict(job.params.get("given", {})), job.wildcards
    case, motion = Case.read(job.input.scene), Motion.read_floors(job.input.motion, w.record)
    if first := job.input.get("first"):
        given["first"] = Motion.read_floors(first, job.params.first)
    table = study.collapse(case, motion, w.direction, **given)
    write_table(table, job.output.table)
    if plan := job.output.get("plan"):
        write_json(plan, study.to_confirm(case, motion, table, **given))


run(main, globals())
