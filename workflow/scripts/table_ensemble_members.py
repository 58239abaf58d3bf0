"""Members that a stable median needs, and the planar solver's median where members are many."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
from rocking.ensemble import members_needed
from rocking.reference import ensemble_peaks
from rocking.script import run

TOLERANCE = 0.05  # half width of the interval about the median of d/b


def compare(job, table, motions):
    """Planar median at the intensity whose spread is widest, of those that mostly stand."""
    stood = table.groupby("pga_g")["collapsed"].mean()
    usable = table[table["pga_g"].isin(stood.index[stood < 0.3])]
    if usable.empty:
        return None
    spread = usable.groupby("pga_g")["d_over_b"].std()
    pga_g = float(spread.idxmax())
    mine = usable[usable["pga_g"] == pga_g]
    row = mine.iloc[0]
    scene = json.loads(Path(job.input.scene).read_text())
    values = ensemble_peaks(scene, motions[row["record"]], row["direction"], pga_g,
                            mine["amplitude_factor"])  # fmt: skip
    return pga_g, float(np.median(values))


def main(job):
    motions = dict(zip(job.params.records, job.input.motions, strict=True))
    rows = []
    for path in job.input.ensembles:
        table = pd.read_csv(path)
        if table.empty:
            continue
        reference = None
        if table.iloc[0]["model"] == "W2":
            reference = compare(job, table, motions)
        for pga_g, part in table.groupby("pga_g"):
            values = part["d_over_b"].dropna().clip(upper=1.0)
            first = part.iloc[0]
            same = reference is not None and reference[0] == pga_g
            rows.append({
                "model": first["model"], "record": first["record"],
                "direction": first["direction"], "pga_g": pga_g, "members": len(values),
                "d_over_b_median": values.median(), "d_over_b_std": values.std(),
                "members_needed": members_needed(values, TOLERANCE, 1) if len(values) else None,
                "d_over_b_median_reference": reference[1] if same else None,
            })  # fmt: skip
    columns = ["model", "record", "direction", "pga_g", "members", "d_over_b_median",
               "d_over_b_std", "members_needed", "d_over_b_median_reference"]  # fmt: skip
    pd.DataFrame(rows, columns=columns).to_csv(
        job.output[0], index=False, float_format="%.6g", lineterminator="\n"
    )


run(main, globals())
