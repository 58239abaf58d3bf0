"""Best-fitting β of every wall of the study with its misfit, and the contract's shorter table."""

from rocking.runtime.script import run
from rocking.tables import write_table
from studies.calibration.fits import COLUMNS, CONTRACT, row_of, walls_of


def main(job):
    files = zip(job.input.cases, job.input.histories, strict=True)
    rows = [row_of(wall) for pair in files for wall in walls_of(*pair)]
    write_table(rows, job.output.walls, COLUMNS)
    write_table([r for r in rows if r["role"] == "reference"], job.output.fit, CONTRACT)


run(main, globals())
