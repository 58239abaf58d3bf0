"""Shake-table tests of figure 6: motions, and one run for each motion, scale, direction and β."""

import copy
import json
import os

import yaml
from rocking.accuracy.fidelity import choose, read_fidelity
from rocking.calibration.beta import beta_for
from rocking.configuration.config import ConfigError, resolve
from rocking.records import load, measures, read_table
from rocking.runtime.script import run
from rocking.tables import write_json

from yade_scripts.model.floor_motions import write

SECTIONS = ("facade", "return_wall", "smdof", "numerics")


def tests_of(wall, record, motion, tilt, settings, laws):
    config = copy.deepcopy(wall)
    config["facade"]["tilt_deg"] = tilt
    for scale in settings["shake_table_scale"]:
        for direction, sign in (("pos", 1.0), ("neg", -1.0)):
            for law, beta in laws.items():
                yield {
                    "id": f"{record.name} ×{scale:g} {direction} {law}",
                    "config": {key: config[key] for key in SECTIONS},
                    "model": "W1" if config["facade"]["sides"] == "one" else "free",
                    "beta_s": beta,
                    "motion": motion,
                    "factor": sign * scale,
                    "about": {
                        "record": record.name,
                        "source": record.source,
                        "scale": scale,
                        "direction": direction,
                        "law": law,
                        "tilt_deg": tilt,
                        "pga_g": scale * measures(record)["pga_g"],
                    },
                }


def main(job):
    settings = json.loads(job.params.settings)["calibration"]
    with open(job.input.wall, encoding="utf-8") as handle:
        wall = resolve(yaml.safe_load(handle))
    wall["facade"]["base"] = settings["base"]
    wall["numerics"], _ = choose(wall, "W1", read_fidelity(job.input.fidelity))
    names = list(read_table(job.input.table))
    tilts = settings["shake_table_tilt_deg"]
    if len(tilts) != len(names):
        raise ConfigError(
            f"calibration.shake_table_tilt_deg: {len(tilts)} values, expected one for each of the "
            f"{len(names)} records of {job.input.table}"
        )
    laws = {
        law: beta_for({**wall, "damping": {"law": law}}, job.input.law) for law in ("eq5", "fitted")
    }
    os.makedirs(job.output.motions, exist_ok=True)
    tests = []
    for name, tilt in zip(names, tilts, strict=True):
        record = load(name, job.input.table, baseline=job.params.baseline, seed=job.params.seed)
        motion = os.path.join(job.output.motions, f"{name}.csv")
        write(motion, record.time_s, record.acceleration_m_s2)
        tests += tests_of(wall, record, motion, tilt, settings, laws)
    write_json(job.output.tests, tests, sort_keys=True)


run(main, globals())
