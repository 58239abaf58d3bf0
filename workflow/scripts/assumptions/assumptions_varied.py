"""Collapse of a driven model under one record, one assumption after the other at another level."""

import json
from pathlib import Path

import pandas as pd
from rocking.calibration.beta import beta_for
from rocking.collapse import probability
from rocking.collapse.scan import Screen, scan_settings
from rocking.records import load, read_csv
from rocking.records.floors import floor_columns
from rocking.records.table import read_table
from rocking.runtime.script import run
from rocking.studies.assumptions import BASE, CAPACITY, Variant, variants, varied
from rocking.tables import write_table

COLUMNS = ["model", "record", "direction", "assumption", "level", *CAPACITY, "runs_planar"]


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
        motion = floor_columns(source, case["smdof"])
        settings = scan_settings(case)
        for direction in p.directions:
            scan = Screen(case, *motion, direction).scan(settings)
            found = probability.summary(scan, scan, (), settings["amplitude_spread"])
            named = (model, record.name, direction, variant.assumption, variant.level)
            rows.append([*named, *(found[name] for name in COLUMNS[5:])])
    found = pd.DataFrame(rows, columns=COLUMNS)
    write_table(found, job.output[0])


run(main, globals())
