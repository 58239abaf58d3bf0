"""The code's dynamic check of a façade with rows of ties added, and how strong the rows have to be.

See `ties`. Every mechanism of the tied façade that is shaken is run under all chosen motions; rows
grow by a common factor until all hold.
"""

import json

from rocking.assessment.code_checks import slv_pga
from rocking.assessment.dynamic_check import exceeds, histories, limits_of
from rocking.assessment.shaken import cases, chosen, of_label
from rocking.collapse.case import Variant

LEAST_SHARE, MOST_SHARE = 1e-4, 2.0  # of the façade's weight, of one row
STEP = 0.95  # of the force, between two strengths of the rows
COARSE = 8  # steps at once, until the dynamic check holds
TRIED = ["factor", "model", "part", "mechanism", "exceed_d0", "mean_d_m", "d_slv_m", "histories"]
TRIED += ["holds"]


class Shaken:
    """The code's dynamic check of a façade with rows added, mechanism by mechanism.

    Parameters
    ----------
    cases : list of rocking.collapse.case.Case
        Without the rows, one of each model.
    tied : Tied
    motions : list of (Record, pga_g)
    directions : sequence of str
    """

    def __init__(self, cases, tied, motions, directions):
        """Keep what every trial takes."""
        self.cases, self.tied = cases, tied
        self.motions, self.directions = motions, directions
        self.rows: list[dict] = []  # TRIED, in their order
        self.final: dict[str, dict] = {}  # worst rows of TRIED by part, of the last whole trial
        self.unheld: set[str] = set()  # parts that fail and that no added row holds
        self._known: dict[str, dict] = {}
        self._first: list[tuple] = []  # model and part of those that failed, the last first

    def holds(self, rows, factor, whole=False, short=False):
        """Whether every mechanism holds under all motions but those that no row holds.

        Parameters
        ----------
        rows : list of Row
        factor : float
            That they stand for, in the table of what was tried.
        whole : bool
            All mechanisms are run, also when one has failed.
        short : bool
            Those alone that failed before, where any did.
        """
        entries = self.tied.entries(rows)
        variant = Variant("tied", added={"facade.ties": entries})
        tried = [case.varied(variant) for case in self.cases]
        family, own = self.tied.family(rows), self.tied.sections["assessment"]
        known = of_label(family)
        ranked = [
            (slv_pga(one, self.tied.sections, self.tied.demand), one, None)
            for one in known.values()
        ]
        ranked.sort(key=lambda row: row[0])
        table = chosen(ranked, tried, own["shaken_within"])
        parts = [(row, part) for case in tried for row, part in cases(case, table)]
        parts.sort(key=lambda p: self._turn(p[1].model, p[0].part))
        if short and self._first:
            parts = [p for p in parts if (p[1].model, p[0].part) in self._first]
        every = True
        self.final = {} if whole else self.final
        for row, part in parts:
            found = self._of(part, known[row.part])
            about = {"factor": factor, "model": part.model, "part": row.part}
            about |= {"mechanism": row.mechanism, **found}
            if about not in self.rows:
                self.rows.append(about)
            if whole:
                self.final[row.part] = max(self.final.get(row.part, about), about, key=_worse)
            if not found["holds"]:
                if not part["facade"]["ties"]:
                    self.unheld.add(row.part)
                    continue
                every, self._first = False, [(part.model, row.part), *self._first]
                if not whole:
                    break
        return every

    def _turn(self, model, part):
        """Place in the order of trial: what failed last first."""
        one = model, part
        return self._first.index(one) if one in self._first else len(self._first)

    def _of(self, part, one):
        """Exceeded d0, mean and verdict of one part; histories end once it cannot hold."""
        key = json.dumps(part.sections, sort_keys=True)  # model, façade and all
        if key not in self._known:
            limits, total, over, count = limits_of(one.mechanism), 0.0, 0, 0
            most = limits.slv_m * len(self.motions) * len(self.directions)
            for record, pga_g in self.motions:
                for direction in self.directions:
                    table = histories(part.sections, record, direction, [pga_g])
                    kept = table[table["status"] != "failed"]
                    over += int(exceeds(kept, limits).sum())
                    total, count = total + float(kept["d_m"].sum()), count + len(kept)
                if over or total > most:
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


def stronger(shaken, rows, by_hand=True, say=lambda text: None):
    """Factor on all rows with which the dynamic check holds.

    It goes up in coarse steps until the check holds, then halves the steps between: the next weaker
    one, by 0.95, does not hold. On the way only those mechanisms are run that failed before; what
    is found is held to all of them.

    Parameters
    ----------
    shaken : Shaken
    rows : list of Row
    by_hand : bool
        Whether weaker rows fail by hand; else it goes down too.
    say : callable
        Receives a line a trial.

    Returns
    -------
    float or None
        None: it does not hold at the strongest either.
    """
    forces, weight_n = [row.force_n for row in rows], shaken.tied.weight_n

    def tried(steps, short=True):
        factor = STEP**-steps
        own = [row._replace(force_n=factor * row.force_n) for row in rows]
        held = shaken.holds(own, factor, short=short)
        say(f"rows times {factor:.3g}: {'hold' if held else 'do not hold'}")
        return held

    low, high = 0, COARSE
    if tried(0, short=False):
        if by_hand:
            return 1.0
        low, high = -COARSE, 0
        while tried(low):
            low, high = low - COARSE, low
            if STEP**-high * max(forces) < LEAST_SHARE * weight_n:
                break
    while True:
        while low >= 0 and not tried(high):
            low, high = high, high + COARSE
            if STEP**-high * min(forces) > MOST_SHARE * weight_n:
                return None
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (low, middle) if tried(middle) else (middle, high)
        if tried(high, short=False):
            return STEP**-high
        low, high = high, (min(high + COARSE, 0) if high < 0 else high + COARSE)
