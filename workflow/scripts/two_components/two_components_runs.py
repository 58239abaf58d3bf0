"""What YADE runs of one curve under two components: the compiled solver's intensities."""

import json
from pathlib import Path

import pandas as pd
from rocking import Case
from rocking.runtime.script import run
from rocking.studies.two_components import runs


def main(job):
    table, w = pd.read_csv(job.input.curves), job.wildcards
    row = table[(table["model"] == w.model) & (table["direction"] == w.direction)].iloc[0]
    listed = runs(Case.read(job.input.scene), row, job.params.settings)
    Path(job.output[0]).write_text(json.dumps(listed, indent=1, sort_keys=True) + "\n")


run(main, globals())
