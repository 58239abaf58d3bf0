"""Parts of the scatter of collapse, sensitivities, and fragility with and without them."""

import json

import numpy as np
import pandas as pd
from rocking.runtime.script import run
from rocking.tables import read_tables, write_table
from studies.shared import fragility
from studies.uncertainty import parts, sampling

NARROW = 1e-3  # half width of the bracket of a collapse that is known, over it


def curves(table, of_parts):
    """Median and dispersion: of all cells by likelihood, of the parts one after the other."""
    mine = table[(table["replicate"] == 0) & (table["sample"] > 0)]
    fit = fragility.fit(*fragility.brackets_about(mine["pga_median_g"], mine["pga_max_g"], NARROW))
    beta = of_parts.set_index("part")["beta"]
    with_material = np.hypot(beta["motion"], beta["material"])
    rows = [
        ("motion", fit.median, beta["motion"]),
        ("motion and material", fit.median, with_material),
        ("all parts", fit.median, beta["total"]),
        ("all cells, by likelihood", fit.median, fit.dispersion),
    ]
    out = pd.DataFrame(rows, columns=["curve", "median_g", "dispersion"])
    return out.assign(n=len(mine), n_censored=int(mine["pga_median_g"].isna().sum()))


def main(job):
    settings = json.loads(job.params.settings)
    table = read_tables(job.input.tables)
    write_table(sampling.factors(settings).rename_axis("sample").reset_index(), job.output.samples)
    y, records, names = parts.cube(table)
    if len(records) < 3:
        raise ValueError(
            f"uncertainty: {len(records)} motions under which every cell collapses; expected 3 or "
            "more: raise ida.max_pga_g or uncertainty.motions"
        )
    confidence = settings["confidence"]
    of_parts = parts.table_of_parts(y, parts.numerical_variance(table), confidence)
    size = {"n_motions": y.shape[0], "n_samples": y.shape[1], "n_models": y.shape[2]}
    write_table(of_parts.assign(**size), job.output.parts)
    scores, rows = sampling.scores(settings), settings["parameters"]
    answers = {"all": y.mean(axis=2)} | {name: y[:, :, k] for k, name in enumerate(names)}
    tables = []
    for name, answer in answers.items():
        sensitivity = parts.sensitivities(scores, answer, confidence)
        sensitivity.insert(0, "model", name)
        sensitivity.insert(1, "parameter", [row["parameter"] for row in rows])
        for key in ("distribution", "spread", "source"):
            sensitivity[key] = [row[key] for row in rows]
        tables.append(sensitivity)
    write_table(pd.concat(tables), job.output.sensitivity)
    write_table(curves(table, of_parts), job.output.fragility)


run(main, globals())
