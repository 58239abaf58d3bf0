"""The study row by row beside this run (study.md), from docs/study.yaml and the run's tables."""

from pathlib import Path

import yaml
from rocking.runtime.script import run
from rocking.tables import read_frame
from studies.paper.page import page

ABOUT = """\
The study is *Using DEM to investigate boundary conditions for rocking URM façades subjected to
earthquake motion*; the copy that was read names no authors, year or journal. Each row has one of
its figures, tables, equations or results, its value, ours, and why they differ. Most rows that are
not met rest on what the study does not state: the building's plan, the widths of tested walls, the
order of a motion's pulses.

`given`: an input that was taken over. `open`: the text holds nothing to compare with. "Our
threshold" marks a limit that the study does not state. Claims stand in `tables/claims*.csv`, for
surrogates and recorded motions apart. Made by `make study` out of `docs/study.yaml`."""


def main(job):
    data = yaml.safe_load(Path(job.input.data).read_text(encoding="utf-8"))
    tables = {Path(path).stem: read_frame(path) for path in job.input.tables}
    Path(job.output[0]).write_text(page(data, tables, ABOUT), encoding="utf-8")


run(main, globals())
