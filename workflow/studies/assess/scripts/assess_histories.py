"""Histories of one model under the motions of the code's dynamic check, and its verdict.

Of the whole façade, or of the other parts that are shaken.
"""

import json

import pandas as pd
from rocking import Case, Motion
from rocking.records import load_as
from rocking.runtime.script import run
from rocking.tables import read_frame, write_table
from studies.assess.dynamic_check import COLUMNS, checked, verdict
from studies.assess.shaken import cases, limits_by_part, settled
from studies.assess.sites import WHOLE_PART


def main(job):
    settings = json.loads(job.params.settings)
    assessment, table = settings["assessment"], read_frame(job.input.shaken)
    case, known = Case.read(job.input.case), limits_by_part(table)
    case = settled(case, assessment)
    motions = [
        (Motion(load_as(settings, row.record, job.params.table)), row.pga_g)
        for row in read_frame(job.input.motions).itertuples()
    ]
    directions, count = settings["directions"], assessment["dynamic_realisations"]
    tables, rows = [], []
    for row, part_case in cases(case, table) if motions else ():
        if (row.part == WHOLE_PART) is not job.params.whole:
            continue
        limits = known[row.part]
        histories = checked(part_case.sections, motions, directions, limits, count)
        tables.append(histories.assign(part=row.part))
        said = verdict(histories, limits, settings["seed"])
        rows.append({"part": row.part, "model": case.model, **said})
    write_table(pd.concat(tables) if tables else [], job.output.histories, ["part", *COLUMNS])
    write_table(rows, job.output.verdict, None if rows else ["part", "model"])


run(main, globals())
