"""Periods and effective masses of both models (tables/building_modes.csv)."""

import pandas as pd
from rocking.runtime.script import run
from rocking.tables import write_table
from studies.building.case import PAPER_PERIODS_S, translation_mode, twist_mode
from studies.building.modes import DIRECTIONS, Modes

ROWS = 12  # modes listed for each model


def main(job):
    rows = []
    for model, path in zip(("CBDEM", "SBDEM"), (job.input.cbdem, job.input.sbdem), strict=True):
        modes = Modes.load(path)
        paper = {
            (translation_mode(modes), "y"): PAPER_PERIODS_S[model, "y"],
            (twist_mode(modes), "rz"): PAPER_PERIODS_S[model, "rz"],
        }
        last = max(ROWS, *(mode + 1 for mode, _ in paper))
        for j in range(min(last, len(modes.omega))):
            for k, direction in enumerate(DIRECTIONS):
                known = paper.get((j, direction)) if job.params.paper else None
                rows.append(
                    (model, j + 1, direction, modes.period_s[j], modes.effective_ratio[j, k], known)
                )
    columns = ("model", "mode", "direction", "period_s", "effective_mass_ratio", "period_paper_s")
    table = pd.DataFrame(rows, columns=list(columns))
    table["effective_mass_ratio"] = table["effective_mass_ratio"].round(6)
    table["period_s"] = table["period_s"].round(6)
    write_table(table, job.output[0], digits="%.9g")


run(main, globals())
