"""Scene of the complete building, as the study inside YADE reads it (complete/…/scene.json)."""

import json

from rocking.configuration.files import read_yaml
from rocking.fidelity import choose
from rocking.runtime.script import run
from rocking.tables import write_json
from studies.building.complete import run_numerics, scene_of

from yade_scripts.model.scene import to_json


def main(job):
    config, w = json.loads(job.params.config), job.wildcards
    config["numerics"], _ = choose(config, "W2", read_yaml(job.input.fidelity))
    scene, beta = scene_of(config, job, w.complete, float(w.coarsening))
    job_file = {
        "model": w.complete,
        "beta_s": beta,
        "scene": json.loads(to_json(scene)),
        "numerics": run_numerics(config),
        "complete": {**config["complete"], "max_pga_g": config["ida.max_pga_g"]},
    }
    write_json(job.output[0], job_file, indent=None, sort_keys=True)


run(main, globals())
