"""Cases of a shake-table experiment: parameters of every variant, motions, and what YADE runs."""

import json
import os
from pathlib import Path

from rocking.configuration.config import ConfigError
from rocking.runtime.script import run
from rocking.tables import write_json
from studies.validation import specimens
from studies.validation import study as validation

from yade_scripts.model.floor_motions import write


def main(job):
    settings = json.loads(job.params.settings)["validation"]
    experiment = validation.read(Path(job.input.files[0]).parent)
    os.makedirs(job.output.motions, exist_ok=True)
    folder, rows, motions = settings["motions_folder"], [], []
    for _, row in experiment.runs.iterrows():
        time_s, ground, source = validation.motion(experiment, row, folder, job.params.table)
        path = os.path.join(job.output.motions, f"{row['run']}.csv")
        write(path, time_s, ground)
        motions.append((time_s, ground))
        rows.append({**row.to_dict(), "motion": path, "source": source})
    if folder and all(row["source"] != "file" for row in rows):
        pattern = experiment.specimen["motions"]["files"]
        raise ConfigError(f"validation.motions_folder = {folder}: expected files named {pattern}")
    whole = os.path.join(job.output.motions, "sequence.csv")
    time_s, ground, spans = validation.one_after_another(motions)
    write(whole, time_s, ground)
    cases = specimens.cases(experiment)
    tests = []
    for name in list(cases)[: settings["main_variants"]]:
        each = [(r["run"], r["motion"]) for r in rows] + [("sequence", whole)]
        tests += [specimens.walls_test(cases[name], f"{name}|{what}", path) for what, path in each]
    about = {"variants": cases, "runs": rows, "sequence": whole, "spans": spans}
    for path, data in ((job.output.cases, about), (job.output.tests, tests)):
        write_json(path, data)


run(main, globals())
