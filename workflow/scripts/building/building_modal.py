"""Modes of CBDEM or SBDEM with the fitted floor load (building/{building}_modes.npz)."""

from rocking.building.case import build_model, read_plan
from rocking.building.modes import Solver
from rocking.runtime.script import run
from rocking.tables import read_json


def main(job):
    settings = dict(job.params.building)
    load = read_json(job.input.fit)["floor_load_kg_m2"]
    plan = read_plan(job.input.plan)
    building = build_model(settings, plan, job.wildcards.building, load)
    Solver(building.scene).modes(settings["modes"]).save(job.output[0])


run(main, globals())
