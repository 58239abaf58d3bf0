"""Rebounds and e_exp of every free-rocking run; an impact that did not happen stays blank."""

import csv
import json

from rocking.calibration import study
from rocking.calibration.restitution import IMPACTS, read_archive
from rocking.runtime.script import run

COLUMNS = ("wall", "beta_s", "n", "time_s", "theta_over_alpha", "e_exp", "e_1sr")


def rows_of(wall):
    for beta, found, e in zip(wall["beta_s"], wall["found"], wall["e"], strict=True):
        for n in range(IMPACTS):
            happened = n < len(found)
            yield {
                "wall": wall["case"]["id"],
                "beta_s": f"{beta:.6g}",
                "n": n + 1,
                "time_s": f"{found.impact_time_s[n]:.6g}" if happened else "",
                "theta_over_alpha": f"{found.peak[n]:.6g}" if happened else "",
                "e_exp": f"{e[n]:.6g}" if happened else "",
                "e_1sr": f"{wall['e_1sr']:.6g}",
            }


def main(job):
    with open(job.output[0], "w", newline="") as handle:
        writer = csv.DictWriter(handle, COLUMNS, lineterminator="\n")
        writer.writeheader()
        for cases, histories in zip(job.input.cases, job.input.histories, strict=True):
            with open(cases) as text:
                walls = study.evaluate(json.load(text), read_archive(histories))
            for wall in walls:
                writer.writerows(rows_of(wall))


run(main, globals())
