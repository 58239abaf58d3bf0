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
        self.order = [(one, way) for one in motions for way in directions]  # decisive ones first
        self.rows: list[dict] = []  # TRIED, in their order
        self.final: dict[str, dict] = {}  # worst rows of TRIED by part, of the last whole trial
        self.left: set[str] = set()  # parts that fail and that no added row makes hold
        self._known: dict[str, dict] = {}
        self._first: list[tuple] = []  # model and part of those that failed, the last first

    def failing(self, rows, whole=False):
        """First mechanism that does not hold, or None; those that are left out are passed over.

        Parameters
        ----------
        rows : list of TieRow
        whole : bool
            All mechanisms are run and kept in `final`, also those that are left out.
        """
        known, tried = self._tied(rows)
        own = self.tied.sections["assessment"]
        ranked = [
            (slv_pga(one, self.tied.sections, self.tied.demand), one, None)
            for one in known.values()
        ]
        ranked.sort(key=lambda row: row[0])
        table = chosen(ranked, tried, own["shaken_within"])
        parts = [(row, part) for case in tried for row, part in cases(case, table)]
        models = [case.model for case in self.cases]
        parts.sort(key=lambda p: (models.index(p[1].model), self._turn(p[1].model, p[0].part)))
        first = None
        self.final = {} if whole else self.final
        for row, part in parts:
            if row.part in self.left and not whole:
                continue
            about = self._run(rows, part, row.part, known[row.part])
            if whole:
                self.final[row.part] = max(self.final.get(row.part, about), about, key=_worse)
            if about["holds"] or row.part in self.left:
                continue
            here = held_by(known[row.part].mechanism, rows)
            first = first or Failing(part.model, row.part, row.mechanism, here)
            self._first = [(part.model, row.part), *self._first]
            if not whole:
                break
        return first

    def holds(self, rows, failing):
        """Whether one mechanism holds, that failed with weaker rows; so too where it is no more."""
        known, tried = self._tied(rows)
        if failing.part not in known:
            return True
        case = next(case for case in tried if case.model == failing.model)
        one = known[failing.part]
        part = case if one.whole else case.part(*heights(one))
        return self._run(rows, part, failing.part, one)["holds"]

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

    def _turn(self, model, part):
        """Place in the order of trial: what failed last first."""
        one = model, part
        return self._first.index(one) if one in self._first else len(self._first)

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

    As long as one fails, the rows that pull on it grow until it holds: all of them by one factor,
    or one of them alone, whichever takes the least force in sum. What none makes hold is left out
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
    while (failing := shaken.failing(rows)) is not None:
        which, found = (), None
        alone = [(k,) for k in failing.rows]
        for own in [tuple(failing.rows), *alone] if len(alone) > 1 else alone:
            most_n = math.inf if found is None else _sum_n(found)
            stronger = raised(shaken, rows, own, failing, most_n)
            which, found = (which, found) if stronger is None else (own, stronger)
        if found is None:
            say(f"{failing.model}, {failing.mechanism}: no row makes it hold")
            shaken.left.add(failing.part)
            continue
        governs.append(Growth(which, failing, rows))
        rows = found
        say(f"{failing.model}, {failing.mechanism}: holds with {forces_said(rows)} kN")
    return rows, governs


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
