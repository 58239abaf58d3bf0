"""Least tie of one curve: search, collapse intensities, and what YADE is to confirm."""

import json
import time
from pathlib import Path

from rocking import Case, Motion
from rocking.runtime.script import run
from rocking.tables import headed, write_json, write_table
from studies.assess import strengthening


def main(job):
    settings, w = json.loads(job.params.settings)["strengthening"], job.wildcards
    case, motion = Case.read(job.input.case), Motion.of_workflow(job.input.motion)
    given = case, motion, w.direction, settings
    log = getattr(job, "log", None)

    def say(text):
        line = f"[{time.strftime('%H:%M:%S')}] {w.model} {w.record} {w.direction}: {text}"
        if log:
            with open(str(log), "a", encoding="utf-8") as handle:
                handle.write(line + "\n")

    most, fewest = strengthening.most_histories(settings, case["facade"]["height_m"])
    scans = settings["curve_levels"] + 1
    say(f"{fewest} to {most} histories, fewer where ties fail; then {scans} scans for the chart")
    code = (
        Path(str(job.input.modules)).read_text(encoding="utf-8")
        if getattr(job.input, "modules", None)
        else ""
    )
    key = strengthening.key_of(*given, code)
    kept = strengthening.Kept(job.params.kept, key)
    if kept.known:
        say(f"{len(kept.known)} ties known from an earlier search")
    table = strengthening.search(*given, kept, say)
    least = strengthening.least(table, settings["probability"])
    choice = strengthening.best(least)
    # where no tie holds, the chart is drawn for the highest row
    height = float(least["height_m"].max() if choice is None else choice["height_m"])
    say(f"{len(table)} ties tried")
    scanned = strengthening.Kept(job.params.kept, f"{key} chart")
    curve = strengthening.curve(*given, height, scanned, say)
    cases = strengthening.to_confirm(case, table, choice, settings)
    tables = {job.output.search: table, job.output.least: least, job.output.curve: curve}
    for path, frame in tables.items():
        named = headed(frame, model=w.model, record=w.record, direction=w.direction)
        write_table(named, path)
    write_json(job.output.plan, {"ahead": strengthening.AHEAD, "cases": cases})


run(main, globals())
