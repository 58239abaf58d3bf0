"""PGA of 10 and 50 % collapse of one model under the motions of the run, by the planar solver.

Of the whole façade; with a table of mechanisms, of the parts that are shaken instead.
"""

import json
from functools import partial

import pandas as pd
from rocking import Case, Motion, Variant
from rocking.assessment.shaken import WHOLE_PART, cases
from rocking.collapse.quick import crossings
from rocking.collapse.varied import collapses
from rocking.records import load_as, measures
from rocking.runtime.script import run
from rocking.tables import write_table

COLUMNS = ["model", "record", "direction", "record_pga_g", "pga_p10_g", "pga_median_g"]
COLUMNS += ["pga_max_g", "runs_planar"]


def main(job):
    case, settings = Case.read(job.input.case), json.loads(job.params.settings)
    known, columns = [(WHOLE_PART, case)], COLUMNS
    if shaken := getattr(job.input, "shaken", None):
        table, columns = pd.read_csv(shaken), ["part", *COLUMNS]
        known = [(row.part, own) for row, own in cases(case, table, whole=False)]
    most = settings["ida.max_pga_g"]
    find = partial(crossings, settings={"max_pga_g": most})
    rows = []
    for name, direction in job.params.curves:
        motion = Motion(load_as(settings, name, job.params.table))
        given = {"record_pga_g": measures(motion.record)["pga_g"], "pga_max_g": most}
        for part, own in known:
            about = Variant(about={"part": part, **given})
            rows += collapses([own], motion, [direction], find, [about])
    write_table(rows, job.output[0], columns)


run(main, globals())
