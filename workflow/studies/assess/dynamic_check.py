"""The Circolare's check by non-linear dynamic analysis, C8.7.1.2.1.9.

SLV and SLC are fulfilled if no analysis exceeds d0 and the mean of the largest displacements does
not exceed d_SLV (d_SLC), with d0, d_SLV and d_SLC those of the capacity curve. The motions are
those of `selection`; the model follows the façade block by block. Displacements are those of the
top relative to the base, of a wall that leans from where it stands, and so are the limits; d/b
counts from the upright and is cut off at 1, where a façade has fallen.

Near collapse a history turns on its last digits. So motions are run as realisations too, which
differ in amplitude, node layout and step, and the verdict is drawn over and over with one
realisation of each motion. A check that is fulfilled in a smaller share of the draws than
`LEAST_DRAWS` hangs on the numerics, and counts as not passed.
"""

import math
from functools import partial
from typing import NamedTuple

import numpy as np
import pandas as pd
from rocking.collapse.case import Case
from rocking.collapse.curve import run_by
from rocking.collapse.quick import LONG_STEP
from rocking.collapse.scan import together

from studies.assess.slv import readings
from yade_scripts.model.facades import Facade
from yade_scripts.model.rest import moved
from yade_scripts.model.shape import shape_of

DRAWS = 2000
# Motions that march at a time: first, those that may end a check; then; of perturbed histories,
# of which some have a step of their own. A vector takes as long for one as for all it holds.
VECTOR, THEN, REPEATED = 8, 16, 8
LEAST_DRAWS = 0.95  # share with which a check that is fulfilled counts as passed
COLUMNS = ["model", "record", "direction", "realisation", "pga_g", "d_over_b", "d_m", "status"]


class Care(NamedTuple):
    """How finely a check is run that is ended once it cannot be passed, by shares of d0."""

    calm: float  # motions that move a façade less by long steps are run by no others
    near: float  # of motions that move a façade less no perturbed history is run


ROUGH = Care(math.inf, 0.5)  # finds rows of ties that are near those of `FINE`
FINE = Care(
    0.2, 0.3
)  # on other motions nothing below 0.45 d0 went beyond d0: docs/record.md#assessment


class Limits(NamedTuple):
    """Displacements of the top [m] at which α vanishes, of SLV and of SLC.

    `bare_m` is d_SLV without the links that give way early; NaN where none does.
    """

    d0_m: float
    slv_m: float
    slc_m: float
    bare_m: float = math.nan


def limits_of(mechanism):
    """`Limits` of a mechanism whose control point is the façade's top, with all its links.

    C8.7.1.2.1.6 takes d_SLV as the least of 0.4 d0 and of the displacement at which a tie or
    another link breaks and takes more than half of the largest acceleration with it. Motions shake
    the façade with that link, so that the least of both counts, also where a brittle anchor breaks
    after a millimetre and elastic sway exceeds it. What the largest of `slv.readings` would say is
    told beside.
    """
    first, *others = (reading.limit(0.4)[0] for reading in readings(mechanism))
    d0_m = mechanism.ultimate()[1]
    return Limits(d0_m, first, 0.6 * d0_m, max(others, default=math.nan))


def limits_with(candidate):
    """`limits_of` a `family.Candidate`, also where it is ranked without some of its links."""
    return limits_of(candidate.letter or candidate.mechanism)


def width_of(facade):
    """b of d/b [m]."""
    return shape_of(facade).overturning_m


def leans_by(facade):
    """Displacement of the top of a façade that leans, at rest: limits count from there [m]."""
    facade, shape = Facade.of(facade), shape_of(facade)
    middle = 0.5 * sum(shape.storeys[-1][2:])
    return moved((shape.thickness_m - middle, shape.top_m), math.radians(facade.tilt_deg))[0]


