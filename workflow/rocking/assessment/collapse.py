"""Lowest amplitudes at which 10 and 50 % of the members collapse, for many façades and motions.

The dense scan (`rocking.collapse.scan`) finds every island of a curve. Where only the first
crossings are wanted, of thousands of curves, `search.crossings` finds them at longer steps. An
island further below, narrower than a step of its climb, may be missed: what that changes is
measured in docs/assessment.md.
"""

from rocking.collapse import search
from rocking.collapse.scan import Screen
from rocking.records.floors import floor_columns
from yade_scripts.model import models, registry

STEP = 0.3  # of the stable step: some four times that of the dense scan


class Climb:
    """First crossings of one model, record and direction.

    Parameters
    ----------
    job : dict
        A scene file.
    time_s, columns, direction
        As of `Screen`.
    step : float
        Of the stable step.
    """

    def __init__(self, job, time_s, columns, direction, step=STEP):
        """Prepare the scene in every layout of nodes, each with a step of its own."""
        self.screen = Screen(job, time_s, columns, direction, step)
        self.ratio = registry.model(job["model"]).climb_ratio
        self.runs = 0

    def crossings(self, max_pga_g, start_g):
        """PGA at which 10 and 50 % of the members first collapse [g]; see `search.crossings`."""
        table, found = self.screen.seen(search.crossings(start_g, max_pga_g, self.ratio))
        self.runs += len(table)
        return found


def lowest_start(job):
    """PGA from which a scene file's curves are climbed [g]: a share of its static multiplier."""
    return registry.model(job["model"]).climb_from * models.static_multiplier(job)


def collapse_pga(job, record, directions, max_pga_g):
    """First crossings under one record: (direction, p10, median, histories run) each [g]."""
    motion = floor_columns(record, job["smdof"])
    for direction in directions:
        climb = Climb(job, motion[0], motion[1], direction)
        yield direction, *climb.crossings(max_pga_g, lowest_start(job)), climb.runs
