"""The study's statements on boundary conditions beside what a run measured (tables/claims.csv)."""

import json
from pathlib import Path

import pandas as pd
from rocking.curves.claims import table
from rocking.curves.pushover import summary
from rocking.runtime.script import run


def main(job):
    facts = [json.loads(Path(path).read_text()) for path in job.input.facts]
    peaks = {
        Path(path).stem: summary(pd.read_csv(path))["lambda_peak"]
        for path in getattr(job.input, "pushover", [])
    }
    claims = table(pd.read_csv(job.input.collapse), peaks, {f["name"]: f["source"] for f in facts})
    claims.to_csv(job.output[0], index=False, lineterminator="\n")


run(main, globals())
