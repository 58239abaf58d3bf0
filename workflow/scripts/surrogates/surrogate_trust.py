"""Collapse of all records and surrogates in one table, their ratio, and the scatter of draws."""

from rocking.runtime.script import run
from rocking.studies.surrogate_trust import scatter, summary
from rocking.tables import read_tables, write_table


def main(job):
    table = read_tables(job.input.tables)
    for name in ("pulses", "pulses_kept"):
        table[name] = table[name].astype("Int64")
    write_table(table, job.output.table)
    write_table(scatter(table), job.output.scatter)
    write_table(summary(table), job.output.summary)


run(main, globals())
