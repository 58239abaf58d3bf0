"""Scene file of one model: the parts of the configuration a façade run depends on, and β."""

import json

from rocking.accuracy.study import choose_fidelity, read_fidelity
from rocking.calibration.beta import beta_for
from rocking.configuration.config import resolve
from rocking.runtime.script import run

from yade_scripts.model import registry

CHOSEN = ("nodes_thickness", "nodes_height", "nodes_per_block", "step_fraction", "step_s")


def at_fidelity(numerics, model, measured):
    """Nodes and step for the stated tolerance; what the user stated differently is kept.

    W3 has its own numerics (section w3).
    """
    if not registry.model(model).single_block:
        return numerics
    defaults = resolve({})["numerics"]
    stated = {key: numerics[key] for key in CHOSEN if numerics[key] != defaults[key]}
    return {**choose_fidelity(numerics, model, measured), **stated}


def main(job):
    scene = json.loads(job.params.scene)
    scene["model"] = job.wildcards.model
    scene["beta_s"] = beta_for(scene, job.input.law)
    scene["numerics"] = at_fidelity(
        scene["numerics"], scene["model"], read_fidelity(job.input.fidelity)
    )
    with open(job.output[0], "w") as handle:
        json.dump(scene, handle, indent=1, sort_keys=True)
        handle.write("\n")


run(main, globals())
