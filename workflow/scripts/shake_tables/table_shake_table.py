"""Peak displacements of the shake-table runs."""

import csv
import json
import math

from rocking.calibration.restitution import read_archive
from rocking.runtime.script import run

COLUMNS = (
    "record",
    "source",
    "scale",
    "pga_g",
    "direction",
    "tilt_deg",
    "law",
    "beta_s",
    "rest_mm",
    "peak_mm",
    "lowest_mm",
    "end_mm",
    "overturned",
    "status",
)


def main(job):
    with open(job.input.tests) as handle:
        tests = json.load(handle)
    with open(job.output[0], "w", newline="") as handle:
        writer = csv.DictWriter(handle, COLUMNS, lineterminator="\n")
        writer.writeheader()
        for test, done in zip(tests, read_archive(job.input.histories), strict=True):
            about, facade = test["about"], test["config"]["facade"]
            rest = facade["height_m"] * math.sin(math.radians(facade["tilt_deg"]))
            d = 1e3 * (done["d_m"] - rest)
            failed = done["status"] == "failed"
            fallen = done["status"] == "overturned"
            writer.writerow(
                {
                    **{key: about[key] for key in ("record", "source", "direction", "law")},
                    **{key: f"{about[key]:.6g}" for key in ("scale", "pga_g", "tilt_deg")},
                    "beta_s": f"{test['beta_s']:.6g}",
                    "rest_mm": f"{1e3 * rest:.2f}",
                    "peak_mm": "" if failed or fallen else f"{d.max():.2f}",
                    "lowest_mm": "" if failed else f"{d.min():.2f}",
                    "end_mm": "" if failed or fallen else f"{d[-1]:.2f}",
                    "overturned": "" if failed else int(fallen),
                    "status": done["status"],
                }
            )


run(main, globals())
