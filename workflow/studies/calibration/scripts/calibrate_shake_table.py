"""Shake-table tests of figure 6: motions, and one run for each motion, scale, direction and β."""

import json
import os

from rocking.configuration.config import ConfigError, resolve
from rocking.configuration.files import read_yaml
from rocking.configuration.study import as_in_the_study
from rocking.fidelity import choose
from rocking.mechanics.beta import beta_for
from rocking.records import load, read_table
from rocking.runtime.script import run
from rocking.tables import write_json
from studies.calibration.shake_table import tests_of

from yade_scripts.model.floor_motions import write


def main(job):
    settings = json.loads(job.params.settings)["calibration"]
    wall = resolve(as_in_the_study(read_yaml(job.input.wall)))
    wall["facade"]["base"] = settings["base"]
    wall["numerics"], _ = choose(wall, "W1", read_yaml(job.input.fidelity))
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
        tests += tests_of(wall, record, motion, tilt, settings["shake_table_scale"], laws)
    write_json(job.output.tests, tests, sort_keys=True)


run(main, globals())
