"""Curve of a pushover with the closed forms beside it (contract: pushover/{model}.csv)."""

from rocking.pushover import complete_curve
from rocking.runtime.script import run
from rocking.tables import read_frame, read_json, write_table


def main(job):
    config = read_json(job.input.case)
    curve = complete_curve(read_frame(job.input.raw), config, config["model"])
    write_table(curve, job.output[0], digits="%.9g")


run(main, globals())
