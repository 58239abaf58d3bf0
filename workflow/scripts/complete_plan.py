"""Where a curve of the complete building begins, and islands: from the scan of its reduction."""

import itertools
import json
from pathlib import Path

import pandas as pd
from rocking.curves.collapse import from_scan, islands
from rocking.runtime.script import run

from yade_scripts.studies.intensities import DIGITS


def main(job):
    scan = pd.read_csv(job.input.scan)
    fallen = scan.loc[scan["status"] == "overturned", "pga_g"]
    table = from_scan(scan, job.params.spread)
    found = islands(table["pga_g"].to_numpy(), table["probability"].to_numpy())
    between = [0.5 * (b + c) for (_, b), (c, _) in itertools.pairwise(found)]
    start = fallen.min() if len(fallen) else scan["pga_g"].max()
    plan = {
        "start_g": round(float(start), DIGITS),
        "islands": [round(g, DIGITS) for g in between[: job.params.most]],
    }
    Path(job.output[0]).write_text(json.dumps(plan, sort_keys=True) + "\n")


run(main, globals())
