"""Where YADE begins a curve of the complete building and where it looks, by the reduction's scan.

It begins inside the scan's first range of collapse and not at its edge, which the reduction
places to a per cent or two only; of further ranges it runs the middle, and that of the gap
below each.
"""

import itertools

import pandas as pd
from rocking.collapse.probability import collapse_ranges, from_scan
from rocking.runtime.script import run
from rocking.tables import write_json

from yade_scripts.studies.search import DIGITS


def main(job):
    scan, most = pd.read_csv(job.input.scan), job.params.most
    table = from_scan(scan, job.params.spread)
    found = collapse_ranges(table["pga_g"].to_numpy(), table["probability"].to_numpy())
    start = scan["pga_g"].max()
    if found:
        low, high = found[0]
        start = min(0.5 * (low + high), low * (1.0 + job.params.step))
    between = [
        0.5 * (one + two)
        for (_, b), (c, d) in itertools.islice(itertools.pairwise(found), most)
        for one, two in ((b, c), (c, d))
    ]
    plan = {"start_g": round(float(start), DIGITS), "ranges": [round(g, DIGITS) for g in between]}
    write_json(job.output[0], plan, indent=None, sort_keys=True)


run(main, globals())
