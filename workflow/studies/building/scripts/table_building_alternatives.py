"""The study's four periods for each plan, floor load fitted (tables/building_alternatives.csv)."""

from rocking.runtime.script import run
from rocking.tables import write_table
from studies.building.case import (
    MODELS,
    PAPER_PERIODS_S,
    build_model,
    fit_floor_load,
    read_plan,
    translation_mode,
    twist_mode,
)
from studies.building.modes import DIRECTIONS, Solver

COLUMNS = ["plan", "floor_load_kg_m2", "masonry_mass_kg", "mass_kg", "model", "mode", "direction"]
COLUMNS += ["period_s", "effective_mass_ratio", "period_paper_s", "relative_difference"]


def main(job):
    settings = dict(job.params.building)
    rows = []
    for path in job.input.plans:
        plan = read_plan(path)
        load, _ = fit_floor_load(settings, plan)
        for model in MODELS:
            building = build_model(settings, plan, model, load)
            modes = Solver(building.scene).modes(12)
            for direction, mode in (("y", translation_mode(modes)), ("rz", twist_mode(modes))):
                period, paper = modes.period_s[mode], PAPER_PERIODS_S[model, direction]
                ratio = modes.effective_ratio[mode, DIRECTIONS.index(direction)]
                masses = load, building.masonry_mass_kg, building.mass_kg
                found = mode + 1, direction, period, round(ratio, 6), paper, period / paper - 1.0
                rows.append((plan.name, *masses, model, *found))
    write_table(rows, job.output[0], COLUMNS)


run(main, globals())
