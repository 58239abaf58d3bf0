"""Where the methods fail, cell by cell of a map, under one record."""

from rocking.records import read_csv
from rocking.runtime.script import run
from rocking.tables import write_table
from studies.limits import study as limits


def main(job):
    record, rows = read_csv(job.input.record), []
    for axis, value, thickness, model, changes, motion in limits.cells():
        about = {"model": model, "axis": axis, "value": value, "thickness_m": thickness}
        shaken = limits.shaped(record, **motion)
        rows.append(about | limits.verdict_of(model, changes, shaken, job.params.direction))
    write_table(rows, job.output[0], limits.COLUMNS)


run(main, globals())
