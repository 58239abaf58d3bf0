"""PGA of 10 and 50 % collapse of one model under the motions of the run, by the planar solver.

Of the whole façade; with a table of mechanisms, of the parts that are shaken instead.
"""

import json

import pandas as pd
from rocking import Case, Motion
from rocking.assessment.shaken import WHOLE_PART, cases
from rocking.collapse.quick import crossings_of
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
    motions = {
        name: Motion(load_as(settings, name, job.params.table)) for name, _ in job.params.curves
    }
    shaken = [(motions[name], direction) for name, direction in job.params.curves]
    found = {part: crossings_of(own, shaken, {"max_pga_g": most}) for part, own in known}
    rows = []
    for k, (motion, direction) in enumerate(shaken):
        about = {"model": case.model, "record": motion.name, "direction": direction}
        about |= {"record_pga_g": measures(motion.record)["pga_g"], "pga_max_g": most}
        rows += [{"part": part, **about, **own[k]} for part, own in found.items()]
    write_table(rows, job.output[0], columns)


run(main, globals())
