"""Calibration of predictions of falls, and their scores where outcomes are known."""

from rocking.runtime.script import run
from rocking.tables import write_table
from studies.overturning import study


def main(job):
    tests = next(iter(job.input.get("tests", [])), None)
    write_table(study.calibration(job.params.folder, tests), job.output[0])


run(main, globals())
