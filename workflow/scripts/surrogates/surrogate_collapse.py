"""Collapse of one recorded motion and of surrogates made for it, by the same scan.

Of a record without a file there are surrogates alone, by its parameters.
"""

import itertools
import sys
from functools import partial

import pandas as pd
from rocking import Case, Motion, Variant
from rocking.collapse.varied import collapses
from rocking.records import RecordError, load, measures, read_csv
from rocking.records.pulses import pulse_spec
from rocking.records.surrogate import generate
from rocking.runtime.script import run
from rocking.studies.surrogate_trust import COLUMNS, outcome
from rocking.tables import write_table

WHAT = ("station", "kind", "pulses", "pulses_kept", "draw")


def surrogate(record, pulses, seed):
    """Surrogate of a record with its peaks and so many of its pulses, or the most below that."""
    peaks = measures(record)
    target = [peaks[name] for name in ("pga_g", "pgv_cm_s", "pgd_cm", "duration_s")]
    for count in range(pulses, -1, -1):
        spec = pulse_spec(record, count) if count else None
        try:
            return generate(record.name, *target, spec=spec, seed=seed), count
        except RecordError as error:
            print(f"{count} pulses: {error}", file=sys.stderr)
    return None, 0


def motions(record, p):
    """Kind, pulses, pulses kept, draw and motion of all that is compared."""
    draws = range(p.surrogates["draws"])
    if record.source == "surrogate":
        for draw in draws:
            yield "surrogate", None, None, draw, load(record.name, p.table, seed=p.seed + draw)
        return
    yield "recorded", None, None, 0, record
    for pulses, draw in itertools.product(p.surrogates["pulses"], draws):
        made, kept = surrogate(record, pulses, p.seed + draw)
        if made is not None:
            yield "surrogate", pulses, kept, draw, made


def main(job):
    p = job.params
    record, ratio = read_csv(job.input.record), p.surrogates["level_ratio"]
    cases = [Case.read(path) for path in job.input.scenes]
    rows = []
    for *what, motion in motions(record, p):
        about = dict(zip(WHAT, (p.station, *what), strict=True))
        find, alike = partial(outcome, level_ratio=ratio), [Variant(about=about)]
        rows += collapses(cases, Motion(motion), p.directions, find, alike)
    table = pd.DataFrame(rows, columns=COLUMNS)
    for name in ("pulses", "pulses_kept"):
        table[name] = table[name].astype("Int64")
    write_table(table, job.output[0])


run(main, globals())
