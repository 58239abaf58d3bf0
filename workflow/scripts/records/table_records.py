"""Table of the records of a run: source, step, duration and peaks (tables/records.csv)."""

from rocking.records import RECORDS_COLUMNS, read_csv, records_row
from rocking.runtime.script import run
from rocking.tables import write_table


def main(job):
    rows = [records_row(read_csv(path.replace(".json", ".csv"))) for path in job.input.facts]
    write_table(rows, job.output[0], RECORDS_COLUMNS)


run(main, globals())
