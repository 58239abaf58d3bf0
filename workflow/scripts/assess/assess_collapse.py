"""PGA of 10 and 50 % collapse of one model under every motion of the run, by the planar solver."""

import json

from rocking import Case, Motion
from rocking.collapse.quick import crossings
from rocking.records import load_as, measures
from rocking.runtime.script import run
from rocking.tables import write_table

COLUMNS = ["model", "record", "direction", "record_pga_g", "pga_p10_g", "pga_median_g"]
COLUMNS += ["pga_max_g", "runs_planar"]


def main(job):
    case, settings = Case.read(job.input.scene), json.loads(job.params.settings)
    limit = {"max_pga_g": settings["ida.max_pga_g"]}
    rows = []
    for name in job.params.records:
        motion = Motion(load_as(settings, name, job.params.table))
        peak = measures(motion.record)["pga_g"]
        for direction in settings["directions"]:
            key = {"model": case.model, "record": name, "direction": direction}
            found = crossings(case, motion, direction, limit)
            rows.append(key | {"record_pga_g": peak, "pga_max_g": limit["max_pga_g"]} | found)
    write_table(rows, job.output[0], COLUMNS)


run(main, globals())
