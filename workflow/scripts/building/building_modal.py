"""Modes of CBDEM or SBDEM with the fitted floor load (building/{building}_modes.npz)."""

import json

from rocking.building.case import build_model, read_plan
from rocking.building.modes import Solver
from rocking.runtime.script import run


def main(job):
    settings = dict(job.params.building)
    with open(job.input.fit) as handle:
        load = json.load(handle)["floor_load_kg_m2"]
    plan = read_plan(job.input.plan)
    building = build_model(settings, plan, job.wildcards.building, load)
    Solver(building.scene).modes(settings["modes"]).save(job.output[0])


run(main, globals())
