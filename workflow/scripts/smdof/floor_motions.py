"""Absolute floor accelerations of the substitute chain (smdof/{record}_{n}dof.csv)."""

import json

from rocking.records import read_csv
from rocking.records.floors import floor_columns
from rocking.runtime.script import run

from yade_scripts.model import floor_motions


def main(job):
    chain = {**json.loads(job.params.smdof)["smdof"], "n_dof": int(job.wildcards.n)}
    time_s, columns = floor_columns(read_csv(job.input.record), chain)
    vertical = columns.pop(floor_motions.VERTICAL, None)
    ground, *floors = columns.values()
    floor_motions.write(job.output[0], time_s, ground, floors, vertical)


run(main, globals())
