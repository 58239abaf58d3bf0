"""Top motion of a building under one record by modal superposition (building/history_….csv)."""

import numpy as np
from rocking.building.case import build_model, read_plan, translation_mode
from rocking.building.history import mass_damping_rate, modal_history
from rocking.building.modes import Modes
from rocking.records import read_csv
from rocking.runtime.script import run
from rocking.tables import read_json


def main(job):
    settings = dict(job.params.building)
    modes = Modes.load(job.input.modes)
    load = read_json(job.input.fit)["floor_load_kg_m2"]
    building = build_model(settings, read_plan(job.input.plan), job.wildcards.building, load)
    record = read_csv(job.input.record)
    rate = mass_damping_rate(modes.omega[translation_mode(modes)], settings["damping_ratio"])
    top = building.scene.index(building.scene.monitor)
    history = modal_history(modes, [top], record.acceleration_m_s2, record.dt_s, rate)
    columns = (
        history.time_s,
        history.ground_m_s2,
        history.acceleration_m_s2[0],
        history.displacement_m[0],
    )
    np.savetxt(
        job.output[0],
        np.column_stack(columns),
        fmt="%.9g",
        delimiter=",",
        comments="",
        header="time_s,ground_m_s2,top_m_s2,top_m",
    )


run(main, globals())
