"""Peak displacements of the shake-table runs."""

import math

from rocking.calibration.restitution import read_archive
from rocking.runtime.script import run
from rocking.tables import read_json, write_table

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
    rows = []
    tests = read_json(job.input.tests)
    for test, done in zip(tests, read_archive(job.input.histories), strict=True):
        about, facade = test["about"], test["config"]["facade"]
        rest = facade["height_m"] * math.sin(math.radians(facade["tilt_deg"]))
        d = 1e3 * (done["d_m"] - rest)
        failed = done["status"] == "failed"
        fallen = done["status"] == "overturned"
        rows.append(
            {
                **{key: about[key] for key in COLUMNS[:7]},
                "beta_s": test["beta_s"],
                "rest_mm": f"{1e3 * rest:.2f}",
                "peak_mm": "" if failed or fallen else f"{d.max():.2f}",
                "lowest_mm": "" if failed else f"{d.min():.2f}",
                "end_mm": "" if failed or fallen else f"{d[-1]:.2f}",
                "overturned": "" if failed else int(fallen),
                "status": done["status"],
            }
        )
    write_table(rows, job.output[0], COLUMNS)


run(main, globals())
