"""Collapse as a study's module finds it, and what YADE is to confirm of it.

`params.study` names the folder of the study, `params.given` holds what its `collapse` takes
beside case, motion and direction: of one curve, or with the input `cases` of all of them in all
`params.directions`. The motion is that of `input.record`, or the floor motions `input.motion`. A
motion before or beside it, `input.first` or `input.second`, is handed over too; a parameter of the
same name says which record it is of.
"""

from importlib import import_module

from rocking import Case, Motion
from rocking.records import read_csv
from rocking.runtime.script import run
from rocking.tables import write_json, write_table

OTHERS = ("first", "second")


def main(job):
    study = import_module(f"studies.{job.params.study}.study")
    given, w = dict(job.params.get("given", {})), job.wildcards
    if record := job.input.get("record"):
        motion = Motion(read_csv(record))
    else:
        motion = Motion.of_workflow(job.input.motion, w.record)
    for name in OTHERS:
        if path := job.input.get(name):
            given[name] = Motion.of_workflow(path, job.params.get(name))
    if paths := job.input.get("cases"):
        case, direction = [Case.read(path) for path in paths], job.params.directions
    else:
        case, direction = Case.read(job.input.case), w.direction
    table = study.collapse(case, motion, direction, **given)
    write_table(table, job.output.table)
    if plan := job.output.get("plan"):
        write_json(plan, study.to_confirm(case, motion, table, **given))


run(main, globals())
