"""How far a surrogate stands for its record: distributions of the ratio of their collapse PGA.

For each recorded motion of a run, surrogates are made from its peaks alone, or from its peaks and
its own pulses, and the collapse of both is found by the same scan. Every other station belongs to
the half that may choose a kind of surrogate; the other half reports (`HALVES`).
"""

import itertools
import sys
from functools import partial

import numpy as np
import pandas as pd

from rocking.collapse.case import Variant
from rocking.collapse.motion import Motion
from rocking.collapse.ratios import Ratios, spread
from rocking.collapse.varied import collapses, intensities
from rocking.records import RecordError, load, measures
from rocking.records.pulses import pulse_spec
from rocking.records.surrogate import generate
from rocking.runtime.drawing import drawing
from yade_scripts.model.registry import MODELS

HALVES = ("choosing", "reporting")
WHAT = ["kind", "pulses", "pulses_kept", "draw"]
COLUMNS = ["record", "station", "model", "direction", *WHAT]
COLUMNS += ["pga_collapse_g", "pga_half_g", "pga_max_g"]
SCATTER = [
    *("record", "model", "direction", "pulses", "draws", "n_censored"),
    *("pga_p10_g", "pga_median_g", "pga_p90_g", "scatter", "recorded_g", "share_below"),
]
NEAR = 1.2  # ratios up to this, or down to its inverse, are near
DISTINCT = 1.1  # directions whose collapse differs by less have no weak side
BY = ["half", "model", "pulses"]
SPREAD = {
    **{"n": "n", "n_censored": "n_censored"},
    "ratio_median": lambda found: found.percentiles(50, log=True),
    "ratio_p10": lambda found: found.percentiles(10, log=True),
    "ratio_p90": lambda found: found.percentiles(90, log=True),
    "scatter": "scatter",
    "within_20_percent": lambda found: found.share(NEAR**-1 * (1.0 - 1e-12), NEAR),
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
    draws = range(settings["draws"])
    if record.source == "surrogate":
        for draw in draws:
            yield ("surrogate", None, None, draw), load(record.name, table, seed=seed + draw)
        return
    yield ("recorded", None, None, 0), record
    for pulses, draw in itertools.product(settings["pulses"], draws):
        made, kept = surrogate(record, pulses, seed + draw)
        if made is not None:
            yield ("surrogate", pulses, kept, draw), made


def collapse(cases, motion, directions, station, settings, table, seed):
    """Collapse of a recorded motion and of surrogates made for it, by the same scan: COLUMNS.

    Of a record without a file there are surrogates alone, by its row of the records table. The seed
    is that of the first draw's noise.
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
    found = intensities(case, motion, direction, search="climb", **how)
    return {
        "pga_collapse_g": found["pga_collapse_g"],
        "pga_half_g": found["pga_median_g"],
        "pga_max_g": found["pga_max_g"],
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
    found = table[table["kind"] == "surrogate"].join(real, on=key)
    return found.assign(ratio=found["pga_half_g"] / found["recorded_g"])


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
    found = pairs(table)
    halves = [found[found["half"] == half] for half in HALVES]
    parts = pd.concat([found.assign(half="all"), *halves])
    weak = [weak_side(group) for _, group in parts.groupby(BY, sort=False)]
    return pd.concat([spread(parts, BY, SPREAD), pd.DataFrame(weak, columns=SIDES)], axis=1)


def scatter(table):
    """How far draws of a surrogate differ, curve by curve, and where its record lies: SCATTER.

    Of pga_half_g [g]: scatter is the standard deviation of its logarithm over the draws that
    collapsed, share_below the share of draws that collapse at a lower PGA than the record; blank
    without a record. `pulses` is blank where the parameters are a table's.
    """
    found = pairs(table)
    rows = []
    key = ["record", "model", "direction", "pulses"]
    for names, group in found.groupby(key, sort=False, dropna=False):
        draws, recorded = Ratios(group["pga_half_g"]), group["recorded_g"].iloc[0]
        below = np.mean(group["pga_half_g"] < recorded) if np.isfinite(recorded) else np.nan
        ends = draws.percentiles([10, 50, 90])
        counts = draws.n, draws.n_censored
        rows.append((*names, *counts, *ends, draws.scatter, recorded, below))
    return pd.DataFrame(rows, columns=SCATTER)


@drawing
def _draw_title(pulses):
    """Say which surrogates a panel has; a number below zero: of a table's parameters."""
    if pulses < 0:
        return "parameters of the table"
    return "peaks alone" if pulses == 0 else f"peaks and {pulses:g} pulses"


@drawing
def draw(table, summary):
    """Draw collapse of surrogates over that of their records, and the weak sides of both."""
    from rocking.figures import style
    from rocking.figures.panels import distribution, panels, ticks

    found = pairs(table)
    trust = summary[summary["half"] == "all"].set_index(["model", "pulses"])
    kinds = sorted(found["pulses"].unique())
    models = list(dict.fromkeys(found["model"]))
    both = found["direction"].nunique() > 1  # else no side is the weak one
    size, around = (2.2, 3.0 if not both else 2.7), (2.2, 0.0)
    count = (1 + both) * len(kinds)
    figure, axes = panels(count, len(kinds), size, around, sharex="row", sharey="row")
    for column, pulses in enumerate(kinds):
        top = axes[0, column]
        for i, model in enumerate(models):
            kind = MODELS[model]
            part = found[(found["pulses"] == pulses) & (found["model"] == model)]
            facts = trust.loc[model, pulses]
            label = f"{model}: {facts['ratio_median']:.2f}, scatter {facts['scatter']:.2f}"
            look = {"color": kind.colour, "ls": ("-", "--")[i % 2], "drawstyle": "steps-mid"}
            distribution(top, part["ratio"], label=label, **look)
            known = sides(part)
            if known is None:
                continue
            x, y = (known[name] / np.log(2.0) for name in ("recorded", "surrogate"))
            look = {"color": kind.colour, "label": model}
            axes[1, column].plot(x, y, kind.marker, ms=4, alpha=0.8, **look)
        top.axvline(1.0, color=style.GREY, lw=0.8, zorder=0)
        top.set(xscale="log", title=_draw_title(pulses), ylim=(0, 1))
        ticks(top.xaxis, (0.33, 0.5, 1.0, 2.0, 3.0), ("1/3", "1/2", "1", "2", "3"))
        top.set_xlabel("collapse PGA, surrogate / recorded [-]")
        top.legend(loc="lower right", fontsize=7)
        for bottom in axes[1:, column]:
            for line in (bottom.axhline, bottom.axvline):
                line(0.0, color=style.GREY, lw=0.8, zorder=0)
            bottom.set_xlabel("log₂(pos/neg), recorded [-]")
    axes[0, 0].set_ylabel("share of curves [-]")
    if both:
        axes[1, 0].set_ylabel("log₂(pos/neg), surrogate [-]")
        axes[1, 0].legend(loc="lower right", fontsize=7)
    records = found["record"].nunique()
    figure.suptitle(f"recorded components: {records}\nand surrogates of theirs")
    return figure


@drawing
def draw_scatter(table):
    """Draw collapse under draws that differ in their noise alone, and under the record."""
    from rocking.figures import style
    from rocking.figures.panels import common_legend, panels, plain_log

    found = pairs(table)
    found["pulses"] = found["pulses"].fillna(-1)
    kinds, models = sorted(found["pulses"].unique()), list(dict.fromkeys(found["model"]))
    rows = list(dict.fromkeys(zip(found["record"], found["direction"], strict=True)))
    size, around = (2.4, 0.42 * len(rows)), (2.4, 1.0)
    figure, axes = panels(len(kinds), len(kinds), size, around, sharex=True, sharey=True)
    for axis, pulses in zip(axes.flat, kinds, strict=True):
        groups = found[found["pulses"] == pulses].groupby(["record", "direction", "model"])
        for (record, direction, model), group in groups:
            kind, beside = MODELS[model], models.index(model) - 0.5 * (len(models) - 1)
            place = rows.index((record, direction)) + 0.36 * beside
            half, most = group["pga_half_g"], group["pga_max_g"]
            look = {"color": kind.colour, "marker": kind.marker, "ls": "", "alpha": 0.6}
            for values, face in ((half, kind.colour), (most[half.isna()], "none")):
                label = f"{model}, draws" if face != "none" else None
                axis.plot(values, np.full(len(values), place), mfc=face, label=label, **look)
            recorded = group["recorded_g"].iloc[0]
            if np.isfinite(recorded):
                ends = place - 0.16, place + 0.16
                axis.vlines(recorded, *ends, color="k", lw=1.8, label="recorded")
            said = f"{np.log(half).std():.2f}"
            axis.annotate(
                said, (1.0, place), (2, 0), ("axes fraction", "data"), "offset points", va="center"
            )
        axis.set_title(_draw_title(pulses), loc="left")
        axis.set(xscale="log", xlabel="collapse PGA [g]")
        plain_log(axis.xaxis, (1.0, 2.0, 3.0, 5.0))
    names = [f"{record} {style.SIGNS[direction]}" for record, direction in rows]
    axes[0, 0].set_yticks(range(len(rows)), names)
    axes[0, 0].invert_yaxis()
    common_legend(figure, loc="outside upper center", ncols=3)
    return figure
