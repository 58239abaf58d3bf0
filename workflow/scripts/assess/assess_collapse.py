"""PGA of 10 and 50 % collapse of one model under every motion of the run, by the planar solver."""

import json
from functools import partial

from rocking import Case, Motion, Variant
from rocking.collapse.quick import crossings
from rocking.collapse.varied import collapses
from rocking.records import load_as, measures
from rocking.runtime.script import run
from rocking.tables import write_table

COLUMNS = ["model", "record", "direction", "record_pga_g", "pga_p10_g", "pga_median_g"]
COLUMNS += ["pga_max_g", "runs_planar"]


def main(job):
    case, settings = Case.read(job.input.scene), json.loads(job.params.settings)
    most = settings["ida.max_pga_g"]
    find = partial(crossings, settings={"max_pga_g": most})
    rows = []
    for name in job.params.records:
        motion = Motion(load_as(settings, name, job.params.table))
        about = {"record_pga_g": measures(motion.record)["pga_g"], "pga_max_g": most}
        rows += collapses([case], motion, settings["directions"], find, [Variant(about=about)])
    write_table(rows, job.output[0], COLUMNS)


run(main, globals())
