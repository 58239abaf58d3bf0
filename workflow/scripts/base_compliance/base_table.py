"""Collapse on either base beside the stack's, all curves, and the spread of the ratios."""

from rocking.runtime.script import run
from rocking.studies.base_compliance import summary
from rocking.tables import read_tables, write_table


def main(job):
    table = read_tables(job.input.tables)
    write_table(table, job.output.table)
    write_table(summary(table), job.output.summary)


run(main, globals())
