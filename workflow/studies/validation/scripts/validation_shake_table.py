"""A shake-table experiment in one table: measured, another code, both solvers; and its ratios."""

import math
from pathlib import Path

import numpy as np
import pandas as pd
from rocking.runtime.script import run
from rocking.tables import read_frame, read_json, write_table
from studies.shared.restitution import read_archive
from studies.validation import study as validation
from studies.validation.study import ALONE, PERCENTILES, SEQUENCE, STILL


def main(job):
    experiment = validation.read(Path(job.input.files[0]).parent)
    about = read_json(job.input.cases)
    planar = read_frame(job.input.planar, numbers=["run"])
    rows = []
    for (variant, run_, how), part in planar.groupby(["variant", "run", "how"], sort=False):
        values = part["peak_mm"].to_numpy()
        row = {"variant": variant, "run": run_, "how": how, "solver": "planar"}
        row |= {"peak_mm": values[0], "status": part["status"].iloc[0]}
        if how == ALONE:
            row["repeats"] = int(abs(values[1] / values[0] - 1.0) < STILL)
            row["members"], row["fell"] = len(part) - 2, int((part["status"] != "ok")[2:].sum())
            if len(part) > 2:
                ends = np.nan_to_num(values[2:], nan=np.inf)
                ends = np.percentile(ends, PERCENTILES, method="nearest")
                row |= {f"p{p}_mm": v for p, v in zip(PERCENTILES, ends, strict=True)}
        rows.append(row)
    for done in read_archive(job.input.histories):
        rows += list(of_yade(done, about))
    table = pd.DataFrame(rows).merge(pd.DataFrame(about["runs"]).drop(columns="motion"), on="run")
    table = table.merge(experiment.measured, on="run", how="left")
    table["ratio"] = table["peak_mm"] / table["measured_mm"]
    first = ["run", "record", "pga_g", "source", *experiment.measured.columns[1:]]
    table = table[[*first, *(name for name in table if name not in first)]]
    write_table(table, job.output.table, digits="%.5g")
    write_table(validation.summary(experiment, table), job.output.summary, digits="%.4g")


def of_yade(done, about):
    variant, _, what = done["id"].rpartition("|")
    row = {"variant": variant, "solver": "YADE"}
    if what != "sequence":
        thickness = about["variants"][variant]["facade"]["thickness_m"]
        ok = done["status"] == "ok"
        peak = 1e3 * thickness * done["peak_d_over_b"] if ok else math.nan
        yield {**row, "run": int(what), "how": ALONE, "peak_mm": peak, "status": done["status"]}
        return
    peaks_m = validation.peaks_of_spans(done["time_s"], done["d_m"], about["spans"], done["status"])
    for r, peak in zip(about["runs"], peaks_m, strict=True):
        status = "ok" if math.isfinite(peak) else done["status"]
        row |= {"run": r["run"], "how": SEQUENCE, "peak_mm": 1e3 * peak, "status": status}
        yield dict(row)


run(main, globals())
