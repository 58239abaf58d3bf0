"""Collapse of W2, driven and two-way, under one record and before many buildings."""

import json
from pathlib import Path

import pandas as pd
from rocking.collapse import probability
from rocking.collapse.scan import Screen
from rocking.records import read_csv
from rocking.records.floors import floor_columns
from rocking.runtime.script import run
from rocking.tables import write_table

COLUMNS = ["record", "direction", "mass_ratio", "period_s", "damping_ratio"]
COLUMNS += [*(f"pga_{name}_g" for name in ("collapse", "median", "all", "max")), "runs_planar"]
MEMBERS = 5  # amplitudes behind a probability


def buildings(smdof, settings):
    """(T1, ζ) of the map: all periods at the configured damping, further dampings at its T1."""
    cases = [(period, smdof["damping_ratio"]) for period in settings["periods_s"]]
    cases += [(smdof["period_s"], damping) for damping in settings["damping_ratios"]]
    return list(dict.fromkeys(cases))


def main(job):
    scene = json.loads(Path(job.input.scene).read_text())
    settings, record = job.params.assumptions, read_csv(job.input.record)
    facade, chain = scene["facade"], scene["smdof"]
    own_mass = facade["density_kg_m3"] * facade["height_m"] * facade["thickness_m"]
    own_mass *= facade["width_m"]
    ida = {**scene["ida"], "level_ratio": settings["level_ratio"]}
    spread, rows = 0.5 * (MEMBERS - 1) * settings["level_ratio"], []
    for period, damping in buildings(chain, settings):
        smdof = {**chain, "period_s": period, "damping_ratio": damping}
        motion = floor_columns(record, smdof)
        for direction in job.params.directions:
            for ratio in (0.0, *settings["mass_ratios"]):
                wall = {**scene["return_wall"], "building_mass_kg": own_mass / (ratio or 1.0)}
                model = "W2m" if ratio else "W2"
                case = {**scene, "smdof": smdof, "return_wall": wall, "model": model}
                scan = Screen(case, *motion, direction).climb(ida)
                found = probability.summary(scan, scan, (), spread)
                named = (record.name, direction, ratio, period, damping)
                rows.append([*named, *(found[name] for name in COLUMNS[5:])])
    table = pd.DataFrame(rows, columns=COLUMNS)
    write_table(table, job.output[0])


run(main, globals())
