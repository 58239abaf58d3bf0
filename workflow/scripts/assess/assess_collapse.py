"""PGA of 10 and 50 % collapse of one model under every motion of the run, by the planar solver."""

import json
from pathlib import Path

import pandas as pd
from rocking.assessment.collapse import collapse_pga
from rocking.records import load, measures
from rocking.runtime.script import run
from rocking.tables import write_table


def main(job):
    scene = json.loads(Path(job.input.scene).read_text())
    settings = json.loads(job.params.settings)
    limit = settings["ida.max_pga_g"]
    how = {key: settings[key] for key in ("baseline", "seed", "vertical_motion")}
    rows = []
    for name in job.params.records:
        record = load(name, job.params.table, **how)
        peak = measures(record)["pga_g"]
        for direction, low, half, runs in collapse_pga(
            scene, record, settings["directions"], limit
        ):
            rows.append((scene["model"], name, direction, peak, low, half, limit, runs))
    names = ("model", "record", "direction", "record_pga_g", "pga_p10_g", "pga_median_g")
    table = pd.DataFrame(rows, columns=[*names, "pga_max_g", "runs_planar"])
    write_table(table, job.output[0])


run(main, globals())
