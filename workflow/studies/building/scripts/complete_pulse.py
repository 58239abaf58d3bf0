"""Half a sine of ground acceleration, and rest: the motion under which the building rings."""

import numpy as np
from rocking.runtime.script import run

from yade_scripts.model import floor_motions

STEP_S, PUSH_S, END_S = 0.005, 0.1, 1.5


def main(job):
    time_s = np.arange(0.0, END_S + 0.5 * STEP_S, STEP_S)
    push = np.where(time_s <= PUSH_S, np.sin(np.pi * time_s / PUSH_S), 0.0)
    floor_motions.write(job.output[0], time_s, push)


run(main, globals())
