"""Dense scan of one curve by the planar solver, and what YADE is to run after it."""

from rocking import Case, Motion, collapse_curve
from rocking.collapse.plan import plan
from rocking.runtime.script import run
from rocking.tables import headed, write_json, write_table

from yade_scripts.commands.search import DIGITS
from yade_scripts.model import models


def main(job):
    case, ida = Case.read(job.input.case), {}
    if case["ida"]["start_g"] is None:
        ida["start_g"] = round(0.5 * models.static_multiplier(case.sections), DIGITS)
    motion = Motion.of_workflow(job.input.motion, job.params.record)
    curve = collapse_curve(case, motion, job.wildcards.direction)
    key = {name: getattr(curve, name) for name in ("model", "record", "direction")}
    table = headed(curve.table, **key)
    # so many that no amplitude is rounded into a neighbouring window of 1 %
    write_table(table, job.output.scan, digits="%.8g")
    planned = plan(table, {**case["ida"], **ida}, case["ensemble"])
    write_json(job.output.plan, planned, indent=None)


run(main, globals())
