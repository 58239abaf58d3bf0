"""Make config/suites/recorded_suite.{motions,tsv} from the folder of the data set's files.

    python tools/pack_motions.py FOLDER

FOLDER holds the .acc files (m/s², one value a line) and inventory.tsv with their station,
component, axis, event, time_utc, dt_s and peaks.
"""

import argparse
import csv
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / "workflow")]

from record_files import packed  # noqa: E402

SUITE = ROOT / "config" / "suites" / "recorded_suite.motions"
WORDS = {
    "source": "S. Kallioras, F. Graziotti, G. Magenes (2025), Vertical accelerations in seismic "
    "analysis: a numerical investigation of their effects on URM structures, Earthquake Spectra; "
    "data set Vertical-GM-URM. Recorded by the networks of Italy and Iceland (European "
    "strong-motion database) and by GeoNet, New Zealand; processed by them.",
    "licence": "CC BY 4.0, https://creativecommons.org/licenses/by/4.0/",
    "changes": f"22 of its 83 motions, rounded to within {packed.RESOLUTION:g} of each one's peak "
    "and packed by tools/pack_motions.py",
}
COLUMNS = (
    *("record", "file", "dt_s", "units", "component", "vertical", "event", "station"),
    *("pga_g", "pgv_cm_s", "pgd_cm", "duration_s"),
)


def main(folder):
    """Write the packed motions and their records table."""
    with open(folder / "inventory.tsv", encoding="utf-8") as stream:
        inventory = list(csv.DictReader(stream, delimiter="\t"))
    inventory.sort(key=lambda row: row["file"])
    motions, rows = [], [list(COLUMNS)]
    for item in inventory:
        label = f"{item['station']} {item['component']}"
        about = {"label": label} | {key: item[key] for key in ("station", "event", "time_utc")}
        about |= {"units": "m/s2", "dt_s": float(item["dt_s"])}
        motions.append((np.loadtxt(folder / item["file"]), about))
        if item["axis"] == "horizontal":
            event = f"{item['event']}, {item['time_utc']} UTC"
            duration = f"{float(item['dt_s']) * (int(item['samples']) - 1):.3f}"
            peaks = [item[key] for key in ("pga_g", "pgv_cm_s", "pgd_cm")]
            vertical = f"{item['station']} UD"
            about = [label, vertical, event, item["station"]]
            row = [label.replace(" ", "_"), SUITE.name, "", "", *about]  # the file states its step
            rows.append([*row, *peaks, duration])
    packed.write(SUITE, motions, **WORDS)
    table = "".join("\t".join(row) + "\n" for row in rows)
    note = (
        "# Recorded motions of recorded_suite.motions, which states source and licence.\n"
        "# A record of yours takes one row: a name, its file (from this folder), and step and\n"
        "# units where the file does not state them.\n"
    )
    SUITE.with_suffix(".tsv").write_text(note + table, encoding="utf-8")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="with inventory.tsv and the motions it lists")
    given = parser.parse_args().folder
    if not (given / "inventory.tsv").is_file():
        parser.error(f"{given}: expected a folder with inventory.tsv")
    main(given)
