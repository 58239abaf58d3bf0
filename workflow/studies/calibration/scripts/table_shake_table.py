"""Peak displacements of the shake-table runs."""

from rocking.runtime.script import run
from rocking.tables import read_json, write_table
from studies.calibration.shake_table import COLUMNS, row_of
from studies.shared.restitution import read_archive


def main(job):
    runs = zip(read_json(job.input.tests), read_archive(job.input.histories), strict=True)
    write_table([row_of(test, done) for test, done in runs], job.output[0], COLUMNS)


run(main, globals())
