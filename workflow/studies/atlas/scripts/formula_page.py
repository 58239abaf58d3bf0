"""The page on which a reader moves a façade's numbers, with the formula of this run inside."""

from pathlib import Path

from rocking.formula.law import read
from rocking.runtime.script import run
from studies.atlas.page import page


def main(job):
    Path(job.output[0]).write_text(page(read(job.input.formula)), encoding="utf-8")


run(main, globals())
