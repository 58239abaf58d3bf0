"""The W1 cases of the accuracy study in an outside engine, for comparison (optional extra)."""

from rocking.accuracy import drake, mujoco
from rocking.accuracy.outside import compare
from rocking.runtime.script import run

ENGINES = {"drake": drake, "mujoco": mujoco}


def main(job):
    engine = ENGINES[job.wildcards.engine]
    compare(job, engine.NAME, engine.PACKAGE, engine.run_case, engine.STEPS)


run(main, globals())
