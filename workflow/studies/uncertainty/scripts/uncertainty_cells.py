"""Cells of the design that YADE runs, below and above their collapse, with the planar answer."""

import json
from pathlib import Path

import numpy as np
from rocking import Case, Motion, collapse_curve
from rocking.records import read_csv
from rocking.runtime.script import run
from rocking.tables import read_tables, write_json
from studies.uncertainty import design, sampling

from yade_scripts.commands.search import DIGITS

SHARES = (0.85, 1.2)  # of the PGA of 10 % and of 50 % collapse


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
    cells = {}
    for k, i in enumerate(sorted(rng.choice(len(table), count, replace=False)), 1):
        row = table.iloc[i]
        case = cases[row["model"]]
        case = case.varied(sampling.variant(case, factors.iloc[row["sample"]].to_dict()))
        motion = Motion(read_csv(paths[row["record"]]))
        levels = (SHARES[0] * row["pga_p10_g"], SHARES[1] * row["pga_median_g"])
        levels = [round(float(g), DIGITS) for g in levels]
        how = {"search": "list", "settings": {"pga_g": levels}}
        found = collapse_curve(case, motion, row["direction"], **how).table
        time_s, columns = motion.columns(case)
        cells[f"cell{k}"] = {
            **{key: row[key] for key in ("record", "direction", "model")},
            "sample": int(row["sample"]),
            "pga_g": levels,
            "planar": found[["d_over_b", "status"]].to_dict("list"),
            "scene": case.sections,
            "motion": {
                "time_s": time_s.tolist(),
                "columns": {name: values.tolist() for name, values in columns.items()},
            },
        }
    write_json(job.output[0], {"cases": cells}, indent=None)


run(main, globals())
