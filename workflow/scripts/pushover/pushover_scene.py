"""Scene file of a pushover: the parts of the configuration it depends on, one model or variant."""

import json

from rocking.calibration.beta import beta_for
from rocking.runtime.script import run
from rocking.studies.pushover import variant


def main(job):
    scene = json.loads(job.params.scene)
    name = getattr(job.wildcards, "variant", None)
    if name is not None:
        scene = variant(scene, name)
    scene["model"] = getattr(job.wildcards, "pushed", "W3")
    scene["beta_s"] = beta_for(scene, job.input.law)
    for key in ("nodes_thickness", "nodes_height", "step_fraction"):
        scene["numerics"][key] = scene["pushover"][key]
    with open(job.output[0], "w") as handle:
        json.dump(scene, handle, indent=1, sort_keys=True)
        handle.write("\n")


run(main, globals())
