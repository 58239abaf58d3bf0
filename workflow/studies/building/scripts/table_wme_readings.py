"""Table 2 under every reading of its text (tables/wme_readings.csv, tables/wme_lowest.csv)."""

import numpy as np
import pandas as pd
from rocking.records import read_csv
from rocking.runtime.script import run
from rocking.tables import write_table
from studies.building.case import fitted_model, read_plan, translation_mode
from studies.building.comparison import PAPER_WME, QUANTITIES
from studies.building.history import mass_damping_rate, modal_history
from studies.building.modes import Modes
from studies.building.readings import errors, first_mode, highest_brick, readings


def main(job):
    settings = dict(job.params.building)
    plan = read_plan(job.input.plan)
    building = fitted_model(settings, job.input.plan, job.input.fit, "SBDEM")
    modes = Modes.load(job.input.modes)
    left, right = plan.floors[0].walls
    top = building.scene.index(building.scene.monitor)
    points = {
        "roof": top,
        "left": highest_brick(building, left),
        "right": highest_brick(building, right),
    }
    ratio = settings["damping_ratio"]
    rate = mass_damping_rate(modes.omega[translation_mode(modes)], ratio)
    rows = []
    for name, path in zip(job.params.records, job.input.records, strict=True):
        record = read_csv(path)
        history = modal_history(
            modes, list(points.values()), record.acceleration_m_s2, record.dt_s, rate
        )
        ways = readings(settings["wme_longest_period_s"], settings["wme_highest_frequency_hz"])
        for title, way in ways.items():
            period = float(modes.period_s[first_mode(modes, way.period_of)])
            point = list(points).index(way.point)
            found = errors(history, point, record, period, ratio, way)
            for n, values in found.items():
                for quantity in QUANTITIES:
                    paper = PAPER_WME.get((quantity, name)) if job.params.paper else None
                    known = paper[n - 1] if paper else np.nan
                    rows.append((title, name, n, quantity, values[quantity], known))
    names = ["reading", "record", "n_dof", "quantity", "wme", "wme_paper"]
    table = pd.DataFrame(rows, columns=names)
    write_table(table, job.output.readings)
    lowest = []
    for key, part in table.groupby(["reading", "record", "quantity"], sort=False):
        known = part["wme_paper"].notna().all()
        lowest.append(
            (
                *key,
                part.loc[part["wme"].idxmin(), "n_dof"],
                part.loc[part["wme_paper"].idxmin(), "n_dof"] if known else "",
                part["wme"].min(),
                (part["wme"] - part["wme_paper"]).abs().mean() if known else np.nan,
            )
        )
    columns = ["reading", "record", "quantity", "n_lowest", "n_lowest_paper", "wme_lowest"]
    write_table(lowest, job.output.lowest, [*columns, "mean_difference"])


run(main, globals())
