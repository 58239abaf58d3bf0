"""Sensitivity of the dynamic answer: collapse PGA of changed façades over the stated one's."""

import copy
import json
from pathlib import Path

import numpy as np
import pandas as pd
from rocking.assessment.collapse import collapse_pga
from rocking.records import load
from rocking.runtime.script import run
from rocking.tables import write_table

VARIED = (  # section, key, factors
    ("facade", "thickness_m", (0.95, 1.05)),
    ("facade", "e_mpa", (0.5, 2.0)),
    ("smdof", "period_s", (0.75, 1.25)),
    ("smdof", "damping_ratio", (0.6, 1.4)),
    ("", "beta_s", (0.5, 2.0)),
)
RECORDS = 8  # spread over the run's


def main(job):
    scene = json.loads(Path(job.input.scene).read_text())
    settings = json.loads(job.params.settings)
    names, limit = job.params.records, settings["ida.max_pga_g"]
    every = names[:: max(1, len(names) // RECORDS)][:RECORDS]
    direction = settings["directions"][:1]
    how = {key: settings[key] for key in ("baseline", "seed", "vertical_motion")}
    rows = []
    for name in every:
        record = load(name, job.params.table, **how)
        cases = [("as stated", 1.0, scene)]
        for section, key, factors in VARIED:
            for factor in factors:
                changed = copy.deepcopy(scene)
                place = changed[section] if section else changed
                place[key] *= factor
                cases.append((f"{section}.{key}".lstrip("."), factor, changed))
        found = {}
        for key, factor, case in cases:
            ((_, _, half, _),) = collapse_pga(case, record, direction, limit)
            found[key, factor] = half
        base = found.pop(("as stated", 1.0))
        rows += [(scene["model"], name, k, f, base, v) for (k, f), v in found.items()]
    names = ["model", "record", "key", "factor", "pga_stated_g", "pga_changed_g"]
    table = pd.DataFrame(rows, columns=names)
    table["ratio"] = table["pga_changed_g"] / table["pga_stated_g"]
    table["ratio"] = table["ratio"].where(np.isfinite(table["ratio"]))
    write_table(table, job.output[0])


run(main, globals())
