"""Collapse of all records and surrogates in one table, their ratio, and the scatter of draws."""

import pandas as pd
from rocking.runtime.script import run
from rocking.studies.surrogate_trust import scatter, summary
from rocking.tables import write_table


def main(job):
    table = pd.concat([pd.read_csv(path) for path in job.input.tables], ignore_index=True)
    for name in ("pulses", "pulses_kept"):
        table[name] = table[name].astype("Int64")
    write_table(table, job.output.table)
    write_table(scatter(table), job.output.scatter)
    write_table(summary(table), job.output.summary)


run(main, globals())
