"""Collapse of one record's curves under one and under both horizontal components."""

import numpy as np
from rocking.runtime.script import run
from rocking.studies.two_components import COLUMNS, Comparison
from rocking.tables import read_json, write_table

from yade_scripts.model import floor_motions


def main(job):
    p, rows = job.params, []
    first, second = (floor_motions.read(path) for path in (job.input.motion, job.input.second))
    ratio = np.abs(second[1]["ground"]).max() / np.abs(first[1]["ground"]).max()
    time_s, columns = floor_motions.with_second(*first, *second)
    for path in job.input.scenes:
        scene = read_json(path)
        for direction in p.directions:
            found = Comparison(scene, time_s, columns, direction, p.settings).compare()
            own = (scene["model"], job.wildcards.record, p.second, direction, ratio)
            rows.append((*own, *found))
    write_table(rows, job.output[0], COLUMNS)


run(main, globals())
