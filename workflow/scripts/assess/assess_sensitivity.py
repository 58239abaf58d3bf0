"""Sensitivity of the dynamic answer: collapse PGA of changed façades over the stated one's."""

import json

import numpy as np
import pandas as pd
from rocking import Case, Motion, Variant
from rocking.collapse.quick import crossings
from rocking.runtime.script import run
from rocking.tables import write_table

VARIED = {  # factors by key
    "facade.thickness_m": (0.95, 1.05),
    "facade.e_mpa": (0.5, 2.0),
    "smdof.period_s": (0.75, 1.25),
    "smdof.damping_ratio": (0.6, 1.4),
    "beta_s": (0.5, 2.0),
}
VARIANTS = [
    Variant(f"{key} times {factor:g}", factors={key: factor}, about={"key": key, "factor": factor})
    for key, factors in VARIED.items()
    for factor in factors
]
RECORDS = 8  # spread over the run's


def main(job):
    case, settings = Case.read(job.input.scene), json.loads(job.params.settings)
    names, limit = job.params.records, {"max_pga_g": settings["ida.max_pga_g"]}
    direction = settings["directions"][0]
    how = {key: settings[key] for key in ("baseline", "seed", "vertical_motion")}
    rows = []
    for name in names[:: max(1, len(names) // RECORDS)][:RECORDS]:
        motion = Motion.named(name, job.params.table, **how)

        def half(variant, motion=motion):
            found = crossings(case.varied(variant), motion, direction, limit)
            return found["pga_median_g"]

        key = {"model": case.model, "record": name, "pga_stated_g": half(Variant())}
        rows += [{**key, **one.about, "pga_changed_g": half(one)} for one in VARIANTS]
    names = ["model", "record", "key", "factor", "pga_stated_g", "pga_changed_g"]
    table = pd.DataFrame(rows, columns=names)
    ratio = table["pga_changed_g"] / table["pga_stated_g"]
    write_table(table.assign(ratio=ratio.where(np.isfinite(ratio))), job.output[0])


run(main, globals())
