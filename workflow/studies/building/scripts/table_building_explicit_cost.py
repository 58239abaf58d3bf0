"""Cost of the explicit run against brick size (tables/building_explicit_cost.csv)."""

import numpy as np
import pandas as pd
from rocking.runtime.script import run
from rocking.tables import read_json, write_table


def main(job):
    rows = []
    for coarsening, path in zip(job.params.coarsenings, job.input.cost, strict=True):
        cost = read_json(path)
        rows.append({"coarsening": coarsening, **cost})
    table = pd.DataFrame(rows).sort_values("coarsening", ascending=False)
    table["step_cpu_s"] = table["run_cpu_s"] / table["steps"]
    table["cpu_s_per_simulated_s"] = table["step_cpu_s"] / table["step_s"]
    for value in ("cpu_s_per_simulated_s", "memory_mb"):  # exponent over the number of blocks
        growth = np.log(table[value]).diff() / np.log(table["blocks"]).diff()
        table[f"{value.partition('_')[0]}_growth"] = growth
    write_table(table, job.output[0])


run(main, globals())
