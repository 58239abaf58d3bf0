"""Rebounds and e_exp of every free-rocking run; an impact that did not happen stays blank."""

from rocking.runtime.script import run
from rocking.tables import write_table
from studies.calibration.fits import walls_of
from studies.shared.restitution import IMPACTS

COLUMNS = ("wall", "beta_s", "n", "time_s", "theta_over_alpha", "e_exp", "e_1sr")


def rows_of(wall):
    for beta, observed, e in zip(wall["beta_s"], wall["found"], wall["e"], strict=True):
        for n in range(IMPACTS):
            happened = n < len(observed)
            yield {
                "wall": wall["case"]["id"],
                "beta_s": beta,
                "n": n + 1,
                "time_s": observed.impact_time_s[n] if happened else None,
                "theta_over_alpha": observed.peak[n] if happened else None,
                "e_exp": e[n] if happened else None,
                "e_1sr": wall["e_1sr"],
            }


def main(job):
    files = zip(job.input.cases, job.input.histories, strict=True)
    rows = [row for pair in files for wall in walls_of(*pair) for row in rows_of(wall)]
    write_table(rows, job.output[0], COLUMNS)


run(main, globals())
