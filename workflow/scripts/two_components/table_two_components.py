"""Collapse under both components of all records in one table, and the distribution of its ratio."""

from rocking.runtime.script import run
from rocking.studies.two_components import summary
from rocking.tables import read_tables, write_table


def main(job):
    table = read_tables(job.input.tables)
    write_table(table, job.output.table)
    write_table(summary(table), job.output.summary)


run(main, globals())
