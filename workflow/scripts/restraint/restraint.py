"""Collapse intensities of one curve against a roof's load and friction, and what YADE confirms."""

import json
from pathlib import Path

from rocking.runtime.script import run
from rocking.studies import restraint
from rocking.tables import write_table

from yade_scripts.model import floor_motions


def main(job):
    scene = json.loads(Path(job.input.scene).read_text())
    settings = json.loads(job.params.settings)["restraint"]
    ensemble = {key: scene["ensemble"][key] for key in ("members", "amplitude_spread")}
    w, motion = job.wildcards, floor_motions.read(job.input.motion)
    found = restraint.table(scene, *motion, w.direction, settings, {**scene["ida"], **ensemble})
    plan = {"cases": restraint.to_confirm(scene, found)}
    for place, name in enumerate(("model", "record", "direction")):
        found.insert(place, name, getattr(w, name))
    write_table(found, job.output.table)
    Path(job.output.plan).write_text(json.dumps(plan, indent=1, sort_keys=True) + "\n")


run(main, globals())
