"""Histories of one model under the motions of the code's dynamic check, and its verdict.

Of the whole façade; with a table of mechanisms, of the parts that are shaken instead.
"""

import json

import pandas as pd
from rocking import Case, Motion
from rocking.assessment.dynamic_check import COLUMNS, checked, limits_of, verdict
from rocking.assessment.family import Family
from rocking.assessment.shaken import WHOLE_PART, cases, of_label
from rocking.records import load_as
from rocking.runtime.script import run
from rocking.tables import write_table


def main(job):
    case, settings = Case.read(job.input.case), json.loads(job.params.settings)
    motions = pd.read_csv(job.input.motions)
    parts = [(WHOLE_PART, case)]
    if shaken := getattr(job.input, "shaken", None):
        parts = [(row.part, own) for row, own in cases(case, pd.read_csv(shaken), whole=False)]
    assessment = settings["assessment"]
    known = of_label(Family({**case.sections, "assessment": assessment}))
    known_motions = {
        name: Motion(load_as(settings, name, job.params.table)) for name in motions["record"]
    }
    found, rows = [], []
    given = [(known_motions[row.record], row.pga_g) for row in motions.itertuples()]
    for part, own in parts if given else ():
        limits = limits_of(known[part].mechanism)
        directions, count = settings["directions"], assessment["dynamic_realisations"]
        table = checked(own.sections, given, directions, limits, count)
        found.append(table.assign(part=part))
        said = verdict(table, limits, settings["seed"])
        rows.append({"part": part, "model": case.model, **said})
    write_table(pd.concat(found) if found else [], job.output.histories, ["part", *COLUMNS])
    write_table(rows, job.output.verdict, None if rows else ["part", "model"])


run(main, globals())
