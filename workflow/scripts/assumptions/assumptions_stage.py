"""What the building stage says of the chain: its mass, and T1 with and without façades."""

import json
from pathlib import Path

from rocking.building.case import translation_mode
from rocking.building.modes import Modes
from rocking.runtime.script import run


def period(path):
    """Period of the translation across the façades [s]."""
    modes = Modes.load(path)
    return float(modes.period_s[translation_mode(modes)])


def main(job):
    fit = json.loads(Path(job.input.fit).read_text())
    stage = {
        "mass_kg": fit["mass_behind_facade_kg"],
        "period_s": period(job.input.sbdem),
        "complete_period_s": period(job.input.cbdem),
    }
    Path(job.output[0]).write_text(json.dumps(stage, indent=1, sort_keys=True) + "\n")


run(main, globals())
