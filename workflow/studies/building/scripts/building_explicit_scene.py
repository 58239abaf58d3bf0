"""Scene, damping rate and step of the explicit run of SBDEM (building/explicit_….json)."""

from rocking.runtime.script import run
from studies.building.case import fitted_model, translation_mode
from studies.building.history import mass_damping_rate
from studies.building.modes import Solver, largest_frequency

from yade_scripts.model.scene import to_json


def main(job):
    settings = dict(job.params.building)
    size = float(job.wildcards.coarsening)
    building = fitted_model(settings, job.input.plan, job.input.fit, "SBDEM", size)
    solver = Solver(building.scene)
    modes = solver.modes(12)
    highest = largest_frequency(solver.k, solver.mass)
    building.scene.notes.update(
        omega_max_rad_s=highest,
        step_s=settings["explicit_step_fraction"] * 2.0 / highest,
        rate_1_s=mass_damping_rate(modes.omega[translation_mode(modes)], settings["damping_ratio"]),
        duration_s=settings["explicit_duration_s"],
    )
    with open(job.output[0], "w", encoding="utf-8") as handle:
        handle.write(to_json(building.scene))


run(main, globals())
