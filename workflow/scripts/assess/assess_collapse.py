"""PGA of 10 and 50 % collapse of one model under the motions of the run, by the planar solver.

Of the whole façade; with a table of mechanisms, of the parts that are shaken instead.
"""

import json

from rocking import Case, Motion
from rocking.assessment.shaken import cases_of
from rocking.collapse.quick import crossings_of
from rocking.records import load_as, measures
from rocking.runtime.script import run
from rocking.tables import write_table

COLUMNS = ["model", "record", "direction", "record_pga_g", "pga_p10_g", "pga_median_g"]
COLUMNS += ["pga_max_g", "runs_planar"]


def main(job):
    case, settings = Case.read(job.input.case), json.loads(job.params.settings)
    shaken = getattr(job.input, "shaken", None)
    parts, most = cases_of(case, shaken), settings["ida.max_pga_g"]
    motions = {
        name: Motion(load_as(settings, name, job.params.table)) for name, _ in job.params.curves
    }
    turns = [(motions[name], direction) for name, direction in job.params.curves]
    found = {part: crossings_of(own, turns, {"max_pga_g": most}) for part, own in parts.items()}
    rows = []
    for k, (motion, direction) in enumerate(turns):
        about = {"model": case.model, "record": motion.name, "direction": direction}
        about |= {"record_pga_g": measures(motion.record)["pga_g"], "pga_max_g": most}
        rows += [{"part": part, **about, **own[k]} for part, own in found.items()]
    write_table(rows, job.output[0], ["part", *COLUMNS] if shaken else COLUMNS)


run(main, globals())
