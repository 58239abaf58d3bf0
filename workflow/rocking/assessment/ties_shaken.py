"""The code's dynamic check of a façade with rows of ties added, and how strong the rows have to be.

See `ties`. Every mechanism of the tied façade that is shaken is run under all chosen motions. Where
one does not hold, rows that pull on it grow until it does, the others as they are (`grown`). Then
each row gives back what the others' growth has made needless (`lowered`).

Near collapse a history turns on its last digits, with the force as with the amplitude: a row may
hold where a stronger one does not. So a mechanism holds only if it does in the share
`dynamic_check.LEAST_DRAWS` of draws of perturbed histories too, as in the report's verdict.
"""

import json
import math
from typing import NamedTuple

from rocking.assessment.dynamic_check import FINE, decided, limits_of
from rocking.assessment.shaken import cases, chosen, heights
from rocking.collapse.case import Variant
from yade_scripts.model.part import LEVEL_M, NEAR_M

LEAST_SHARE, MOST_SHARE = 1e-4, 2.0  # of the façade's weight, of one row
STEP = 0.95  # of the force, between two strengths of the rows
COARSE = 8  # steps at once, until the dynamic check holds
TRIED = ["forces_kn", "model", "part", "mechanism", "exceed_d0", "mean_d_m", "d_slv_m"]
TRIED += ["histories", "agree", "holds", "fine"]


class Failing(NamedTuple):
    """A mechanism that does not hold: its model, label and name, and what holds it.

    Attributes
    ----------
    model, part, mechanism : str
    rows : list of int
        Of the added rows those that hold it, the highest first.
    """

    model: str
    part: str
    mechanism: str
    rows: list


BY_HAND = Failing("", "", "", [])  # what fails are the checks by hand


class Growth(NamedTuple):
    """Rows that grew until a mechanism held.

    Attributes
    ----------
    which : tuple of int
        Those that grew.
    why : Failing
    """

    which: tuple
    why: Failing


class Shaken:
    """The code's dynamic check of a façade with rows added, mechanism by mechanism.

    Parameters
    ----------
    cases : list of rocking.collapse.case.Case
        Without the rows, one of each model; what fails under the first is held first.
    tied : Tied
    motions : list of (Record, pga_g)
    directions : sequence of str
    many, at_once
        See `dynamic_check.decided`.
    """

    def __init__(self, cases, tied, motions, directions, many=map, at_once=1):
        """Keep what every trial takes."""
        self.pool = {"many": many, "at_once": at_once}
        self.cases, self.tied = cases, tied
        self.models = [case.model for case in cases]
        self.order = [(one, way) for one in motions for way in directions]  # decisive ones first
        self.rows: list[dict] = []  # TRIED, in their order
        self.left: set[str] = set()  # parts that fail and that no added row makes hold
        self.beyond: set[str] = set()  # of these, parts that fail by hand too
        self.care = FINE
        self._known: dict[tuple, dict] = {}
        self._by_rows: dict[tuple, tuple] = {}

    def failing(self, rows, model, start=None):
        """First mechanism of one model that does not hold; those that are left out are passed over.

        Parameters
        ----------
        rows : list of TieRow
        model : str
        start : str, optional
            Label of the mechanism to begin with; those before it come last.

        Returns
        -------
        Failing or None
        """
        known, parts = self._parts(rows, model)
        labels = [row.part for row, _ in parts]
        first = labels.index(start) if start in labels else 0
        for row, part in [*parts[first:], *parts[:first]]:
            one = known[row.part]
            if row.part not in self.left and not self._run(rows, part, row.part, one)["holds"]:
                return Failing(model, row.part, row.mechanism, behind(one, rows))
        return None

    def everything(self, rows):
        """Run all mechanisms of all models, also those that are left out: the worst by part."""
        final: dict[str, dict] = {}
        for model in self.models:
            known, parts = self._parts(rows, model)
            for row, part in parts:
                about = self._run(rows, part, row.part, known[row.part])
                final[row.part] = max(final.get(row.part, about), about, key=_worse)
        return final

    def holds(self, rows, failing):
        """Whether one mechanism holds, that failed with weaker rows; so too where it is no more."""
        known, tried, _ = self._tied(rows)
        if failing.part not in known:
            return True
        case = next(case for case in tried if case.model == failing.model)
        one = known[failing.part]
        part = case if one.whole else case.part(*heights(one))
        return self._run(rows, part, failing.part, one)["holds"]

    def _parts(self, rows, model):
        """Mechanisms by label, and what is shaken of them under one model: row and case."""
        known, tried, pga_g = self._tied(rows)
        ranked = [(pga_g[name], one, None) for name, one in known.items()]
        ranked.sort(key=lambda row: row[0])
        table = chosen(ranked, tried, self.tied.sections["assessment"]["shaken_within"])
        (case,) = (one for one in tried if one.model == model)
        return known, list(cases(case, table))

    def _tied(self, rows):
        """Mechanisms with these rows by label, the case of each model, and PGAs by hand."""
        if (key := tuple(rows)) not in self._by_rows:
            variant = Variant("tied", added={"facade.ties": self.tied.entries(rows)})
            known, pga_g = self.tied.mechanisms(rows)
            self._by_rows[key] = known, [case.varied(variant) for case in self.cases], pga_g
        return self._by_rows[key]

    def _run(self, rows, part, label, one):
        """Row of TRIED of one part."""
        about = {"forces_kn": forces_said(rows), "model": part.model, "part": label}
        about |= {"mechanism": one.name, **self._of(part, one), "fine": int(self.care == FINE)}
        if about not in self.rows:
            self.rows.append(about)
        return about

    def _of(self, part, one):
        """What the check says of one part; what decided last is run first: it mostly does again."""
        key = json.dumps(part.sections, sort_keys=True), self.care  # model, façade and all
        if key not in self._known:
            own, limits = self.tied.sections, limits_of(one.mechanism)
            count = own["assessment"]["dynamic_realisations"]
            given = part.sections, self.order, limits, count, own["seed"]
            about, turn = decided(*given, self.care, **self.pool)
            if turn is not None:
                self.order.remove(turn)
                self.order.insert(0, turn)
            self._known[key] = about
        return self._known[key]


