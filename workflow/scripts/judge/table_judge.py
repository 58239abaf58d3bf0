"""Reported collapse intensities and bands beside the judge's dense scans."""

import pandas as pd
from rocking.accuracy.judge import BAND_COLUMNS, KEY, compare
from rocking.runtime.script import run


def main(job):
    scans = pd.concat([pd.read_csv(path) for path in job.input.scans], ignore_index=True)
    reported = pd.read_csv(job.input.collapse).set_index(KEY, drop=False)
    rows = [
        compare(table, reported.loc[key], job.params.spread)
        for key, table in scans.groupby(KEY, sort=False)
    ]
    bands = pd.DataFrame(rows, columns=list(BAND_COLUMNS))
    bands.to_csv(job.output.bands, index=False, float_format="%.4f", lineterminator="\n")
    scans.to_csv(job.output.scan, index=False, float_format="%.6g", lineterminator="\n")


run(main, globals())
