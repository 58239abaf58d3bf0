"""Curve of a pushover with the closed forms beside it (contract: pushover/{model}.csv)."""

import json
from pathlib import Path

import pandas as pd
from rocking.runtime.script import run
from rocking.studies.pushover import complete_curve
from rocking.tables import write_table


def main(job):
    config = json.loads(Path(job.input.scene).read_text())
    curve = complete_curve(pd.read_csv(job.input.raw), config, config["model"])
    write_table(curve, job.output[0], digits="%.9g")


run(main, globals())
