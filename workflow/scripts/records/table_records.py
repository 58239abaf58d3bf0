"""Table of the records of a run: source, step, duration and peaks (tables/records.csv)."""

import pandas as pd
from rocking.records import RECORDS_COLUMNS, read_csv, records_row
from rocking.runtime.script import run
from rocking.tables import write_table


def main(job):
    rows = [records_row(read_csv(path.replace(".json", ".csv"))) for path in job.input.facts]
    table = pd.DataFrame(rows, columns=list(RECORDS_COLUMNS))
    write_table(table, job.output[0])


run(main, globals())
