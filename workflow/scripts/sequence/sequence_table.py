"""Collapse after a first shock, all curves, and the spread of its ratios."""

from rocking.runtime.script import run
from rocking.studies.sequence import summary
from rocking.tables import read_tables, write_table


def main(job):
    table = read_tables(job.input.tables)
    write_table(table, job.output.table)
    write_table(summary(table), job.output.summary)


run(main, globals())
