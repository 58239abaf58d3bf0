"""Error against the converged reference and speed of every run (tables/speed_accuracy.csv)."""

import pandas as pd
import yaml
from rocking.accuracy.fidelity import fidelity_table
from rocking.accuracy.study import TABLE_COLUMNS, errors
from rocking.runtime.script import run

HEADER = (
    "# Worst measured error in d/b by nodes and step, cheapest first (rocking/accuracy.py:\n"
    "# fidelity_table). Written by `snakemake accuracy` to accuracy/fidelity.yaml of its run.\n"
)


def main(job):
    runs = pd.concat([pd.read_csv(path) for path in job.input.runs], ignore_index=True)
    reference = pd.read_csv(job.input.reference)
    ensemble = job.params.ensemble
    threshold = ensemble["sensitivity_threshold"]
    table = errors(runs, reference, threshold)
    table["model"] = table["scene"].str.split().str[0]
    trusted = threshold / ensemble["sensitivity_perturbation"]
    fidelity = fidelity_table(table, trusted, job.params.fewest_nodes)
    table = table.sort_values(["scene", "method", "nodes", "dt_over_dt_crit"])
    table[list(TABLE_COLUMNS)].to_csv(
        job.output.table, index=False, float_format="%.6g", lineterminator="\n"
    )
    with open(job.output.fidelity, "w") as handle:
        handle.write(HEADER)
        yaml.safe_dump(fidelity, handle, sort_keys=True, default_flow_style=None)


run(main, globals())
