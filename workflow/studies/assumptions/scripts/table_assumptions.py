"""Models side by side: collapse intensities, ratios to the reference, and the losses."""

import pandas as pd
from rocking.collapse import probability
from rocking.collapse.ida import curve_key, read_curve
from rocking.runtime.script import run
from rocking.tables import read_frame, read_json, write_table
from studies.assumptions import study as assumptions

from yade_scripts.lists import listed

SIDE = [f"pga_{name}_g" for name in assumptions.SIDE]
RATIOS = [f"ratio_{name}" for name in assumptions.SIDE]
COLUMNS = ["model", "record", "source", "direction", "method", "runs", *SIDE]
COLUMNS += ["reference", *RATIOS, "side"]


def curves(job, records):
    """Key, method, runs and intensities of every curve of these records."""
    p = job.params
    how = {"spread": p.spread, "slope": p.hazard_slope}
    for scan in map(read_frame, job.input.scans):
        key, intensities = curve_key(scan), assumptions.measured(scan, **how, planar=True)
        yield key, "planar", len(scan), intensities
    for curve in map(read_curve, job.input.bricks):
        key, intensities = curve_key(curve), assumptions.measured(curve, **how, planar=False)
        yield key, "YADE", len(curve), intensities
    for path in job.input.others:
        whole = read_frame(path)
        missing = {*probability.KEY, "pga_g", "probability", "realisations"} - set(whole.columns)
        if missing:
            raise ValueError(f"{path}: missing column(s) {listed(sorted(missing))}")
        for key, table in whole[whole["record"].isin(records)].groupby(probability.KEY):
            intensities = assumptions.from_probabilities(table, p.hazard_slope)
            yield key, "given", intensities["runs"], intensities


def main(job):
    facts = [read_json(path) for path in job.input.facts]
    source = {fact["name"]: fact["source"] for fact in facts}
    rows = []
    for key, method, runs, intensities in curves(job, source):
        named = dict(zip(probability.KEY, key, strict=True))
        side = {name: intensities[name] for name in SIDE}
        how = {"method": method, "runs": runs}
        rows.append({**named, "source": source[named["record"]], **how, **side})
    table = pd.DataFrame(rows)
    beside = assumptions.compared(table, job.params.reference)
    write_table(beside[COLUMNS], job.output.table, digits="%.4f")
    write_table(assumptions.losses(table), job.output.losses, digits="%.4f")
    whole = assumptions.pairs(table, job.params.reference)
    ratios = assumptions.spread_of(whole, RATIOS, ["model", "reference"])
    write_table(ratios, job.output.ratios, digits="%.4f")


run(main, globals())
