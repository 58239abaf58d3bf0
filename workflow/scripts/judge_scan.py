"""Dense scan of one curve by the independent planar solver."""

import json
from pathlib import Path

from rocking.accuracy.judge import SCAN_COLUMNS, scan
from rocking.runtime.script import run

from yade_scripts.model import models


def main(job):
    scene, w = json.loads(Path(job.input.scene).read_text()), job.wildcards
    settings = {**scene["ida"], **job.params.accuracy}
    static_g = models.static_multiplier(scene)
    table = scan(scene, job.input.motion, w.direction, settings, static_g)
    table = table.assign(model=scene["model"], record=w.record, direction=w.direction)
    table = table[list(SCAN_COLUMNS)]
    table.to_csv(job.output[0], index=False, float_format="%.6g", lineterminator="\n")


run(main, globals())
