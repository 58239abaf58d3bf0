"""Absolute floor accelerations of the substitute chain (smdof/{record}_{n}dof.csv).

Of a record with floors that another program computed: those.
"""

import json

from rocking.records import read_csv, read_table
from rocking.records.floor_table import floors_of
from rocking.records.floors import floor_columns
from rocking.runtime.script import run

from yade_scripts.model import floor_motions, yielding


def main(job):
    chain = {**json.loads(job.params.smdof)["smdof"], "n_dof": int(job.wildcards.n)}
    record, name = read_csv(job.input.record), job.wildcards.record
    if job.params.floors:
        time_s, columns = floors_of(read_table(job.params.floors[0])[name], record)
    else:
        time_s, columns = floor_columns(record, chain)
    if isinstance(columns, yielding.TabulatedFloors):
        floor_motions.write_tabulated(job.output[0], time_s, columns)
        return
    vertical = columns.pop(floor_motions.VERTICAL, None)
    ground, *floors = columns.values()
    floor_motions.write(job.output[0], time_s, ground, floors, vertical)


run(main, globals())
