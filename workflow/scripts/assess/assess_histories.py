"""Histories of one model under the motions of the code's dynamic check, and its verdict."""

import json

import pandas as pd
from rocking.assessment.code_checks import mechanism_of
from rocking.assessment.dynamic_check import COLUMNS, histories, limits_of, verdict
from rocking.records import load_as
from rocking.runtime.script import run
from rocking.tables import read_json, write_table


def main(job):
    scene = read_json(job.input.scene)
    settings = json.loads(job.params.settings)
    motions = pd.read_csv(job.input.motions)
    parts = []
    for row in motions.itertuples():
        record = load_as(settings, row.record, job.params.table)
        for direction in settings["directions"]:
            realisations = settings["assessment"]["dynamic_realisations"]
            parts.append(histories(scene, record, direction, [row.pga_g], realisations))
    if not parts:
        write_table([], job.output.histories, COLUMNS)
        write_table([], job.output.verdict, ["model"])
        return
    table = pd.concat(parts, ignore_index=True)
    write_table(table, job.output.histories)
    whole = mechanism_of({**scene, "assessment": settings["assessment"]})
    found = verdict(table, limits_of(whole.mechanism), settings["seed"])
    row = {"model": scene["model"], **found}
    write_table([row], job.output.verdict)


run(main, globals())