def histories(job, turns, fraction=None, realisations=0):
    """Largest displacements of one case under some motions, which march side by side.

    Parameters
    ----------
    job : dict
        A case file.
    turns : sequence of ((Motion, pga_g), direction)
    fraction : float, optional
        Step over the stable one; None takes the dense scan's.
    realisations : int
        How many within ± `ensemble.amplitude_spread` of each intensity; 0: each as it is.

    Returns
    -------
    list of DataFrame
        COLUMNS, one a turn.
    """
    case, spread, screens = Case(job), job["ensemble"]["amplitude_spread"], {}
    factors = np.linspace(1.0 - spread, 1.0 + spread, realisations) if realisations else np.ones(1)
    for (motion, _), direction in turns:
        if (key := (id(motion), direction)) not in screens:
            screens[key] = run_by("planar", case, motion, direction, fraction=fraction, brief=True)
    outcomes = together(
        [
            (screens[id(motion), direction], pga_g * factors, bool(realisations))
            for (motion, pga_g), direction in turns
        ]
    )
    tables, width_m, at_rest_m = [], width_of(job["facade"]), leans_by(job["facade"])
    for ((motion, pga_g), direction), table in zip(turns, outcomes, strict=True):
        about = {"model": job["model"], "record": motion.name, "direction": direction}
        about |= {"realisation": np.arange(1, realisations + 1) if realisations else 0}
        columns = {name: table[name].to_numpy() for name in ("d_over_b", "status")}
        about |= {"pga_g": pga_g, "d_m": width_m * columns["d_over_b"] - at_rest_m, **columns}
        tables.append(pd.DataFrame(about)[COLUMNS])
    return tables


def checked(job, motions, directions, limits, realisations, care=FINE):
    """Histories (COLUMNS) for `verdict`: every motion as it is, and perturbed where it tells.

    Motions, (Motion, pga_g), that exceed d0 are perturbed first. Once one exceeds it in all its
    realisations every draw fails, whatever the others do, and no more are run. Of those that stood
    the ones are perturbed that move the façade by more than `care.near` d0; by long steps alone are
    run those that move it by less than `care.calm` d0.
    """
    turns = [(motion, direction) for motion in motions for direction in directions]
    tables = _as_they_are(job, care.calm * limits.d0_m, turns)
    over = [bool(exceeds(table, limits).any()) for table in tables]
    far = [not table["d_m"].max() <= care.near * limits.d0_m for table in tables]
    fell = [turn for turn, beyond in zip(turns, over, strict=True) if beyond]
    every = zip(turns, over, far, strict=True)
    stood = [turn for turn, beyond, moved in every if moved and not beyond]
    for some in (*([turn] for turn in fell), stood) if realisations else ():
        again = histories(job, some, realisations=realisations) if some else []
        tables += again
        if some is not stood and exceeds(again[0], limits).all():
            break
    return pd.concat(tables, ignore_index=True)


def decided(job, turns, limits, realisations, seed, care=FINE, many=map, at_once=1):
    """The check, ended once it cannot be passed.

    Parameters
    ----------
    job : dict
        A case file.
    turns : list of ((Motion, pga_g), direction)
        In the order in which they count.
    limits : Limits
    realisations : int
        Perturbed histories of each motion that moves the façade by more than `care.near` d0.
    seed : int
        See `verdict`.
    care : Care
    many : callable
        As `map`; a pool's runs in some threads.
    at_once : int
        How many. What follows the turn that ends the check is left out: tables are the same.

    Returns
    -------
    about : dict
        exceed_d0, mean_d_m, d_slv_m, histories, agree (share of draws that fulfil it), holds.
    turn : tuple or None
        What ended it.
    """
    tables, far, ended, total_m = [], [], None, 0.0
    once = partial(_as_they_are, job, care.calm * limits.d0_m)
    for turn, table in _run(many, once, turns, at_once, VECTOR):
        tables.append(table)
        d_m = table.loc[table["status"] != "failed", "d_m"].max()
        total_m += 0.0 if np.isnan(d_m) else d_m
        if d_m > care.near * limits.d0_m:
            far.append((d_m, turn))
        if exceeds(table, limits).any() or total_m > limits.slv_m * len(turns):
            ended = turn
            break
    far = sorted(far, key=lambda pair: -pair[0]) if realisations and ended is None else []
    step = LONG_STEP if math.isinf(care.calm) else None
    again = partial(histories, job, fraction=step, realisations=realisations)
    for turn, table in _run(many, again, [turn for _, turn in far], at_once, REPEATED):
        tables.append(table)
        if exceeds(table, limits).sum() > (1.0 - LEAST_DRAWS) * (realisations + 1):
            ended = turn
            break
    table = pd.concat(tables, ignore_index=True)
    if (table["status"] == "failed").all():
        said = {"exceed_d0": 0, "mean_d_m": 0.0, "agree": 1.0, "slv": False}
    else:
        said = verdict(table, limits, seed)
    share = said["agree"] if said["slv"] else 1.0 - said["agree"]
    about = {"exceed_d0": said["exceed_d0"], "mean_d_m": said["mean_d_m"]}
    about |= {"d_slv_m": limits.slv_m, "histories": len(table), "agree": share}
    holds = ended is None and said["slv"] and share >= LEAST_DRAWS
    return about | {"holds": bool(holds)}, ended


