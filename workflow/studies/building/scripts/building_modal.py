"""Modes of CBDEM or SBDEM with the fitted floor load (building/{building}_modes.npz)."""

from rocking.runtime.script import run
from studies.building.case import fitted_model
from studies.building.modes import Solver


def main(job):
    settings = dict(job.params.building)
    building = fitted_model(settings, job.input.plan, job.input.fit, job.wildcards.building)
    Solver(building.scene).modes(settings["modes"]).save(job.output[0])


run(main, globals())
