"""Least tie of one curve: search, collapse intensities, and what YADE is to confirm."""

import json
from pathlib import Path

from rocking.runtime.script import run
from rocking.studies import strengthening
from rocking.tables import write_table

from yade_scripts.model import floor_motions


def main(job):
    scene = json.loads(Path(job.input.scene).read_text())
    settings = json.loads(job.params.settings)["strengthening"]
    given = (scene, *floor_motions.read(job.input.motion), job.wildcards.direction, settings)
    table = strengthening.search(*given)
    least = strengthening.least(table, settings["probability"])
    choice = strengthening.best(least)
    # where no tie holds, the chart is drawn for the highest row
    height = float(least["height_m"].max() if choice is None else choice["height_m"])
    ensemble = {key: scene["ensemble"][key] for key in ("members", "amplitude_spread")}
    curve = strengthening.curve(*given, {**scene["ida"], **ensemble}, height)
    about = [job.wildcards.model, job.wildcards.record, job.wildcards.direction]
    for frame, path in (
        (table, job.output.search),
        (least, job.output.least),
        (curve, job.output.curve),
    ):
        for place, name in enumerate(("model", "record", "direction")):
            frame.insert(place, name, about[place])
        write_table(frame, path)
    cases = [
        {
            "height_m": round(z, 6),
            "force_kn": round(force, 6),
            "pga_g": settings["pga_g"],
            "facade": strengthening.tied(scene, settings, z, force)["facade"],
        }
        for z, force in strengthening.to_confirm(table, choice)
    ]
    plan = json.dumps({"cases": cases}, indent=1, sort_keys=True)
    Path(job.output.plan).write_text(plan + "\n")


run(main, globals())
