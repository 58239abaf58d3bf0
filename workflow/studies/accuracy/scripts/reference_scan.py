"""Dense scan of one curve by the independent planar solver."""

import math

from rocking.runtime.script import run
from rocking.tables import read_frame, read_json, write_table
from studies.accuracy.coverage import SCAN_COLUMNS, scan

from yade_scripts.model import models


def main(job):
    scene, w = read_json(job.input.case), job.wildcards
    spread = scene["ensemble"]["amplitude_spread"]
    settings = {**scene["ida"], **job.params.accuracy, "amplitude_spread": spread}
    known = read_frame(job.input.scan)
    lowest = known.loc[known["collapsed"] == 1, "pga_g"].min()
    start_g = 0.5 * (models.static_multiplier(scene) if math.isnan(lowest) else lowest)
    table = scan(scene, job.input.motion, w.direction, settings, start_g)
    table = table.assign(model=scene["model"], record=job.params.record, direction=w.direction)
    write_table(table, job.output[0], SCAN_COLUMNS)


run(main, globals())
