"""Collapse of one record after a first shock, by the first one's PGA, and what YADE confirms."""

from rocking import Case, Motion
from rocking.runtime.script import run
from rocking.studies import sequence
from rocking.tables import write_json, write_table


def main(job):
    p, direction = job.params, job.wildcards.direction
    case = Case.read(job.input.scene)
    first = Motion.read_floors(job.input.first, p.first)
    second = Motion.read_floors(job.input.motion, p.record)
    found = sequence.collapse(case, first, second, direction, p.settings)
    write_table(found, job.output.table)
    cases = sequence.to_confirm(case, first, second, found, p.settings["pause_s"])
    for before in (c["before"] for c in cases if "before" in c):
        before["motion"] = str(job.input.first)
    plan = {"ahead": sequence.AHEAD, "beside": sequence.BESIDE, "cases": cases}
    write_json(job.output.runs, plan)


run(main, globals())
