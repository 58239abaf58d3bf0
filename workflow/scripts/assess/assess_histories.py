"""Histories of one model under the motions of the code's dynamic check, and its verdict.

Of the whole façade; with a table of mechanisms, of the parts that are shaken instead.
"""

import json

import pandas as pd
from rocking import Case, Motion
from rocking.assessment.dynamic_check import COLUMNS, checked, limits_of, verdict
from rocking.assessment.family import Family
from rocking.assessment.shaken import cases_of, of_label
from rocking.records import load_as
from rocking.runtime.script import run
from rocking.tables import read_frame, write_table


def main(job):
    case, settings = Case.read(job.input.case), json.loads(job.params.settings)
    assessment = settings["assessment"]
    known = of_label(Family({**case.sections, "assessment": assessment}))
    motions = [
        (Motion(load_as(settings, row.record, job.params.table)), row.pga_g)
        for row in read_frame(job.input.motions).itertuples()
    ]
    parts = cases_of(case, getattr(job.input, "shaken", None)) if motions else {}
    directions, count = settings["directions"], assessment["dynamic_realisations"]
    found, rows = [], []
    for part, own in parts.items():
        limits = limits_of(known[part].mechanism)
        table = checked(own.sections, motions, directions, limits, count)
        found.append(table.assign(part=part))
        said = verdict(table, limits, settings["seed"])
        rows.append({"part": part, "model": case.model, **said})
    write_table(pd.concat(found) if found else [], job.output.histories, ["part", *COLUMNS])
    write_table(rows, job.output.verdict, None if rows else ["part", "model"])


run(main, globals())
