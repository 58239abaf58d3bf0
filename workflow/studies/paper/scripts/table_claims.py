"""The study's statements on boundary conditions beside what a run measured (tables/claims.csv)."""

import json
from pathlib import Path

from rocking.pushover import summary
from rocking.runtime.script import run
from rocking.tables import read_frame, read_json, write_table
from studies.paper.claims import table


def main(job):
    facts = [read_json(path) for path in job.input.facts]
    pushed = {
        Path(path).stem: summary(read_frame(path)) for path in getattr(job.input, "pushover", [])
    }
    peaks = {model: pushover["lambda_peak"] for model, pushover in pushed.items()}
    rule = json.loads(job.params.w3)["w3"]["header_joint"]
    claims = table(
        read_frame(job.input.collapse),
        peaks,
        {f["name"]: f["source"] for f in facts},
        {model: (pushover["ratio"], rule) for model, pushover in pushed.items()},
    )
    write_table(claims, job.output[0], digits=None)


run(main, globals())
