"""Curve of a pushover with the closed forms beside it (contract: pushover/{model}.csv)."""

import pandas as pd
from rocking.pushover import complete_curve
from rocking.runtime.script import run
from rocking.tables import read_json, write_table


def main(job):
    config = read_json(job.input.case)
    curve = complete_curve(pd.read_csv(job.input.raw), config, config["model"])
    write_table(curve, job.output[0], digits="%.9g")


run(main, globals())
