"""Top motion of a building under one record by modal superposition (building/history_….csv)."""

import pandas as pd
from rocking.records import read_csv
from rocking.runtime.script import run
from rocking.tables import write_table
from studies.building.case import fitted_model, translation_mode
from studies.building.history import mass_damping_rate, modal_history
from studies.building.modes import Modes


def main(job):
    settings = dict(job.params.building)
    modes = Modes.load(job.input.modes)
    building = fitted_model(settings, job.input.plan, job.input.fit, job.wildcards.building)
    record = read_csv(job.input.record)
    rate = mass_damping_rate(modes.omega[translation_mode(modes)], settings["damping_ratio"])
    top = building.scene.index(building.scene.monitor)
    history = modal_history(modes, [top], record.acceleration_m_s2, record.dt_s, rate)
    columns = {
        "time_s": history.time_s,
        "ground_m_s2": history.ground_m_s2,
        "top_m_s2": history.acceleration_m_s2[0],
        "top_m": history.displacement_m[0],
    }
    write_table(pd.DataFrame(columns), job.output[0], digits="%.9g")


run(main, globals())
