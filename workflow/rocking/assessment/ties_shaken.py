"""The code's dynamic check of a façade with rows of ties added, and how strong the rows have to be.

See `ties`. Every mechanism of the tied façade that is shaken is run under all chosen motions. Where
one does not hold, rows that pull on it grow until it does, the others as they are.
"""

import json
import math
from typing import NamedTuple

from rocking.assessment.code_checks import slv_pga
from rocking.assessment.dynamic_check import exceeds, histories, limits_of
from rocking.assessment.shaken import cases, chosen, heights, of_label
from rocking.collapse.case import Variant

LEAST_SHARE, MOST_SHARE = 1e-4, 2.0  # of the façade's weight, of one row
STEP = 0.95  # of the force, between two strengths of the rows
COARSE = 8  # steps at once, until the dynamic check holds
SAME_M = 1e-6  # heights
TRIED = ["forces_kn", "model", "part", "mechanism", "exceed_d0", "mean_d_m", "d_slv_m"]
TRIED += ["histories", "holds"]


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


class Growth(NamedTuple):
    """Rows that grew until a mechanism held.

    Attributes
    ----------
    which : tuple of int
        Those that grew.
    why : Failing
    before : list of TieRow
        All rows before they grew.
    """

    which: tuple
    why: Failing
    before: list


class Shaken:
    """The code's dynamic check of a façade with rows added, mechanism by mechanism.

    Parameters
    ----------
    cases : list of rocking.collapse.case.Case
        Without the rows, one of each model; what fails under the first is held first.
    tied : Tied
    motions : list of (Record, pga_g)
    directions : sequence of str
    """

    def __init__(self, cases, tied, motions, directions):
        """Keep what every trial takes."""
        self.cases, self.tied = cases, tied
        self.models = [case.model for case in cases]
        self.order = [(one, way) for one in motions for way in directions]  # decisive ones first
        self.rows: list[dict] = []  # TRIED, in their order
        self.left: set[str] = set()  # parts that fail and that no added row makes hold
        self._known: dict[str, dict] = {}

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
                return Failing(model, row.part, row.mechanism, held_by(one.mechanism, rows))
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
        known, tried = self._tied(rows)
        if failing.part not in known:
            return True
        case = next(case for case in tried if case.model == failing.model)
        one = known[failing.part]
        part = case if one.whole else case.part(*heights(one))
        return self._run(rows, part, failing.part, one)["holds"]

    def _parts(self, rows, model):
        """Mechanisms by label, and what is shaken of them under one model: row and case."""
        known, tried = self._tied(rows)
        own, demand = self.tied.sections, self.tied.demand
        ranked = [(slv_pga(one, own, demand), one, None) for one in known.values()]
        ranked.sort(key=lambda row: row[0])
        table = chosen(ranked, tried, own["assessment"]["shaken_within"])
        (case,) = (one for one in tried if one.model == model)
        return known, list(cases(case, table))

    def _tied(self, rows):
        """Mechanisms of the façade with these rows by label, and its case of each model."""
        variant = Variant("tied", added={"facade.ties": self.tied.entries(rows)})
        return of_label(self.tied.family(rows)), [case.varied(variant) for case in self.cases]

    def _run(self, rows, part, label, one):
        """Row of TRIED of one part."""
        about = {"forces_kn": forces_said(rows), "model": part.model, "part": label}
        about |= {"mechanism": one.name, **self._of(part, one)}
        if about not in self.rows:
            self.rows.append(about)
        return about

    def _of(self, part, one):
        """Exceeded d0, mean and verdict of one part; histories end once it cannot hold.

        What decided last is run first: it mostly decides again.
        """
        key = json.dumps(part.sections, sort_keys=True)  # model, façade and all
        if key not in self._known:
            limits, total, over, count = limits_of(one.mechanism), 0.0, 0, 0
            most = limits.slv_m * len(self.order)
            for turn in list(self.order):
                (record, pga_g), direction = turn
                table = histories(part.sections, record, direction, [pga_g])
                kept = table[table["status"] != "failed"]
                over += int(exceeds(kept, limits).sum())
                total, count = total + float(kept["d_m"].sum()), count + len(kept)
                if over or total > most:
                    self.order.remove(turn)
                    self.order.insert(0, turn)
                    break
            mean = total / max(count, 1)
            self._known[key] = {
                "exceed_d0": over,
                "mean_d_m": mean,
                "d_slv_m": limits.slv_m,
                "histories": count,
                "holds": bool(count and not over and total <= most and mean <= limits.slv_m),
            }
        return self._known[key]


def _worse(row):
    """Order of rows of TRIED: those that do not hold, then by the mean over d_SLV."""
    return not row["holds"], row["mean_d_m"] / row["d_slv_m"]


def forces_said(rows):
    """Forces of rows [kN], in the order of their heights."""
    return " ".join(f"{1e-3 * row.force_n:.4g}" for row in rows)


def held_by(mechanism, rows):
    """Indices of the rows that pull on a mechanism, the highest first.

    Read off its own pulls: a row at or below its foot, or where it is kept in place, is none.
    """
    pulled = [float(pull.path(0.0)[1].real) for pull in mechanism.pulls]
    own = [k for k, r in enumerate(rows) if any(abs(r.height_m - z) < SAME_M for z in pulled)]
    return sorted(own, key=lambda k: -rows[k].height_m)


def grown(shaken, rows, say=lambda text: None):
    """Rows with which every mechanism holds but those that are left out.

    Model by model, until all hold with the same rows. As long as a mechanism fails, the rows that
    pull on it grow until it holds: all of them by one factor, or one of them alone, whichever
    takes the least force in sum. What none makes hold is left out
    (`Shaken.left`). What grew last has been tried with 0.95 of its force, the other rows as they
    are, and its mechanism did not hold.

    Parameters
    ----------
    shaken : Shaken
    rows : list of TieRow
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
        for model in shaken.models:
            start = None
            while (failing := shaken.failing(rows, model, start)) is not None:
                start = failing.part
                which, found = cheapest(shaken, rows, failing)
                if not which:
                    say(f"{model}, {failing.mechanism}: no row makes it hold")
                    shaken.left.add(failing.part)
                    continue
                governs.append(Growth(which, failing, rows))
                rows = found
                say(f"{model}, {failing.mechanism}: holds with {forces_said(rows)} kN")
        if len(governs) == count:  # and so all models hold with the same rows
            return rows, governs


def cheapest(shaken, rows, failing):
    """Rows that grow for a mechanism, all or one, by the least force in sum, and all rows then."""
    alone = [(k,) for k in failing.rows]
    which, found = (), rows
    for own in [tuple(failing.rows), *alone] if len(alone) > 1 else alone:
        stronger = raised(shaken, rows, own, failing, _sum_n(found) if which else math.inf)
        which, found = (which, found) if stronger is None else (own, stronger)
    return which, found


def raised(shaken, rows, which, failing, most_n=math.inf):
    """Rows of which some grew by steps of 1/0.95 until a mechanism holds; None if it never does.

    In coarse steps up, then the steps between are halved: one step less does not hold. Rows whose
    forces come to `most_n` in sum are not tried.
    """
    strongest_n = MOST_SHARE * shaken.tied.weight_n

    def at(steps):
        return [
            row._replace(force_n=STEP**-steps * row.force_n) if k in which else row
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


def _sum_n(rows):
    """Sum of the forces of rows [N]."""
    return sum(row.force_n for row in rows)
