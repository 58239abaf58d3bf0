"""How often the code's kinematic and dynamic check of one façade disagree, and which way."""

import json

import pandas as pd
from rocking.runtime.script import run
from rocking.tables import write_table

CHECKS = ("kinematic_fc", "kinematic_fc1", "kinematic_ground_fc")


def main(job):
    facts, parts = json.loads(job.params.runs), []
    for (name, about), path in zip(facts.items(), job.input.levels, strict=True):
        known = {key: about[key] for key in ("height_m", "slenderness", "period_s")}
        parts.append(pd.read_csv(path).assign(run=name, **known))
    table = pd.concat(parts, ignore_index=True)
    write_table(table, job.output.levels)
    rows = []
    for model, part in table.groupby("model", sort=False):
        for check in CHECKS:
            passes, holds = part[check] == 1, part["dynamic"] == 1
            rows.append(
                {
                    "model": model,
                    "check": check,
                    "cases": len(part),
                    "facades": part["run"].nunique(),
                    "both_pass": int((passes & holds).sum()),
                    "both_fail": int((~passes & ~holds).sum()),
                    "kinematic_alone_passes": int((passes & ~holds).sum()),
                    "dynamic_alone_passes": int((~passes & holds).sum()),
                }
            )
    write_table(rows, job.output.table)


run(main, globals())
