"""The study's statements on the building beside what was measured (tables/claims_building.csv)."""

from pathlib import Path

from rocking.runtime.script import run
from rocking.tables import read_frame, write_table
from studies.building.claims import evaluate
from studies.shared.statements import COLUMNS


def main(job):
    explicit = {
        Path(path).stem.removeprefix("building_explicit_"): read_frame(path)
        for path in job.input.explicit
    }
    rows = evaluate(read_frame(job.input.modes), read_frame(job.input.wme), explicit)
    write_table(rows, job.output[0], COLUMNS, digits=None)


run(main, globals())
