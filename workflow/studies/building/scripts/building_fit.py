"""Floor load that gives the building its stated period, and its mass (building/fit.json)."""

from rocking.runtime.script import run
from rocking.tables import write_json
from studies.building.case import fit_floor_load, mass_behind_facade, read_plan


def main(job):
    settings = dict(job.params.building)
    plan = read_plan(job.input.plan)
    load, period = fit_floor_load(settings, plan)
    fit = {
        "floor_load_kg_m2": load,
        "period_s": period,
        "target_s": settings["fit_period_s"],
        "mass_behind_facade_kg": mass_behind_facade(settings, plan, load),
    }
    write_json(job.output[0], fit, sort_keys=True)


run(main, globals())
