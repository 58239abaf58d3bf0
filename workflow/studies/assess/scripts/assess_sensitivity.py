"""Sensitivity of the dynamic answer: collapse PGA of changed façades over the stated one's.

Of the mechanism with the least median PGA of half collapse. The other wall stands among what is
changed: the study's rigid block for a façade of courses, four courses for a block.
"""

import json

import numpy as np
import pandas as pd
from rocking import Case, Motion, Variant
from rocking.collapse.quick import crossings_of
from rocking.records import load_as
from rocking.runtime.script import run
from rocking.tables import read_frame, together, write_table
from studies.assess.shaken import cases, settled, settled_by
from studies.assess.sites import WHOLE_PART
from studies.assess.walls import WALL

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
OTHER_WALL = {False: {"facade.courses": 4, "facade.courses_growth": 1.5}}  # of a block
OTHER_WALL[True] = {"facade.courses": 0, "facade.courses_growth": 1.0}
COLUMNS = ["part", "model", "record", "key", "factor", "pga_stated_g", "pga_changed_g"]
RECORDS = 8  # curves, spread over the run's
BELOW = 0.5  # of the stated façade's half collapse: where the climb of a changed one begins
CLEAR = 1.1  # of that start; a collapse no higher is sought again from the usual start


def half_collapse(case, shaken, max_pga_g, stated_g):
    """PGA of half collapse of a changed façade [g], sought from below that of the stated one.

    By motion, as `stated_g`; 0 of one that does not stand at rest.
    """
    limit, changed_g = {"max_pga_g": max_pga_g}, np.full(len(shaken), np.nan)

    def sought(which, settings):
        some = crossings_of(case, [shaken[k] for k in which], settings, brief=True)
        changed_g[which] = [crossing["pga_median_g"] for crossing in some]

    known, start = np.isfinite(stated_g), BELOW * stated_g
    try:
        near = np.flatnonzero(known)
        sought(near, [{**limit, "from_g": start[k]} for k in near])
        sought(np.flatnonzero(~known | (changed_g < CLEAR * start)), limit)
    except DoesNotStandError:
        changed_g[:] = 0.0
    return changed_g


def main(job):
    settings, table = json.loads(job.params.settings), read_frame(job.input.shaken)
    whole = settled(Case.read(job.input.case), settled_by(settings))
    most = settings["ida.max_pga_g"]
    known = together(
        [read_frame(job.input.collapse).assign(part=WHOLE_PART), read_frame(job.input.parts)]
    )
    part = known.fillna({"pga_median_g": np.inf}).groupby("part")["pga_median_g"].median().idxmin()
    case = {row.part: part_case for row, part_case in cases(whole, table)}[part]
    known = known[(known["part"] == part) & known["pga_median_g"].notna()]
    known = known.iloc[:: max(1, len(known) // RECORDS)][:RECORDS]
    stated_g = known["pga_median_g"].to_numpy(float)
    motions = [Motion(load_as(settings, name, job.params.table)) for name in known["record"]]
    shaken = list(zip(motions, known["direction"], strict=True))
    about = {"part": part, "model": case.model, "record": known["record"].to_list()}
    tables = []
    changed = [(variant.about, case.varied(variant)) for variant in VARIANTS]
    courses = bool(whole["facade"]["courses"])
    try:
        other = whole.varied(OTHER_WALL[courses])
        other_case = next(part_case for row, part_case in cases(other, table) if row.part == part)
        changed.append(({"key": WALL[courses], "factor": 1.0}, other_case))
    except ValueError:  # no such façade in courses
        pass
    for of_variant, varied_case in changed:
        changed_g = half_collapse(varied_case, shaken, most, stated_g)
        said = {**about, **of_variant, "pga_stated_g": stated_g, "pga_changed_g": changed_g}
        tables.append(pd.DataFrame(said, index=range(len(shaken))))
    table = pd.concat(tables)[COLUMNS].sort_index(kind="stable")
    ratio = table["pga_changed_g"] / table["pga_stated_g"]
    write_table(table.assign(ratio=ratio.where(np.isfinite(ratio))), job.output[0])


run(main, globals())
