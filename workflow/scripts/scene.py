"""Scene file of one model: the parts of the configuration a façade run depends on, and β."""

import json

from rocking.accuracy import choose_fidelity, read_fidelity
from rocking.calibration import beta_for
from rocking.script import run


def main(job):
    scene = json.loads(job.params.scene)
    scene["model"] = job.wildcards.model
    scene["beta_s"] = beta_for(scene)
    scene["numerics"] = choose_fidelity(
        scene["numerics"], scene["model"], read_fidelity(job.input.fidelity)
    )
    with open(job.output[0], "w") as handle:
        json.dump(scene, handle, indent=1, sort_keys=True)
        handle.write("\n")


run(main, globals())
