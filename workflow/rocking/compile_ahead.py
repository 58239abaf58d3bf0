"""Compile loops before the first run, as a part of the set-up.

`python -m rocking.compile_ahead` compiles every loop, with `run` those of the main job alone: a
loop that is asked for later is compiled then.

What every run imports is compiled too, which an environment may forbid Python to keep later (as
those of containers often do): each start of Snakemake would take half as long again.

Each loop is called once on three samples at rest, as runs call it, so that numba's cache holds what
they ask for; in processes side by side, since a loop takes up to half a minute.
"""

import importlib
import multiprocessing
import sys
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool

import numpy as np
from reference_solver import SupportTable, simulate
from reference_solver.facade import wall_of
from reference_solver.stack import StackSolver

from rocking import solver
from rocking.collapse.scan import layouts
from rocking.configuration.config import resolve
from rocking.configuration.study import as_in_the_study
from rocking.mechanics import column
from rocking.runtime import warm
from rocking.solver import storeys
from yade_scripts.model.models import build_scene
from yade_scripts.model.storeys import chain_of

TIME_S, STILL = np.arange(3.0), np.zeros(3)


def case(model, block=False):
    """A case of a model as configured by default or, as one block, in the study; its numerics."""
    config = resolve(as_in_the_study() if block else {"models": [model]})
    numerics = layouts(config["numerics"])[0]
    return {**config, "numerics": numerics, "model": model, "beta_s": 0.0}, numerics


def planar(model, motions=0, block=False):
    """The planar loop of a model: of a stack of blocks, or of one block.

    Of one history, or of many side by side under one motion or under more.
    """
    given, numerics = case(model, block)
    scene = build_scene(given)
    still = [STILL for _ in solver.moving_supports(scene)]
    several = [solver.Motions(TIME_S, STILL, still) for _ in range(motions or 1)] * 4
    factors = np.ones(len(several) if motions else 1)
    solver.peaks(solver.to_plane(scene), several[: factors.size], numerics, factors, step_s=1e-3)


def others():
    """The reference solvers, and the column."""
    wall = wall_of(case("W1", block=True)[0], 3)
    simulate(wall, SupportTable(1.0, STILL))
    column.capacity(0.5, 0.05, 0.06)
    sections, _ = case("W2m", block=True)
    sections = {**sections, "return_wall": {**sections["return_wall"], "building_mass_kg": 1.0}}
    StackSolver(build_scene(sections), TIME_S, {"ground": STILL}).peaks([1.0], step_s=1e-2)


def building():
    """The chain of a building that yields, whose floors are computed at every amplitude."""
    storeys.march(chain_of(case("W2")[0], 1e-2), STILL, [1.0])


def imports():
    """What Snakemake and the scripts of its rules import."""
    for name in (*warm.LIBRARIES, "nbformat", "scipy.optimize", "scipy.signal", "smart_open"):
        importlib.import_module(name)
    importlib.import_module("snakemake.cli").get_argument_parser()  # its plugins


MAIN_JOB = ((planar, "W2", 1), (planar, "W2"), (building,), (imports,))
JOBS = (
    (planar, "W2", 0, True),
    (others,),
    (planar, "W2"),
    (planar, "W2", 1),
    (planar, "W2", 2),
    (planar, "W2", 1, True),
    (planar, "W2", 2, True),
    (building,),
    (imports,),
)  # the longest first
SETS = {"all": JOBS, "run": MAIN_JOB}


def main(jobs=JOBS):
    """Compile all, as many at a time as there are cores; return the exit status.

    Says how many parts are done whenever one ends.
    """
    try:
        with ProcessPoolExecutor(mp_context=multiprocessing.get_context("spawn")) as pool:
            parts = [pool.submit(*job) for job in jobs]
            for done, part in enumerate(as_completed(parts), start=1):
                part.result()
                sys.stderr.write(f"setup: {done} of {len(parts)} parts compiled\n")
    except BrokenProcessPool:
        sys.stderr.write(
            "error: a process that compiled a solver was killed, as where memory is short "
            "(1 GB each): give the same command again\n"
        )
        return 1
    return 0


if __name__ == "__main__":
    wanted = sys.argv[1] if len(sys.argv) > 1 else "all"
    if wanted not in SETS:
        sys.exit(f"error: '{wanted}' is not known; expected {' or '.join(SETS)}")
    sys.exit(main(SETS[wanted]))
