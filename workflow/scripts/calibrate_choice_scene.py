"""Scene file of one model under one law of β, for the comparison of the laws."""

import json

from rocking.calibration.beta import beta_for
from rocking.runtime.script import run


def main(job):
    scene = json.loads(job.params.scene)
    scene["model"] = job.wildcards.model
    scene["damping"]["law"] = job.wildcards.law
    scene["beta_s"] = beta_for(scene, job.input.law)
    with open(job.output[0], "w") as handle:
        json.dump(scene, handle, indent=1, sort_keys=True)
        handle.write("\n")


run(main, globals())
