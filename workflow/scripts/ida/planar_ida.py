"""Dense scan of one curve by the planar solver, and what YADE is to run after it."""

import json
from pathlib import Path

from rocking import Case, Motion, collapse_curve
from rocking.collapse.plan import plan
from rocking.runtime.script import run
from rocking.tables import write_table

from yade_scripts.model import models
from yade_scripts.studies.search import DIGITS


def main(job):
    case, ida = Case.read(job.input.scene), {}
    if case["ida"]["start_g"] is None:
        ida["start_g"] = round(0.5 * models.static_multiplier(case.scene), DIGITS)
    motion = Motion.read_floors(job.input.motion, job.params.record)
    curve = collapse_curve(case, motion, job.wildcards.direction)
    table = curve.table
    for place, name in enumerate(("model", "record", "direction")):
        table.insert(place, name, getattr(curve, name))
    # so many that no amplitude is rounded into a neighbouring window of 1 %
    write_table(table, job.output.scan, digits="%.8g")
    found = plan(table, {**case["ida"], **ida}, case["ensemble"])
    Path(job.output.plan).write_text(json.dumps(found) + "\n")


run(main, globals())
