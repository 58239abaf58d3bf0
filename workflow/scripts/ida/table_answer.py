"""The run's answer: a row a model over all its motions, its curves, and what YADE's runs say."""

import pandas as pd
from rocking.collapse import answer
from rocking.collapse.ida import by_curve, read_curve
from rocking.collapse.probability import KEY
from rocking.runtime.script import run
from rocking.tables import read_frame, together, write_table

from yade_scripts.model.registry import MODELS

CHECKED = [*KEY, "pga_g", "fell", "foretold"]


def main(job):
    p = job.params
    scans, curves = by_curve(job.input.scans), by_curve(job.input.ida, read_curve)
    collapse = read_frame(job.input.collapse)
    tables = dict(list(read_frame(job.input.probability).groupby(KEY)))
    for key in curves.keys() - scans.keys():  # YADE's runs alone
        tables[key] = answer.of_runs(curves[key])
    checks = [
        answer.told_by_yade(scans[key], curves[key]).assign(**dict(zip(KEY, key, strict=True)))
        for key in curves
        if key in scans
    ]
    checked = together(checks) if checks else pd.DataFrame(columns=CHECKED)
    rows, shares, at_g = [], [], answer.grid(tables.values())
    for model in p.models:
        of_model = [table for key, table in tables.items() if key[0] == model]
        counts = len(p.stations), len({*p.stations.values()})
        mine = collapse[collapse["model"] == model], checked[checked["model"] == model]
        rows.append(answer.row(model, MODELS[model].moved, *counts, of_model, *mine))
        shares.append(answer.shares(of_model, at_g).assign(model=model))
    write_table(rows, job.output.answer, answer.COLUMNS, digits="%.4f")
    write_table(together(shares), job.output.curves, ["model", *answer.SHARED], digits="%.4f")
    write_table(checked, job.output.checked, CHECKED, digits="%.4f")


run(main, globals())
