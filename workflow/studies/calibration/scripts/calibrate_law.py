"""Which groups the fitted β depends on, and the law that `damping.law: fitted` uses."""

from pathlib import Path

from rocking.mechanics import beta
from rocking.runtime.script import run
from rocking.tables import read_frame, write_table
from studies.calibration import laws


def main(job):
    chosen, rows = laws.compare(read_frame(job.input.walls))
    write_table(rows, job.output.table, laws.COLUMNS)
    known = beta.read_laws(job.input.others)
    Path(job.output.law).write_text(
        beta.to_json({**known, job.params.base: chosen}), encoding="utf-8"
    )


run(main, globals())
