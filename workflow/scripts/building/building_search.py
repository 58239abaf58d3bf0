"""Variants of the case study against the study's four periods (tables/building_search.csv).

A Sobol sample of the ranges, then for each reading a local refinement from its best variant.
"""

from dataclasses import asdict

import numpy as np
import pandas as pd
from rocking.building.case import read_plan
from rocking.building.search import READINGS, evaluate, refine, sample, variant
from rocking.runtime.script import run
from rocking.tables import write_table


def main(job):
    settings, search = dict(job.params.building), dict(job.params.search)
    plan = read_plan(job.input.plan)
    rows = []

    def try_out(place, stage):
        chosen = variant(search, place)
        found = evaluate(chosen.settings(settings), chosen.plan(plan), search["coarsening"])
        number = rows[-1]["variant"] + 1 if rows else 1
        for reading, row in found.items():
            rows.append(
                {"variant": number, "stage": stage, "reading": reading, **asdict(chosen), **row}
            )
            places[number] = place
        return found

    places: dict[int, np.ndarray] = {}
    for place in sample(search["samples"], search["seed"]):
        try_out(place, "sample")
    table = pd.DataFrame(rows)
    for reading in READINGS:
        mine = table[table["reading"] == reading]
        if mine.empty:
            continue

        def score(place, reading=reading):
            found = try_out(place, f"refined by {reading}").get(reading)
            return found["rms_error_s"] if found else 1.0

        best = mine.loc[mine["rms_error_s"].idxmin(), "variant"]
        refine(score, places[best], search["refinements"])
    write_table(rows, job.output[0])


run(main, globals())
