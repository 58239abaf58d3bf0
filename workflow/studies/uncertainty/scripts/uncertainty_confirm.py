"""Cells of the design below and above their collapse, by YADE beside the planar solver."""

import json
from pathlib import Path

import numpy as np
from rocking import Case, Motion, collapse_curve
from rocking.records import read_csv
from rocking.runtime.script import run
from rocking.tables import read_tables, write_table
from studies.uncertainty import design, sampling

from yade_scripts.commands.search import DIGITS

SHARES = (0.85, 1.2)  # of the PGA of 10 % and of 50 % collapse
COLUMNS = ["cell", "record", "direction", "model", "sample", "pga_g"]
COLUMNS += ["d_over_b_planar", "status_planar", "d_over_b_yade", "status_yade", "agrees"]


def main(job):
    settings = json.loads(job.params.settings)
    table = read_tables(job.input.tables)
    table = table[(table["replicate"] == 0) & (table["sample"] > 0)].dropna()
    cases = {}
    for path in job.input.cases:
        cases |= design.forms(Case.read(path), settings["bases"], job.input.law)
    paths = {Path(path).stem: path for path in job.input.records}
    factors = sampling.factors(settings)
    rng = np.random.default_rng(settings["seed"])
    count = min(settings["confirm"], len(table))
    rows = []
    for k, i in enumerate(sorted(rng.choice(len(table), count, replace=False)), 1):
        row = table.iloc[i]
        case = cases[row["model"]]
        case = case.varied(sampling.variant(case, factors.iloc[row["sample"]].to_dict()))
        motion = Motion(read_csv(paths[row["record"]]))
        levels = (SHARES[0] * row["pga_p10_g"], SHARES[1] * row["pga_median_g"])
        levels = [round(float(g), DIGITS) for g in levels]
        how = {"search": "list", "settings": {"pga_g": levels}}
        planar, yade = (
            collapse_curve(case, motion, row["direction"], solver=solver, **how).table
            for solver in ("planar", "yade")
        )
        known = [row[key] for key in ("record", "direction", "model", "sample")]
        for pga_g, by_planar, by_yade in zip(
            levels, planar.to_dict("records"), yade.to_dict("records"), strict=True
        ):
            both = [
                answer[key] for answer in (by_planar, by_yade) for key in ("d_over_b", "status")
            ]
            same = int(by_planar["status"] == by_yade["status"])
            rows.append((f"cell{k}", *known, pga_g, *both, same))
    write_table(rows, job.output[0], COLUMNS)


run(main, globals())
