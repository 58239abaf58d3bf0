"""Scene file of a pushover: the parts of the configuration it depends on, one model or variant."""

import json
import warnings

from rocking.mechanics.beta import RangeWarning, beta_for
from rocking.pushover import variant
from rocking.runtime.script import run
from rocking.tables import write_json


def main(job):
    scene = json.loads(job.params.sections)
    name = getattr(job.wildcards, "variant", None)
    if name is not None:
        scene = variant(scene, name)
    scene["model"] = getattr(job.wildcards, "pushed", "W3")
    warnings.simplefilter("ignore", RangeWarning)  # the run says it at its start, once
    scene["beta_s"] = beta_for(scene, job.input.law)
    for key in ("nodes_thickness", "nodes_height", "step_fraction"):
        scene["numerics"][key] = scene["pushover"][key]
    write_json(job.output[0], scene, sort_keys=True)


run(main, globals())
