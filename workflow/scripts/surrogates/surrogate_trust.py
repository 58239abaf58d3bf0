"""Collapse of all records and surrogates in one table, their ratio, and the scatter of draws."""

import pandas as pd
from rocking.runtime.script import run
from rocking.studies.surrogate_trust import scatter, summary

FORMAT = {"index": False, "float_format": "%.6g", "lineterminator": "\n"}


def main(job):
    table = pd.concat([pd.read_csv(path) for path in job.input.tables], ignore_index=True)
    for name in ("pulses", "pulses_kept"):
        table[name] = table[name].astype("Int64")
    table.to_csv(job.output.table, **FORMAT)
    scatter(table).to_csv(job.output.scatter, **FORMAT)
    summary(table).to_csv(job.output.summary, **FORMAT)


run(main, globals())
