"""Collapse under both components of all records in one table, and the distribution of its ratio."""

import pandas as pd
from rocking.runtime.script import run
from rocking.studies.two_components import summary
from rocking.tables import write_table


def main(job):
    table = pd.concat([pd.read_csv(path) for path in job.input.tables], ignore_index=True)
    write_table(table, job.output.table)
    write_table(summary(table), job.output.summary)


run(main, globals())
