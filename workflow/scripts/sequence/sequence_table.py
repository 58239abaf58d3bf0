"""Collapse after a first shock, all curves, and the spread of its ratios."""

import pandas as pd
from rocking.runtime.script import run
from rocking.studies.sequence import summary
from rocking.tables import write_table


def main(job):
    table = pd.concat([pd.read_csv(path) for path in job.input.tables], ignore_index=True)
    write_table(table, job.output.table)
    write_table(summary(table), job.output.summary)


run(main, globals())
