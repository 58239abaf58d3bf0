"""The plane mechanism that fails first by hand under a code's spectrum, beside the whole façade."""

import json

from rocking import Case
from rocking.assessment import shaken
from rocking.assessment.code_checks import governing
from rocking.assessment.code_spectrum import CodeDemand
from rocking.assessment.comparison import REFERENCE_G, SITE
from rocking.assessment.family import Family
from rocking.runtime.script import run
from rocking.tables import write_table


def main(job):
    settings = json.loads(job.params.settings)
    plane = [one for one in Family(settings).all() if one.plane]
    ranked = governing(plane, settings, CodeDemand(REFERENCE_G, *SITE))
    table = shaken.chosen(ranked, [Case.read(path) for path in job.input.cases], 1.0)
    write_table(table, job.output[0], digits=None)  # heights to the digit


run(main, globals())
