"""Periods and cost against brick size, with growth rates (tables/building_convergence.csv)."""

import numpy as np
import pandas as pd
from rocking.runtime.script import run
from rocking.tables import read_json, write_table


def main(job):
    table = pd.DataFrame([read_json(path) for path in job.input.cost]).sort_values(
        ["model", "coarsening"], ascending=[True, False]
    )
    for value in ("cpu_s", "memory_mb"):  # exponent of the growth with the number of bricks
        table[f"{value.rpartition('_')[0]}_growth"] = table.groupby("model", group_keys=False)[
            value
        ].transform(
            lambda column: np.log(column).diff() / np.log(table.loc[column.index, "bricks"]).diff()
        )
    table["period_y_change"] = table.groupby("model")["period_y_s"].pct_change()
    write_table(table, job.output[0])


run(main, globals())
