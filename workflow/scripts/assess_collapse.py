"""PGA of 10 and 50 % collapse of one model under every motion of the run, by the planar solver."""

import json
from pathlib import Path

import pandas as pd
from rocking.assessment.collapse import START, Climb
from rocking.records import G_M_S2, load
from rocking.runtime.script import run

from smdof.chain import floor_motions
from yade_scripts.model import models, registry


def main(job):
    scene = json.loads(Path(job.input.scene).read_text())
    settings = json.loads(job.params.settings)
    walls = registry.model(scene["model"]).walls
    start = START[walls] * models.static_multiplier(scene)
    chain, limit = scene["smdof"], settings["ida.max_pga_g"]
    rows = []
    for name in job.params.records:
        record = load(
            name, job.params.table, baseline=settings["baseline"], seed=settings["seed"]
        )
        motion = floor_motions(
            record.acceleration_m_s2,
            record.dt_s,
            chain["n_dof"],
            chain["period_s"],
            chain["damping_ratio"],
            chain["damping_model"],
            tail_s=chain["tail_s"],
        )
        columns = {"ground": motion.ground_m_s2}
        columns |= {f"floor{j + 1}": row for j, row in enumerate(motion.floors_m_s2)}
        peak = float(abs(motion.ground_m_s2).max()) / G_M_S2
        for direction in settings["directions"]:
            climb = Climb(scene, motion.time_s, columns, direction)
            low, half = climb.crossings(limit, start)
            rows.append((scene["model"], name, direction, peak, low, half, limit, climb.runs))
    names = ("model", "record", "direction", "record_pga_g", "pga_p10_g", "pga_median_g")
    table = pd.DataFrame(rows, columns=[*names, "pga_max_g", "runs_planar"])
    table.to_csv(job.output[0], index=False, float_format="%.6g", lineterminator="\n")


run(main, globals())
