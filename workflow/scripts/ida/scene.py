"""Scene file of one model: the parts of the configuration a façade run depends on, and β."""

import json
from pathlib import Path

from rocking.accuracy.fidelity import choose, read_fidelity
from rocking.assessment.battery import weakest_hinge
from rocking.calibration.beta import beta_for
from rocking.configuration.facade import WEAKEST
from rocking.runtime.script import run


def main(job):
    scene = json.loads(job.params.scene)
    scene["model"] = job.wildcards.model
    if law := getattr(job.wildcards, "law", None):  # for the comparison of the laws of β
        scene["damping"]["law"] = law
    building = getattr(job.input, "building", None)
    if building:
        fit = json.loads(Path(str(building)).read_text())
        scene["return_wall"]["building_mass_kg"] = fit["mass_behind_facade_kg"]
    if scene["facade"]["hinges_m"] == WEAKEST:
        scene["facade"]["hinges_m"] = [weakest_hinge(scene["facade"])]
    scene["beta_s"] = beta_for(scene, job.input.law)
    scene["numerics"], _ = choose(scene, scene["model"], read_fidelity(job.input.fidelity))
    with open(job.output[0], "w") as handle:
        json.dump(scene, handle, indent=1, sort_keys=True)
        handle.write("\n")


run(main, globals())
