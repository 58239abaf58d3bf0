"""Collapse of a stack of courses under one motion, and of the rigid block on either base."""

from rocking import Case, Motion
from rocking.runtime.script import run
from rocking.studies.base_compliance import collapse
from rocking.tables import write_table


def main(job):
    case = Case.read(job.input.scene)
    motion = Motion.read_floors(job.input.motion, job.params.record)
    write_table(collapse(case, motion, job.wildcards.direction), job.output[0])


run(main, globals())
