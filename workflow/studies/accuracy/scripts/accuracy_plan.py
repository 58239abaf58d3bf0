"""Histories of the accuracy study with their converged answer, and the runs of YADE they get."""

import pandas as pd
from rocking.runtime.script import run
from rocking.tables import read_json, write_json, write_table
from studies.accuracy.errors import charted, plan_runs
from studies.accuracy.histories import COLUMNS, PeakSolver, half, histories, sampled

from yade_scripts.model import floor_motions

TRUSTED = 10.0  # change of d/b over that of amplitude up to which a history repeats


def main(job):
    settings = job.params.accuracy
    limits = {**settings, "trusted": TRUSTED, "max_pga_g": job.params.max_pga_g}
    paths = dict(zip(settings["models"], job.input.cases, strict=True))
    scenes = {model: read_json(path) for model, path in paths.items()}
    motions = dict(zip(job.params.records, job.input.motions, strict=True))
    rows = []
    for number, (record, path) in enumerate(motions.items()):
        motion = floor_motions.read(path)
        for model, scene in scenes.items():
            for direction in settings["directions"]:
                labels = {"half": half(number), "model": model, "record": record}
                solver = PeakSolver(scene, *motion, direction)
                rows += histories(solver, {**labels, "direction": direction}, limits)
    table = pd.DataFrame(rows)[list(COLUMNS)]
    write_table(table, job.output.histories)
    cases = sampled(table, settings["histories"])
    if not len(cases):
        raise ValueError("accuracy: no history of these records repeats; take more records")
    plan = {
        "scenes": paths,
        "motions": motions,
        "cases": cases[["case", "model", "record", "direction", "pga_g"]].to_dict("records"),
        "charted": sorted(charted(cases, settings["chart_histories"])),
        "runs": plan_runs(cases, settings, scenes),
    }
    write_json(job.output.plan, plan)


run(main, globals())
