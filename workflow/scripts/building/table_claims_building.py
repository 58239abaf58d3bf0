"""The study's statements on the building beside what was measured (tables/claims_building.csv)."""

from pathlib import Path

import pandas as pd
from rocking.building.claims import evaluate
from rocking.runtime.script import run
from rocking.statements import COLUMNS


def main(job):
    explicit = {
        Path(path).stem.removeprefix("building_explicit_"): pd.read_csv(path)
        for path in job.input.explicit
    }
    rows = evaluate(pd.read_csv(job.input.modes), pd.read_csv(job.input.wme), explicit)
    pd.DataFrame(rows, columns=COLUMNS).to_csv(job.output[0], index=False, lineterminator="\n")


run(main, globals())
