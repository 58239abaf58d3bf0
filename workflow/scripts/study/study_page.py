"""The study row by row beside this run (study.md), from docs/study.yaml and the run's tables."""

from pathlib import Path

import pandas as pd
import yaml
from rocking.runtime.script import run
from rocking.studies.paper import page

ABOUT = """\
Every figure, table, equation and sentence of result of the study (DEM investigation of boundary
conditions for rocking URM façades), its value, ours, and why they differ. `given`: an input that
was taken over; `open`: the text holds nothing to compare with. Claims are judged in
`tables/claims*.csv`, for surrogates and recorded motions apart; "our threshold" marks limits that
the study does not state. Made from the results by `make study` out of `docs/study.yaml`."""


def main(job):
    data = yaml.safe_load(Path(job.input.data).read_text(encoding="utf-8"))
    tables = {Path(path).stem: pd.read_csv(path) for path in job.input.tables}
    Path(job.output[0]).write_text(page(data, tables, ABOUT), encoding="utf-8")


run(main, globals())
