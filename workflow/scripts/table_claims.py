"""The study's statements on boundary conditions beside what a run measured (tables/claims.csv)."""

import json
from pathlib import Path

import pandas as pd
from rocking.claims import table
from rocking.script import run


def main(job):
    facts = [json.loads(Path(path).read_text()) for path in job.input.facts]
    pushover = pd.read_csv(job.input.pushover) if getattr(job.input, "pushover", None) else None
    peaks = {} if pushover is None else dict(
        zip(pushover["case"], pushover["lambda_peak"], strict=True)
    )  # fmt: skip
    claims = table(pd.read_csv(job.input.collapse), peaks, {f["name"]: f["source"] for f in facts})
    claims.to_csv(job.output[0], index=False, lineterminator="\n")


run(main, globals())
