"""Least tie of one curve: search, collapse intensities, and what YADE is to confirm."""

import json
from pathlib import Path

from rocking import Case, Motion
from rocking.runtime.script import run
from rocking.studies import strengthening
from rocking.tables import write_table


def main(job):
    settings, w = json.loads(job.params.settings)["strengthening"], job.wildcards
    case, motion = Case.read(job.input.scene), Motion.read_floors(job.input.motion)
    given = case, motion, w.direction, settings
    table = strengthening.search(*given)
    least = strengthening.least(table, settings["probability"])
    choice = strengthening.best(least)
    # where no tie holds, the chart is drawn for the highest row
    height = float(least["height_m"].max() if choice is None else choice["height_m"])
    curve = strengthening.curve(*given, height)
    cases = strengthening.to_confirm(case, table, choice, settings)
    tables = {job.output.search: table, job.output.least: least, job.output.curve: curve}
    for path, frame in tables.items():
        for place, name in enumerate(("model", "record", "direction")):
            frame.insert(place, name, getattr(w, name))
        write_table(frame, path)
    plan = {"ahead": strengthening.AHEAD, "cases": cases}
    Path(job.output.plan).write_text(json.dumps(plan, indent=1) + "\n")


run(main, globals())
