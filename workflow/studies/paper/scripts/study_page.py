"""The 3DEC study row by row beside this run (study.md), from docs/study.yaml and its tables."""

from pathlib import Path

import yaml
from rocking.runtime.script import run
from rocking.tables import read_frame
from studies.paper.page import page

ABOUT = """\
Every row has one of its figures, tables, equations or results, its value, the value here, and why
they differ. Most rows that are not met rest on what the 3DEC study does not state: the building's
plan, the widths of tested walls, the order of a motion's pulses.

`given` is an input that was taken over. `open` is text that holds nothing to compare with. †
marks a limit that the 3DEC study does not state. `tables/claims*.csv` hold the claims, for
surrogates and recorded motions apart. `make study` makes this page out of `docs/study.yaml`."""


def main(job):
    data = yaml.safe_load(Path(job.input.data).read_text(encoding="utf-8"))
    tables = {Path(path).stem: read_frame(path) for path in job.input.tables}
    Path(job.output[0]).write_text(page(data, tables, ABOUT), encoding="utf-8")


run(main, globals())
