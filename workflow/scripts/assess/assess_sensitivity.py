"""Sensitivity of the dynamic answer: collapse PGA of changed façades over the stated one's.

Of the mechanism with the least median PGA of half collapse.
"""

import json
from functools import partial

import numpy as np
import pandas as pd
from rocking import Case, Motion, Variant
from rocking.assessment.shaken import WHOLE_PART, cases
from rocking.collapse.quick import crossings
from rocking.collapse.varied import collapses
from rocking.records import load_as
from rocking.runtime.script import run
from rocking.tables import write_table

from yade_scripts.model.rest import DoesNotStandError

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
COLUMNS = ["part", "model", "record", "key", "factor", "pga_stated_g", "pga_changed_g"]
RECORDS = 8  # curves, spread over the run's
BELOW = 0.5  # of the stated façade's half collapse: where the climb of a changed one begins
CLEAR = 1.1  # of that start; a collapse no higher is sought again from the usual start


def half_collapse(case, motion, direction, max_pga_g, stated_g):
    """PGA of half collapse of a changed façade [g], sought from below that of the stated one.

    0 of one that does not stand at rest.
    """
    start, limit, found = BELOW * stated_g, {"max_pga_g": max_pga_g}, np.nan
    known = np.isfinite(stated_g)
    try:
        if known:
            near = crossings(case, motion, direction, {**limit, "from_g": start})
            found = near["pga_median_g"]
        if not known or found < CLEAR * start:
            found = crossings(case, motion, direction, limit)["pga_median_g"]
    except DoesNotStandError:
        found = 0.0
    return {"pga_stated_g": stated_g, "pga_changed_g": found}


def main(job):
    case, settings = Case.read(job.input.case), json.loads(job.params.settings)
    most = settings["ida.max_pga_g"]
    known = pd.concat(
        [pd.read_csv(job.input.collapse).assign(part=WHOLE_PART), pd.read_csv(job.input.parts)]
    )
    part = known.fillna({"pga_median_g": np.inf}).groupby("part")["pga_median_g"].median().idxmin()
    case = {row.part: own for row, own in cases(case, pd.read_csv(job.input.shaken))}[part]
    known = known[known["part"] == part]
    rows = []
    for one in known.iloc[:: max(1, len(known) // RECORDS)][:RECORDS].itertuples():
        motion = Motion(load_as(settings, one.record, job.params.table))
        find = partial(half_collapse, max_pga_g=most, stated_g=float(one.pga_median_g))
        found = collapses([case], motion, [one.direction], find, VARIANTS)
        rows += [{"part": part, **row} for row in found]
    table = pd.DataFrame(rows, columns=COLUMNS)
    ratio = table["pga_changed_g"] / table["pga_stated_g"]
    write_table(table.assign(ratio=ratio.where(np.isfinite(ratio))), job.output[0])


run(main, globals())
