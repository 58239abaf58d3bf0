"""Collapse with and without vertical motion of all records, and the distribution of the ratio."""

import pandas as pd
from rocking.runtime.script import run
from rocking.studies.vertical import summary

FORMAT = {"index": False, "float_format": "%.6g", "lineterminator": "\n"}


def main(job):
    table = pd.concat([pd.read_csv(path) for path in job.input.tables], ignore_index=True)
    table.to_csv(job.output.table, **FORMAT)
    summary(table).to_csv(job.output.summary, **FORMAT)


run(main, globals())
