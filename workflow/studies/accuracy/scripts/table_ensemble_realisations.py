"""Realisations that a stable median needs, and the planar solver's median where they spread."""

import numpy as np
from reference_solver.facade import ensemble_peaks
from rocking.collapse.ida import by_curve
from rocking.runtime.script import run
from rocking.tables import read_json, write_table
from studies.accuracy.ensemble import realisations_needed

TOLERANCE = 0.05  # half width of the interval about the median of d/b
LEVELS = 2
COLUMNS = ["model", "record", "direction", "pga_g", "realisations", "d_over_b_median"]
COLUMNS += ["d_over_b_std", "realisations_needed", "d_over_b_median_reference"]


def compare(scenes, motions, table):
    """Planar median by PGA: where the spread is widest and most stand, at most LEVELS."""
    stood = table.groupby("pga_g")["collapsed"].mean()
    usable = table[table["pga_g"].isin(stood.index[stood < 0.3])]
    spread = usable.groupby("pga_g")["d_over_b"].std().nlargest(LEVELS)
    found = {}
    for pga_g in spread.index:
        mine = usable[usable["pga_g"] == pga_g]
        row = mine.iloc[0]
        values = ensemble_peaks(
            scenes[row["model"]],
            motions[row["record"]],
            row["direction"],
            float(pga_g),
            mine["amplitude_factor"],
        )
        found[pga_g] = float(np.median(values))
    return found


def main(job):
    motions = dict(zip(job.params.records, job.input.motions, strict=True))
    scenes = {scene["model"]: scene for scene in map(read_json, job.input.cases)}
    rows = []
    for key, table in by_curve(job.input.ensembles).items():
        reference = compare(scenes, motions, table)
        for pga_g, part in table.groupby("pga_g"):
            values = part["d_over_b"].dropna().clip(upper=1.0)
            needed = realisations_needed(values, TOLERANCE, 1) if len(values) else None
            known = len(values), values.median(), values.std(), needed, reference.get(pga_g)
            rows.append((*key, pga_g, *known))
    write_table(rows, job.output[0], COLUMNS)


run(main, globals())
