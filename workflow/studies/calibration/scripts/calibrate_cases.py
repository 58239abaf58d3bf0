"""Walls and β of one part of the calibration study, for YADE's free-rocking runs."""

import json

from rocking.configuration.config import resolve
from rocking.configuration.files import read_yaml
from rocking.configuration.study import as_in_the_study
from rocking.runtime.script import run
from rocking.tables import write_json
from studies.calibration import free_rocking as study


def main(job):
    config = json.loads(job.params.config)
    settings, group = config["calibration"], job.wildcards.group
    if group.startswith("batch"):
        cases = study.batch_cases(settings, int(group[5:]))
    elif group == "sensitivity":
        cases = study.sensitivity_cases(settings)
    elif group == "free_rocking_wall":
        wall = resolve(as_in_the_study(read_yaml(job.input.wall)))
        wall["facade"]["base"] = settings["base"]
        cases = study.wall_cases(
            settings, wall, settings["ratio_band"], settings["free_rocking_beta_s"]
        )
    else:
        config["facade"] |= {"courses": 0, "courses_growth": 1.0}  # what β is of
        cases = study.wall_cases(settings, {**config, "run": "own wall"})
    write_json(job.output[0], cases, sort_keys=True)


run(main, globals())
