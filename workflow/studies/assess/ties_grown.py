"""How strong rows of ties have to be under the chosen motions: grown, then lowered; see `ties`.

Where a mechanism does not hold, rows that pull on it grow until it does, the others as they are
(`grown`). Then each row gives back what the others' growth has made needless (`lowered`).
"""

import math
from typing import NamedTuple

from studies.assess.dynamic_check import ROUGH
from studies.assess.ties_shaken import Failing, behind, forces_said

LEAST_SHARE, MOST_SHARE = 1e-4, 2.0  # of the façade's weight, of one row
STEP = 0.95  # of the force, between two strengths of the rows
COARSE = 8  # steps at once at most, until the dynamic check holds
BY_HAND = Failing("", "", "", [])  # what fails are the checks by hand


class Growth(NamedTuple):
    """Rows that grew until a mechanism held, by number, and what failed before."""

    which: tuple
    why: Failing


def grown(shaken, rows, models, say=lambda text: None, every=True):
    """Rows with which every mechanism holds but those that are left out.

    Model by model, until all hold with the same rows. As long as a mechanism fails, the rows that
    pull on it grow until it holds: all of them by one factor, or one of them alone, whichever
    takes the least force in sum; where none does, a level that has no row yet gets one. What none
    makes hold is left out (`Shaken.left`); where not `every` mechanism is asked for, the search
    ends there.

    Rows are one at each level, ascending, of 0 N where none is yet. `say` receives a line a
    mechanism. Returns the rows, and every `Growth` in turn.
    """
    governs: list[Growth] = []
    while True:
        count = len(governs)
        for model in models:
            start = None
            while (failing := shaken.failing(rows, model, start)) is not None:
                start = failing.part
                which, stronger = cheapest(shaken, rows, failing)
                if not which:
                    say(f"{model}, {failing.mechanism}: no row makes it hold")
                    shaken.left.add(failing.part)
                    if not every:
                        return rows, governs
                    continue
                governs.append(Growth(which, failing))
                rows = stronger
                say(f"{model}, {failing.mechanism}: holds with {forces_said(rows)} kN")
        if len(governs) == count:  # and so all models hold with the same rows
            return rows, governs


def cheapest(shaken, rows, failing):
    """Rows that grow for a mechanism, all or one, by the least force in sum, and all rows then.

    Those that are there; if they do not make it hold, those of levels without a row.
    """
    which, stronger = _of_these(shaken, rows, failing, failing.rows)
    if not which and (absent := free_levels(shaken, rows, failing)):
        which, stronger = _of_these(shaken, rows, failing, absent)
        if which and not shaken.tied.passes(stronger, shaken.beyond):
            return (), rows  # the wall bends about the new row
    return which, stronger


def _of_these(shaken, rows, failing, indices):
    """All of some rows or one of them, by the least force in sum, and all rows then.

    What adds the least force a step is tried first: the others may then add no more than it did.
    """
    every = [*((k,) for k in indices), *([tuple(indices)] if len(indices) > 1 else [])]
    which, best = (), rows
    for some in sorted(every, key=lambda some: sum_n(rows[k] for k in some)):
        stronger = raised(shaken, rows, some, failing, sum_n(best) if which else math.inf)
        which, best = (which, best) if stronger is None else (some, stronger)
    return which, best


def free_levels(shaken, rows, failing):
    """Indices of levels without a row at which one would pull on a mechanism."""
    indices = []
    for k, row in enumerate(rows):
        if row.force_n:
            continue
        weak = with_force(rows, k, least_n(shaken))
        known, _ = shaken.tied.mechanisms(weak)
        if failing.part in known and k in behind(known[failing.part], weak):
            indices.append(k)
    return indices


def least_n(shaken):
    """Force of the weakest row that is tried [N]."""
    return LEAST_SHARE * shaken.tied.weight_n


def raised(shaken, rows, which, failing, most_n=math.inf):
    """Rows of which some grew by steps of 1/0.95 until a mechanism holds; None if it never does.

    In coarse steps up, then the steps between are halved: one step less does not hold. Rows that
    were found roughly before need few steps more: up by 1, 2, 4 and so on. Rows whose forces come
    to `most_n` in sum are not tried.
    """
    heaviest_n = MOST_SHARE * shaken.tied.weight_n
    strongest_n = {k: min(heaviest_n, shaken.tied.most_n(rows[k].height_m)) for k in which}

    def at(steps):
        return [
            row._replace(force_n=STEP**-steps * (row.force_n or least_n(shaken)))
            if k in which
            else row
            for k, row in enumerate(rows)
        ]

    def allowed(steps):
        trial = at(steps)
        return sum_n(trial) < most_n and all(trial[k].force_n <= strongest_n[k] for k in which)

    low, high = 0, COARSE if shaken.care == ROUGH else 1
    while True:
        while high > low and not allowed(high):
            high -= 1
        if high == low:
            return None
        if shaken.holds(at(high), failing):
            break
        low, high = high, high + min(COARSE, 2 * (high - low))
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if shaken.holds(at(middle), failing) else (middle, high)
    return at(high)


def lowered(shaken, rows, models, say=lambda text: None, likely=None):
    """Rows of which none could be a step weaker, the others as they are, and what then fails.

    The strongest first. A row that all checks do without goes; one that gives back some of its
    force puts the others to the question again. So 0.95 of each row has been tried beside the
    others as they are at the end, and does not pass.

    With the rows given every mechanism holds that is not left out; `likely` says by row what is
    tried first. Returns the rows, and by row what fails with a step less: a `Failing`, `BY_HAND`
    for the checks by hand, None for no row.
    """
    why: list[Failing | None] = [None] * len(rows)
    likely = likely or why
    while open_rows := [k for k, row in enumerate(rows) if row.force_n and why[k] is None]:
        k = max(open_rows, key=lambda k: rows[k].force_n)
        force_n, reason = _least_of(shaken, rows, k, models, likely[k])
        if force_n < rows[k].force_n:
            rows = with_force(rows, k, force_n)
            why = [None] * len(rows)
            say(f"row at {rows[k].height_m:g} m given back: {forces_said(rows)} kN")
        why[k] = reason
    return rows, why


def _least_of(shaken, rows, k, models, likely=None):
    """Least force of a row, steps of 0.95 down, and what fails one step below; (0, None): none."""
    reason = likely

    def fails(force_n):
        nonlocal reason
        failing = first_failing(shaken, with_force(rows, k, force_n), models, reason)
        reason = failing or reason
        return failing is not None

    force_n = rows[k].force_n
    if not fails(0.0):
        return 0.0, None
    if fails(STEP * force_n):
        return force_n, reason
    low, high = 1, 1 + COARSE
    while STEP**high * force_n > least_n(shaken) and not fails(STEP**high * force_n):
        low, high = high, high + COARSE
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if fails(STEP**middle * force_n) else (middle, high)
    return STEP**low * force_n, reason


def with_force(rows, k, force_n):
    """Rows of which one has another force."""
    return [*rows[:k], rows[k]._replace(force_n=force_n), *rows[k + 1 :]]


def first_failing(shaken, rows, models, like=None):
    """What fails with these rows, by hand or shaken; None if all holds.

    `like`: what failed with other rows, which is tried first.
    """
    if not shaken.tied.passes(rows, shaken.beyond):
        return BY_HAND
    for model in sorted(models, key=lambda model: like is None or model != like.model):
        start = like.part if like and like.model == model else None
        failing = shaken.failing(rows, model, start)
        if failing is not None:
            return failing
    return None


def sum_n(rows):
    """Sum of the forces of rows [N]."""
    return sum(row.force_n for row in rows)
