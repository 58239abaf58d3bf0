"""Dense scan of one curve by the planar solver, and what YADE is to run after it."""

import json
from pathlib import Path

from rocking.collapse.plan import plan
from rocking.collapse.scan import Screen, scan_settings
from rocking.runtime.script import run
from rocking.tables import write_table

from yade_scripts.model import floor_motions, models
from yade_scripts.studies.search import DIGITS


def main(job):
    scene = json.loads(Path(job.input.scene).read_text())
    w, ida, ensemble = job.wildcards, dict(scene["ida"]), scene["ensemble"]
    if ida["start_g"] is None:
        ida["start_g"] = round(0.5 * models.static_multiplier(scene), DIGITS)
    motion = floor_motions.read(job.input.motion)
    table = Screen(scene, *motion, w.direction).scan(scan_settings(scene))
    table.insert(0, "model", scene["model"])
    table.insert(1, "record", job.params.record)
    table.insert(2, "direction", w.direction)
    write_table(table, job.output.scan)
    Path(job.output.plan).write_text(json.dumps(plan(table, ida, ensemble)) + "\n")


run(main, globals())
