"""How far a surrogate stands for its record: distributions of the ratio of their collapse PGA.

For each recorded motion of a run, surrogates are made from its peaks alone, or from its peaks and
its own pulses, and the collapse of both is found by the same scan. Every other station belongs to
the half that may choose a kind of surrogate; the other half reports (`HALVES`).
"""

import sys
from functools import partial

import numpy as np
import pandas as pd
from rocking.collapse.case import Variant
from rocking.collapse.motion import Motion
from rocking.collapse.ratios import spread
from rocking.collapse.varied import collapses, intensities
from rocking.records import RecordError, load, measures
from rocking.records.surrogate import generate

from studies.surrogates.pulses import pulse_spec

HALVES = ("choosing", "reporting")
WHAT = ["kind", "pulses", "pulses_kept", "draw"]
COLUMNS = ["record", "station", "model", "direction", *WHAT]
COLUMNS += ["pga_collapse_g", "pga_half_g", "pga_max_g"]
NEAR = 1.2  # ratios up to this, or down to its inverse, are near
DISTINCT = 1.1  # directions whose collapse differs by less have no weak side
BY = ["half", "model", "pulses"]
SPREAD = {
    **{"n": "n", "n_censored": "n_censored"},
    "ratio_median": lambda ratios: ratios.percentiles(50, log=True),
    "ratio_p10": lambda ratios: ratios.percentiles(10, log=True),
    "ratio_p90": lambda ratios: ratios.percentiles(90, log=True),
    "scatter": "scatter",
    "within_20_percent": lambda ratios: ratios.share(NEAR**-1 * (1.0 - 1e-12), NEAR),
}
SIDES = ("side_agrees", "n_sides", "side_recorded", "side_surrogate")


def surrogate(record, pulses, seed):
    """Surrogate of a record with its peaks and so many of its pulses, or the most below that.

    And how many were kept; None where the peaks alone have no surrogate.
    """
    peaks = measures(record)
    target = [peaks[name] for name in ("pga_g", "pgv_cm_s", "pgd_cm", "duration_s")]
    for count in range(pulses, -1, -1):
        spec = pulse_spec(record, count) if count else None
        try:
            return generate(record.name, *target, spec=spec, seed=seed), count
        except RecordError as error:
            print(f"{count} pulses: {error}", file=sys.stderr)
    return None, 0


def motions(record, settings, table, seed):
    """Yield values of `WHAT` and the motion of all that is compared; arguments as of `collapse`."""
    if record.source == "surrogate":
        yield ("surrogate", None, None, 0), load(record.name, table, seed=seed)
        return
    yield ("recorded", None, None, 0), record
    for pulses in settings["pulses"]:
        made, kept = surrogate(record, pulses, seed)
        if made is not None:
            yield ("surrogate", pulses, kept, 0), made


def collapse(cases, motion, directions, station, settings, table, seed):
    """Collapse of a recorded motion and of surrogates made for it, by the same scan: COLUMNS.

    Of a record without a file there is its surrogate alone, by its row of the records table. The
    seed is that of the noise.
    """
    find, rows = partial(outcome, level_ratio=settings["level_ratio"]), []
    for what, made in motions(motion.record, settings, table, seed):
        alike = [Variant(about={"station": station, **dict(zip(WHAT, what, strict=True))})]
        rows += collapses(cases, Motion(made), directions, find, alike)
    return pd.DataFrame(rows, columns=COLUMNS)


def outcome(case, motion, direction, level_ratio):
    """Lowest collapse, half-probability collapse and largest amplitude of a climb [g], or NaN.

    The probability at an amplitude is the share that falls within two levels of it.
    """
    how = {"level_ratio": level_ratio, "amplitude_spread": (1.0 + level_ratio) ** 2 - 1.0}
    climbed = intensities(case, motion, direction, search="climb", **how)
    return {
        "pga_collapse_g": climbed["pga_collapse_g"],
        "pga_half_g": climbed["pga_median_g"],
        "pga_max_g": climbed["pga_max_g"],
    }


def half_of(stations):
    """Half of the stations that each belongs to, by their order of appearance."""
    order = {name: i for i, name in enumerate(dict.fromkeys(stations))}
    return np.array([HALVES[order[name] % 2] for name in stations])


def pairs(table):
    """Every surrogate of a table of `COLUMNS` beside its record: with half, recorded_g and ratio.

    ratio is of pga_half_g; NaN where one of the two never collapsed.
    """
    key = ["record", "model", "direction"]
    table = table.assign(half=half_of(table["station"]))
    real = table[table["kind"] == "recorded"].set_index(key)["pga_half_g"].rename("recorded_g")
    surrogates = table[table["kind"] == "surrogate"].join(real, on=key)
    return surrogates.assign(ratio=surrogates["pga_half_g"] / surrogates["recorded_g"])


def sides(group):
    """ln(pos/neg) of the collapse PGA of records and of their surrogates, where both are known.

    Of `pairs` of one model and kind of surrogate; None of one direction alone.
    """
    wide = group.pivot_table(
        index=["record", "draw"], columns="direction", values=["recorded_g", "pga_half_g"]
    )
    if not {("recorded_g", "pos"), ("recorded_g", "neg")} <= set(wide.columns):
        return None
    wide = wide.dropna()
    columns = (("recorded", "recorded_g"), ("surrogate", "pga_half_g"))
    return pd.DataFrame({name: np.log(wide[c, "pos"] / wide[c, "neg"]) for name, c in columns})


def weak_side(group):
    """Whether the weak side stays the weak side, see `summary`: SIDES, blank of one direction."""
    known = sides(group)
    if known is None:
        return dict.fromkeys(SIDES, np.nan)
    real, made = known["recorded"], known["surrogate"]
    clear = np.abs(real) > np.log(DISTINCT)
    agrees = np.mean(np.sign(real[clear]) == np.sign(made[clear]))
    ends = np.median(np.abs(real)), np.median(np.abs(made))
    return dict(zip(SIDES, (agrees, int(clear.sum()), *ends), strict=True))


def summary(table):
    """Distribution of the ratio, and whether the weak side stays the weak side: BY, SPREAD, SIDES.

    half is also "all"; scatter is the standard deviation of ln ratio; side_agrees the share of
    records, among those whose directions differ by more than a tenth, whose surrogate falls at the
    lower PGA in the same direction (one half by chance); side_recorded and side_surrogate the
    medians of |ln(pos/neg)| over all.
    """
    surrogates = pairs(table)
    halves = [surrogates[surrogates["half"] == half] for half in HALVES]
    parts = pd.concat([surrogates.assign(half="all"), *halves])
    weak = [weak_side(group) for _, group in parts.groupby(BY, sort=False)]
    return pd.concat([spread(parts, BY, SPREAD), pd.DataFrame(weak, columns=SIDES)], axis=1)
