"""Case file of one model: the parts of the configuration a façade run depends on, and β."""

import json
import warnings
from pathlib import Path

from rocking.collapse.case import Case
from rocking.mechanics.beta import RangeWarning
from rocking.runtime.script import run
from rocking.tables import read_json


def main(job):
    sections, mass_kg = json.loads(job.params.sections), None
    if building := getattr(job.input, "building", None):
        mass_kg = read_json(str(building))["mass_behind_facade_kg"]
    warnings.simplefilter("ignore", RangeWarning)  # the run says it at its start, once
    case = Case.chosen(sections, job.wildcards.model, mass_kg, job.input.law, job.input.fidelity)
    Path(job.output[0]).write_text(case.to_json(), encoding="utf-8")


run(main, globals())
