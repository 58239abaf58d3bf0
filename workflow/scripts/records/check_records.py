"""Table of what is wrong or doubtful with each record of a run (tables/records_check.csv).

Faults and warnings are printed too; the table is written whatever they are.
"""

import sys

import pandas as pd
from rocking.records import DEFAULT_SEED, read_specs, read_table, surrogates_for
from rocking.records.check import check_records
from rocking.runtime.script import run
from rocking.tables import write_table

FACTS = ("dt_s", "duration_s", "pga_g", "pgv_cm_s", "offset_percent", "drift_m", "factor")


def main(job):
    p = job.params
    rows = read_table(p.table)
    names = getattr(p, "records", None) or list(rows)
    specs = surrogates_for(p.table)
    findings = check_records(
        [rows[name] for name in names],
        baseline=getattr(p, "baseline", "none"),
        seed=getattr(p, "seed", DEFAULT_SEED),
        specs=read_specs(specs) if specs else None,
        draw=True,
        cache=getattr(p, "cache", None),
        reach_g=getattr(p, "reach_g", None),
    )
    table = pd.DataFrame(findings)
    write_table(table, job.output[0], digits="%.4g")
    told = table[["record", *FACTS]].dropna(subset="pga_g").dropna(axis="columns", how="all")
    print(told.to_string(index=False, float_format="{:.3g}".format, na_rep=""), file=sys.stderr)
    for finding in findings:
        if finding.status != "ok":
            print(f"{finding.status}: {finding}", file=sys.stderr)
    counts = table["status"].value_counts()
    print(f"{len(table)} records: " + ", ".join(f"{n} {word}" for word, n in counts.items()))


run(main, globals())
