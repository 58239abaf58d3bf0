"""Curve of a pushover with the closed forms beside it (contract: pushover/{model}.csv)."""

import json
from pathlib import Path

import pandas as pd
from rocking.runtime.script import run
from rocking.studies.pushover import complete_curve


def main(job):
    config = json.loads(Path(job.input.scene).read_text())
    curve = complete_curve(pd.read_csv(job.input.raw), config, config["model"])
    curve.to_csv(job.output[0], index=False, float_format="%.9g", lineterminator="\n")


run(main, globals())
