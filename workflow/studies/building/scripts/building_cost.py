"""Periods, wall time and memory of one model at one brick size (building/cost_…json)."""

import resource
import time

from rocking.runtime.script import run
from rocking.tables import write_json
from studies.building.case import fitted_model, translation_mode, twist_mode
from studies.building.modes import Solver


def memory_mb():
    """Return the peak resident memory of this process [MB]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def main(job):
    settings = dict(job.params.building)
    model, coarsening = job.wildcards.building, float(job.wildcards.coarsening)
    at_start = memory_mb()
    began, began_cpu = time.perf_counter(), time.process_time()
    building = fitted_model(settings, job.input.plan, job.input.fit, model, coarsening)
    built = time.perf_counter()
    solver = Solver(building.scene)
    factorised = time.perf_counter()
    modes = solver.modes(12)
    ended = time.perf_counter()
    row = {
        "model": model,
        "coarsening": coarsening,
        "bricks": len(building.bricks),
        "interfaces": len(building.interfaces),
        "dofs": len(solver.mass),
        "period_y_s": modes.period_s[translation_mode(modes)],
        "period_rz_s": modes.period_s[twist_mode(modes)],
        "period_1_s": modes.period_s[0],
        "build_s": built - began,
        "factorise_s": factorised - built,
        "modes_s": ended - factorised,
        "wall_s": ended - began,
        "cpu_s": time.process_time() - began_cpu,
        "memory_mb": memory_mb(),
        "memory_at_start_mb": at_start,
    }
    write_json(job.output[0], {k: v if isinstance(v, str) else float(v) for k, v in row.items()})


run(main, globals())
