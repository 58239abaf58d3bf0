"""Collapse of W2, one-way and two-way, under one record and before many buildings."""

from functools import partial
from itertools import groupby
from operator import itemgetter

from rocking import Case, Motion
from rocking.collapse.varied import collapses, intensities
from rocking.records import read_csv
from rocking.runtime.script import run
from rocking.tables import write_table
from studies.assumptions.study import buildings

COLUMNS = ["record", "direction", "mass_ratio", "period_s", "damping_ratio"]
MEASURES = ("collapse", "median", "equivalent", "all", "max")
COLUMNS += [*(f"pga_{name}_g" for name in MEASURES), "runs_planar"]
MEMBERS = 5  # amplitudes behind a probability


def main(job):
    case, settings = Case.read(job.input.case), job.params.assumptions
    motion, ratio, rows = Motion(read_csv(job.input.record)), settings["level_ratio"], []
    how = {"level_ratio": ratio, "amplitude_spread": 0.5 * (MEMBERS - 1) * ratio}
    find = partial(intensities, search="climb", slope=job.params.hazard_slope, **how)
    chain = itemgetter("period_s", "damping_ratio")
    for _, group in groupby(buildings(case, settings), lambda variant: chain(variant.about)):
        mine = list(group)
        for direction in job.params.directions:
            rows += collapses([case], motion, [direction], find, mine)
    write_table(rows, job.output[0], COLUMNS)


run(main, globals())
