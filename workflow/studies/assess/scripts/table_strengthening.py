"""Least tie of every curve and height with YADE's word on it, and the share of all that stands."""

import json

import numpy as np
import pandas as pd
from rocking.runtime.script import run
from rocking.tables import read_frame, write_table
from studies.assess.strengthening import together


def confirmed(table, force_kn):
    """Share of YADE's realisations that fell at a force, and their number."""
    mine = table[np.isclose(table["force_kn"], force_kn, rtol=1e-4)]
    mine = mine[mine["status"] != "failed"]
    return (mine["collapsed"].mean() if len(mine) else np.nan), len(mine)


def main(job):
    settings = json.loads(job.params.settings)["strengthening"]
    rows = []
    for path, yade_path in zip(job.input.least, job.input.yade, strict=True):
        yade = read_frame(yade_path)
        for row in read_frame(path).to_dict("records"):
            here = yade[np.isclose(yade["height_m"], row["height_m"], rtol=1e-4)]
            share, realisations = confirmed(here, row["force_kn"])
            rows.append({**row, "probability_yade": share, "realisations_yade": realisations})
    table = pd.DataFrame(rows)
    table.insert(3, "pga_g", settings["pga_g"])
    table.insert(4, "accepted", settings["probability"])
    write_table(table, job.output.table)
    write_table(together(table), job.output.share)


run(main, globals())
