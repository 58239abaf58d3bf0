"""The study's statements on the building beside what was measured (tables/claims_building.csv)."""

from pathlib import Path

import pandas as pd
from rocking.building.claims import evaluate
from rocking.runtime.script import run
from rocking.statements import COLUMNS
from rocking.tables import write_table


def main(job):
    explicit = {
        Path(path).stem.removeprefix("building_explicit_"): pd.read_csv(path)
        for path in job.input.explicit
    }
    rows = evaluate(pd.read_csv(job.input.modes), pd.read_csv(job.input.wme), explicit)
    write_table(rows, job.output[0], COLUMNS, digits=None)


run(main, globals())
