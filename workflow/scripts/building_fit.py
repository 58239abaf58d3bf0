"""Floor load that gives the complete building its stated period (building/fit.json)."""

import json

from rocking.building.case import fit_floor_load, read_plan
from rocking.runtime.script import run


def main(job):
    settings = dict(job.params.building)
    load, period = fit_floor_load(settings, read_plan(job.input.plan))
    fit = {"floor_load_kg_m2": load, "period_s": period, "target_s": settings["fit_period_s"]}
    with open(job.output[0], "w") as handle:
        json.dump(fit, handle, indent=1, sort_keys=True)
        handle.write("\n")


run(main, globals())
