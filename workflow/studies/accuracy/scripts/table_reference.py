"""Reported collapse intensities and bands beside the reference solver's dense scans."""

from rocking.runtime.script import run
from rocking.tables import read_frame, read_tables, write_table
from studies.accuracy.coverage import BAND_COLUMNS, KEY, compare


def main(job):
    scans = read_tables(job.input.scans)
    reported = read_frame(job.input.collapse).set_index(KEY, drop=False)
    rows = [
        compare(table, reported.loc[key], job.params.spread)
        for key, table in scans.groupby(KEY, sort=False)
    ]
    write_table(rows, job.output.bands, BAND_COLUMNS, digits="%.4f")
    write_table(scans, job.output.scan)


run(main, globals())
