"""Cases and runs of the accuracy study, from the collapse intensity of each curve."""

import json

import pandas as pd
from rocking.accuracy.study import choose_cases, plan_runs
from rocking.runtime.script import run


def main(job):
    settings, ensemble = job.params.accuracy, job.params.ensemble
    cases = choose_cases([pd.read_csv(path) for path in job.input.curves], settings["shares"])
    plan = {
        "scenes": dict(zip(settings["models"], job.input.scenes, strict=True)),
        "motions": dict(zip(settings["records"], job.input.motions, strict=True)),
        "cases": cases,
        "runs": plan_runs(cases, settings, ensemble["sensitivity_perturbation"]),
    }
    with open(job.output[0], "w") as handle:
        json.dump(plan, handle, indent=1)
        handle.write("\n")


run(main, globals())
