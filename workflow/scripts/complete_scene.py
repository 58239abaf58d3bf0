"""Scene of the complete building, as the study inside YADE reads it (complete/…/scene.json)."""

import json
from pathlib import Path

from rocking.accuracy.fidelity import choose, read_fidelity
from rocking.building.case import read_plan
from rocking.building.complete import complete_building
from rocking.calibration.beta import beta_for
from rocking.runtime.script import run

from yade_scripts.model.scene import to_json

OWN = ("step_fraction", "quiet_ratio", "rest_velocity_m_s", "sample_interval_s")  # of numerics


def main(job):
    config, w = json.loads(job.params.config), job.wildcards
    load = json.loads(Path(job.input.fit).read_text())["floor_load_kg_m2"]
    config["numerics"], _ = choose(config, "W2", read_fidelity(job.input.fidelity))
    beta = beta_for(config, job.input.law)
    scene = complete_building(
        config, read_plan(job.input.plan), load, w.complete, beta, float(w.coarsening), w.back
    )
    own = config["complete"]
    numerics = {**config["numerics"], "step_s": None, **{key: own[key] for key in OWN}}
    job_file = {
        "model": w.complete,
        "beta_s": beta,
        "scene": json.loads(to_json(scene)),
        "numerics": numerics,
        "complete": {**own, "max_pga_g": config["ida.max_pga_g"]},
    }
    Path(job.output[0]).write_text(json.dumps(job_file, sort_keys=True) + "\n")


run(main, globals())
