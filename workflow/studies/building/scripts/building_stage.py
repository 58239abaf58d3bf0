"""What the building stage says of the chain: its mass, and T1 with and without façades."""

from rocking.runtime.script import run
from rocking.tables import read_json, write_json
from studies.building.case import translation_mode
from studies.building.modes import Modes


def period(path):
    """Period of the translation across the façades [s]."""
    modes = Modes.load(path)
    return float(modes.period_s[translation_mode(modes)])


def main(job):
    fit = read_json(job.input.fit)
    stage = {
        "mass_kg": fit["mass_behind_facade_kg"],
        "period_s": period(job.input.sbdem),
        "complete_period_s": period(job.input.cbdem),
    }
    write_json(job.output[0], stage, sort_keys=True)


run(main, globals())
