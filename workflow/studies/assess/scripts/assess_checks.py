"""PGA at which each check of a code just fails, record by record, its own spectrum scaled."""

import json

from rocking.records import load_as
from rocking.runtime.script import run
from rocking.tables import write_table
from studies.assess.anchors import completed_settings
from studies.assess.code_checks import failing_pga, mechanism_of


def main(job):
    settings, rows = completed_settings(json.loads(job.params.settings)), []
    mechanism = mechanism_of(settings)
    for name, station in job.params.records.items():
        record = load_as(settings, name, job.params.table)
        of_record = {"record": name, "station": station}
        by_check = failing_pga(mechanism, settings, record)
        rows += [
            {**of_record, "direction": direction, "check": key, "pga_fails_g": pga_g}
            for direction in settings["directions"]
            for key, pga_g in by_check.items()
        ]
    write_table(rows, job.output[0])


run(main, globals())