def _worse(row):
    """Order of rows of TRIED: those that do not hold, then by the mean over d_SLV."""
    return not row["holds"], row["mean_d_m"] / row["d_slv_m"]


def forces_said(rows):
    """Forces of rows [kN], in the order of their heights."""
    return " ".join(f"{1e-3 * row.force_n:.4g}" for row in rows)


def behind(one, rows):
    """Indices of the rows behind a part that is shaken, the highest first: those its case has.

    Also the row at the level that holds a part in bending: by hand that level stays, shaken it
    gives as a row of its strength does.
    """
    foot_m, held_m, _ = heights(one)
    top_m = math.inf if held_m is None else held_m + LEVEL_M
    own = [k for k, r in enumerate(rows) if r.force_n and foot_m + NEAR_M < r.height_m < top_m]
    return sorted(own, key=lambda k: -rows[k].height_m)


def grown(shaken, rows, models, say=lambda text: None):
    """Rows with which every mechanism holds but those that are left out.

    Model by model, until all hold with the same rows. As long as a mechanism fails, the rows that
    pull on it grow until it holds: all of them by one factor, or one of them alone, whichever
    takes the least force in sum; where none does, a level that has no row yet gets one. What none
    makes hold is left out (`Shaken.left`).

    Parameters
    ----------
    shaken : Shaken
    rows : list of TieRow
        One at each level, ascending; 0 N: none there yet.
    models : sequence of str
    say : callable
        Receives a line a mechanism.

    Returns
    -------
    rows : list of TieRow
    governs : list of Growth
        In turn.
    """
    governs: list[Growth] = []
    while True:
        count = len(governs)
        for model in models:
            start = None
            while (failing := shaken.failing(rows, model, start)) is not None:
                start = failing.part
                which, found = cheapest(shaken, rows, failing)
                if not which:
                    say(f"{model}, {failing.mechanism}: no row makes it hold")
                    shaken.left.add(failing.part)
                    continue
                governs.append(Growth(which, failing))
                rows = found
                say(f"{model}, {failing.mechanism}: holds with {forces_said(rows)} kN")
        if len(governs) == count:  # and so all models hold with the same rows
            return rows, governs