def _fulfilled(held, limit_m):
    """1 or 0; NaN without a limit."""
    return math.nan if math.isnan(limit_m) else float(held)


def _run(many, run, turns, at_once, most):
    """Turns and their tables, in turn; up to `most` at a time, and of these `at_once` side by side.

    `THEN` at a time after the first. Whoever stops asking spares those that follow: what ended the
    last check is the first.
    """
    at = 0
    while some := turns[at : at + most * at_once]:
        groups = [some[k::at_once] for k in range(min(at_once, len(some)))]
        tables: list = [None] * len(some)
        for k, of_group in enumerate(many(run, groups)):
            tables[k::at_once] = of_group
        yield from zip(some, tables, strict=True)
        at, most = at + len(some), THEN


def _as_they_are(job, calm_m, turns):
    """Each by long steps, and where it moves by more than `calm_m` by the scan's instead.

    Of courses all by the scan's: long steps spare half of the time there, and what has to be run
    again takes more.
    """
    if job.get("facade", {}).get("courses") and not math.isinf(calm_m):
        return histories(job, turns)
    tables = histories(job, turns, LONG_STEP)
    if math.isinf(calm_m):
        return tables
    moved = [
        k
        for k, table in enumerate(tables)
        if (table["status"] != "ok").any() or not table["d_m"].max() <= calm_m
    ]
    for k, table in zip(moved, histories(job, [turns[k] for k in moved]), strict=True):
        tables[k] = table
    return tables


def exceeds(table, limits):
    """Whether each history exceeds d0."""
    return ((table["status"] == "overturned") | (table["d_m"] > limits.d0_m)).to_numpy()


def surely(verdicts):
    """Whether each row of verdicts is fulfilled for SLV, and in `LEAST_DRAWS` of its draws."""
    return verdicts["slv"].astype(bool) & (verdicts["agree"] >= LEAST_DRAWS)


def verdict(table, limits, seed):
    """The code's verdict on one model, and how far it hangs on the numerics.

    Of histories of one model at one intensity; failed ones are left out and counted. motions,
    exceed_d0, mean_d_m, d0_m, d_slv_m, d_slc_m, slv, slc (fulfilled or not), agree (share of draws
    of one realisation a motion with the same verdict on SLV), failed, worst, nearest (motions);
    d_slv_bare_m, slv_bare: by `Limits.bare_m`, blank where no link gives way early.
    """
    failed = table["status"] == "failed"
    kept = table[~failed].copy()
    kept["over"] = exceeds(kept, limits)
    first = kept[kept["realisation"] == 0]
    mean, over = float(first["d_m"].mean()), int(first["over"].sum())
    slv = over == 0 and mean <= limits.slv_m
    rng = np.random.default_rng(seed)
    d, out = np.zeros(DRAWS), np.zeros(DRAWS, bool)
    groups = list(kept.groupby(["record", "direction"], sort=True))
    for _, part in groups:
        pick = rng.integers(0, len(part), DRAWS)
        d += part["d_m"].to_numpy()[pick]
        out |= part["over"].to_numpy()[pick]
    held = ~out & (d / max(len(groups), 1) <= limits.slv_m)
    worst = first.sort_values(["d_m", "record"]).iloc[-1]
    nearest = first.iloc[(first["d_m"] - limits.slv_m).abs().argmin()]
    return {
        "motions": len(first),
        "exceed_d0": over,
        "mean_d_m": mean,
        "d0_m": limits.d0_m,
        "d_slv_m": limits.slv_m,
        "d_slc_m": limits.slc_m,
        "d_slv_bare_m": limits.bare_m,
        "slv": bool(slv),
        "slv_bare": _fulfilled(over == 0 and mean <= limits.bare_m, limits.bare_m),
        "slc": bool(over == 0 and mean <= limits.slc_m),
        "agree": float(np.mean(held == slv)),
        "failed": int(failed.sum()),
        "worst": worst["record"],
        "worst_d_m": worst["d_m"],
        "nearest": nearest["record"],
        "nearest_d_m": nearest["d_m"],
    }
