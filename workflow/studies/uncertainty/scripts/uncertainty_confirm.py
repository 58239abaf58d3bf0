"""Cells of the design by YADE beside the planar solver."""

from pathlib import Path

from rocking.runtime.script import run
from rocking.tables import read_frame, read_json, write_table

COLUMNS = ["cell", "record", "direction", "model", "sample", "pga_g"]
COLUMNS += ["d_over_b_planar", "status_planar", "d_over_b_yade", "status_yade", "agrees"]


def main(job):
    cells = read_json(job.input.cells)["cases"]
    rows = []
    for path in job.input.yade:
        own, found = cells[Path(path).stem], read_frame(path)
        known = [own[key] for key in ("record", "direction", "model", "sample")]
        planar = zip(own["planar"]["d_over_b"], own["planar"]["status"], strict=True)
        for (value, status), yade in zip(planar, found.to_dict("records"), strict=True):
            same = int(status == yade["status"])
            both = (value, status, yade["d_over_b"], yade["status"], same)
            rows.append((Path(path).stem, *known, yade["pga_g"], *both))
    write_table(rows, job.output[0], COLUMNS)


run(main, globals())