def cheapest(shaken, rows, failing):
    """Rows that grow for a mechanism, all or one, by the least force in sum, and all rows then.

    Those that are there; if they do not make it hold, those of levels without a row.
    """
    which, found = _of_these(shaken, rows, failing, failing.rows)
    if not which and (absent := free_levels(shaken, rows, failing)):
        which, found = _of_these(shaken, rows, failing, absent)
        if which and not shaken.tied.passes(found, shaken.beyond):
            return (), rows  # the wall bends about the new row
    return which, found


def _of_these(shaken, rows, failing, own):
    """All of some rows or one of them, by the least force in sum, and all rows then."""
    alone = [(k,) for k in own]
    which, found = (), rows
    for some in [tuple(own), *alone] if len(alone) > 1 else alone:
        stronger = raised(shaken, rows, some, failing, _sum_n(found) if which else math.inf)
        which, found = (which, found) if stronger is None else (some, stronger)
    return which, found


def free_levels(shaken, rows, failing):
    """Indices of levels without a row at which one would pull on a mechanism."""
    found = []
    for k, row in enumerate(rows):
        if row.force_n:
            continue
        weak = [*rows[:k], row._replace(force_n=least_n(shaken)), *rows[k + 1 :]]
        known, _ = shaken.tied.mechanisms(weak)
        if failing.part in known and k in behind(known[failing.part], weak):
            found.append(k)
    return found


def least_n(shaken):
    """Force of the weakest row that is tried [N]."""
    return LEAST_SHARE * shaken.tied.weight_n


def raised(shaken, rows, which, failing, most_n=math.inf):
    """Rows of which some grew by steps of 1/0.95 until a mechanism holds; None if it never does.

    In coarse steps up, then the steps between are halved: one step less does not hold. Rows whose
    forces come to `most_n` in sum are not tried.
    """
    strongest_n = MOST_SHARE * shaken.tied.weight_n

    def at(steps):
        return [
            row._replace(force_n=STEP**-steps * (row.force_n or least_n(shaken)))
            if k in which
            else row
            for k, row in enumerate(rows)
        ]

    def allowed(steps):
        own = at(steps)
        return _sum_n(own) < most_n and all(own[k].force_n <= strongest_n for k in which)

    low, high = 0, COARSE
    while True:
        while high > low and not allowed(high):
            high -= 1
        if high == low:
            return None
        if shaken.holds(at(high), failing):
            break
        low, high = high, high + COARSE
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if shaken.holds(at(middle), failing) else (middle, high)
    return at(high)


def lowered(shaken, rows, models, say=lambda text: None, likely=None):
    """Rows of which none could be a step weaker, the others as they are, and what then fails.

    The strongest first. A row that all checks do without goes; one that gives back some of its
    force puts the others to the question again. So 0.95 of each row has been tried beside the
    others as they are at the end, and does not pass.

    Parameters
    ----------
    shaken : Shaken
    rows : list of TieRow
        With which every mechanism holds that is not left out.
    models : sequence of str
    say : callable
        Receives a line for a row that gives force back.
    likely : list of Failing or None, optional
        By row what is tried first.

    Returns
    -------
    rows : list of TieRow
    why : list of Failing or None
        By row what fails with a step less; `BY_HAND` for the checks by hand, None for no row.
    """
    why: list[Failing | None] = [None] * len(rows)
    likely = likely or why
    while open_rows := [k for k, row in enumerate(rows) if row.force_n and why[k] is None]:
        k = max(open_rows, key=lambda k: rows[k].force_n)
        force_n, reason = _least_of(shaken, rows, k, models, likely[k])
        if force_n < rows[k].force_n:
            rows = _with(rows, k, force_n)
            why = [None] * len(rows)
            say(f"row at {rows[k].height_m:g} m given back: {forces_said(rows)} kN")
        why[k] = reason
    return rows, why


def _least_of(shaken, rows, k, models, likely=None):
    """Least force of a row, steps of 0.95 down, and what fails one step below; (0, None): none."""
    reason = likely

    def fails(force_n):
        nonlocal reason
        found = first_failing(shaken, _with(rows, k, force_n), models, reason)
        reason = found or reason
        return found is not None

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


def _with(rows, k, force_n):
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


def _sum_n(rows):
    """Sum of the forces of rows [N]."""
    return sum(row.force_n for row in rows)
