"""The plane mechanism that fails first by hand under a code's spectrum, beside the whole façade."""

import json

from rocking import Case
from rocking.runtime.script import run
from rocking.tables import write_table
from studies.assess import shaken
from studies.assess.anchors import completed_settings
from studies.assess.code_checks import family_of, governing
from studies.assess.code_spectrum import CodeDemand
from studies.assess.comparison import REFERENCE_G, SITE


def main(job):
    settings = completed_settings(json.loads(job.params.settings))
    demand = CodeDemand(REFERENCE_G, *SITE)
    plane = [candidate for candidate in family_of(settings, demand).all() if candidate.plane]
    ranked = governing(plane, settings, demand)
    assessment = settings["assessment"]
    tried = [shaken.settled(Case.read(path), assessment) for path in job.input.cases]
    table = shaken.chosen(ranked, tried, ranked[0][0], 1.0)  # the first alone, and the whole
    write_table(table, job.output[0], digits=None)  # heights to the digit


run(main, globals())
