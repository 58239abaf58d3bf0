"""Collapse of W2 under one record, with one premise after the other at another level."""

import json
from pathlib import Path

import pandas as pd
from rocking.calibration.beta import beta_for
from rocking.curves import collapse
from rocking.curves.premises import BASE, CAPACITY, Variant, variants, varied
from rocking.records import load, read_csv
from rocking.records.table import read_table
from rocking.runtime.script import run
from rocking.screening.scan import Screen

from smdof.chain import floor_motions

COLUMNS = ["model", "record", "direction", "premise", "level", *CAPACITY, "runs_planar"]


def floors(record, smdof):
    """Floor motions of a record as time and columns."""
    motion = floor_motions(
        record.acceleration_m_s2,
        record.dt_s,
        smdof["n_dof"],
        smdof["period_s"],
        smdof["damping_ratio"],
        smdof["damping_model"],
        tail_s=smdof["tail_s"],
    )
    columns = {f"floor{j}": row for j, row in enumerate(motion.floors_m_s2, 1)}
    return motion.time_s, {"ground": motion.ground_m_s2, **columns}


def main(job):
    p = job.params
    scene = json.loads(Path(job.input.scene).read_text())
    stage = json.loads(Path(job.input.stage).read_text())
    record, model = read_csv(job.input.record), scene["model"]
    table = read_table(p.surrogates_table)
    known = table.get(record.name)
    twin = record.source != "surrogate" and known is not None and known.path is None
    rows = []
    for variant in (Variant("base", BASE, ""), *variants(model).values()):
        if variant.surrogate and not twin:
            continue
        case = varied(scene, variant, stage)
        case["beta_s"] = beta_for(case, job.input.law)
        source = record
        if variant.surrogate:
            source = load(record.name, p.surrogates_table, seed=p.seed)
        motion = floors(source, case["smdof"])
        settings = {**case["ida"], **case["ensemble"]}
        for direction in p.directions:
            scan = Screen(case, *motion, direction).scan(settings)
            found = collapse.summary(scan, scan, (), settings["amplitude_spread"])
            named = (model, record.name, direction, variant.premise, variant.level)
            rows.append([*named, *(found[name] for name in COLUMNS[5:])])
    found = pd.DataFrame(rows, columns=COLUMNS)
    found.to_csv(job.output[0], index=False, float_format="%.6g", lineterminator="\n")


run(main, globals())
