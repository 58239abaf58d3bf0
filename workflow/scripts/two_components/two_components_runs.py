"""What YADE runs of one curve under two components: the compiled solver's intensities."""

import pandas as pd
from rocking import Case
from rocking.runtime.script import run
from rocking.studies.two_components import to_confirm
from rocking.tables import write_json


def main(job):
    table, w = pd.read_csv(job.input.curves), job.wildcards
    row = table[(table["model"] == w.model) & (table["direction"] == w.direction)].iloc[0]
    confirmed = to_confirm(Case.read(job.input.case), row, job.params.settings)
    write_json(job.output[0], confirmed, sort_keys=True)


run(main, globals())
