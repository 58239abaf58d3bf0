"""Collapse on either base beside the stack's, all curves, and the spread of the ratios."""

import pandas as pd
from rocking.runtime.script import run
from rocking.studies.base_compliance import summary
from rocking.tables import write_table


def main(job):
    table = pd.concat([pd.read_csv(path) for path in job.input.tables], ignore_index=True)
    write_table(table, job.output.table)
    write_table(summary(table), job.output.summary)


run(main, globals())
