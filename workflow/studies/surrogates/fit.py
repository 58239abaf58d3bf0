"""Describe recorded motions by pulses: parameters of surrogates for what may not be shipped.

    .venv/bin/python -m studies.surrogates.fit my_records.tsv OUTPUT_FOLDER [--pulses 20]

OUTPUT_FOLDER gets pulse_surrogates.tsv (names, peaks, duration) and surrogates.yaml (pulses and
noise, see `studies.surrogates.pulses`): numbers that describe a motion, none of its samples.
"""

import argparse
from dataclasses import asdict
from pathlib import Path

import yaml
from rocking.records import load, measures, read_table
from rocking.records.table import TARGETS

from studies.surrogates.pulses import pulse_spec

MOVED = 12  # pulses whose amplitude may move a little to meet the peaks
NOTE = "# Written by workflow/studies/surrogates/fit.py, which says how.\n"


def described(record, pulses):
    """Parameters of one surrogate, for config/surrogates.yaml."""
    spec = pulse_spec(record, pulses)
    solve = [f"pulses.{i}.amplitude_m_s" for i in range(min(pulses, MOVED))]
    entry = {
        "dt_s": spec.dt_s,
        "pulses": [asdict(pulse) for pulse in spec.pulses],
        "noise": asdict(spec.noise),
        "solve": [*solve, *(name for name in spec.solve if name not in solve)],
    }
    for values in (*entry["pulses"], entry["noise"]):
        values.update({key: float(f"{value:.4g}") for key, value in values.items()})
    return entry


def main():
    """Write both files."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", help="records table with files")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--pulses", type=int, default=20)
    args = parser.parse_args()
    rows, entries = [("record", "event", "station", *TARGETS)], {}
    for name, row in read_table(args.table).items():
        record = load(name, args.table)
        peaks = measures(record)
        about = (row.about.get(key, "") for key in ("event", "station"))
        rows.append((name, *about, *(f"{peaks[key]:.5g}" for key in TARGETS)))
        entries[name] = described(record, args.pulses)
    table = "".join("\t".join(map(str, row)) + "\n" for row in rows)
    (args.folder / "pulse_surrogates.tsv").write_text(NOTE + table, encoding="utf-8")
    text = yaml.safe_dump(entries, sort_keys=False, width=98)
    (args.folder / "surrogates.yaml").write_text(NOTE + text, encoding="utf-8")


if __name__ == "__main__":
    main()
