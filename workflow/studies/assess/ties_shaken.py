"""The code's dynamic check of a façade with rows of ties added; see `ties`.

Every mechanism of the tied façade that is shaken is run under all chosen motions.

Near collapse a history turns on its last digits, with the force as with the amplitude: a row may
hold where a stronger one does not. So a mechanism holds only if it does in the share
`dynamic_check.LEAST_DRAWS` of draws of perturbed histories too, as in the report's verdict.
"""

import json
import math
from typing import NamedTuple

from rocking.collapse.case import Variant

from studies.assess.dynamic_check import FINE, decided, limits_with
from studies.assess.shaken import cases, chosen, heights, part_of
from yade_scripts.model.part import LEVEL_M, NEAR_M

TRIED = ["forces_kn", "model", "part", "mechanism", "exceed_d0", "mean_d_m", "d_slv_m"]
TRIED += ["histories", "agree", "holds", "fine"]


class Failing(NamedTuple):
    """A mechanism that does not hold, and the added rows that hold it, the highest first."""

    model: str
    part: str  # its label
    mechanism: str  # its name
    rows: list  # numbers


class Shaken:
    """The code's dynamic check of a façade with rows added, mechanism by mechanism.

    Parameters
    ----------
    cases : list of rocking.collapse.case.Case
        Without the rows, one of each model; what fails under the first is held first.
    tied : Tied
    motions : list of (Motion, pga_g)
    directions : sequence of str
    many : callable
        As `map`; a pool's runs in some threads.
    at_once : int
        How many. Tables are the same.
    """

    def __init__(self, cases, tied, motions, directions, many=map, at_once=1):
        """Keep what every trial takes."""
        self.many, self.at_once = many, at_once
        self.cases, self.tied = cases, tied
        self.models = [case.model for case in cases]
        self.order = [(motion, way) for motion in motions for way in directions]  # decisive first
        self.rows: list[dict] = []  # TRIED, in their order
        self.left: set[str] = set()  # parts that fail and that no added row makes hold
        self.beyond: set[str] = set()  # of these, parts that fail by hand too
        self.care = FINE
        self._known: dict[tuple, dict] = {}
        self._by_rows: dict[tuple, tuple] = {}

    def failing(self, rows, model, start=None):
        """First mechanism of one model that does not hold, as `Failing`; None where all hold.

        Those that are left out are passed over. `start` is the label to begin with; those before
        it come last.
        """
        known, parts = self._parts(rows, model)
        labels = [row.part for row, _ in parts]
        first = labels.index(start) if start in labels else 0
        turn = [*parts[first:], *parts[:first]]
        turn = [(row, part) for row, part in turn if row.part not in self.left]
        for k, (row, part) in enumerate(turn):
            candidate = known[row.part]
            if k % self.at_once == 0:
                some = turn[k : k + self.at_once]
                self._ahead([(part, known[row.part]) for row, part in some])
            if not self._run(rows, part, row.part, candidate)["holds"]:
                return Failing(model, row.part, row.mechanism, behind(candidate, rows))
        return None

    def everything(self, rows):
        """Run all mechanisms of all models, also those that are left out: by part and model."""
        final: dict[str, dict] = {}
        for model in self.models:
            known, parts = self._parts(rows, model)
            self._ahead([(part, known[row.part]) for row, part in parts])
            for row, part in parts:
                about = self._run(rows, part, row.part, known[row.part])
                final.setdefault(row.part, {})[model] = about
        return final

    def cases_with(self, rows):
        """Case of each model with rows added."""
        return self._tied(rows)[1]

    def holds(self, rows, failing):
        """Whether one mechanism holds that failed with weaker rows; one that is gone holds."""
        known, tried, _ = self._tied(rows)
        if failing.part not in known:
            return True
        case = next(case for case in tried if case.model == failing.model)
        candidate = known[failing.part]
        part = case if candidate.whole else part_of(case, candidate)
        return self._run(rows, part, failing.part, candidate)["holds"]

    def _parts(self, rows, model):
        """Mechanisms by label, and what is shaken of them under one model: row and case."""
        known, tried, pga_g = self._tied(rows)
        ranked = [(pga_g[name], candidate, None) for name, candidate in known.items()]
        ranked.sort(key=lambda row: row[0])
        within = self.tied.sections["assessment"]["shaken_within"]
        table = chosen(ranked, tried, self.tied.demand.pga_g, within)
        (case,) = (case for case in tried if case.model == model)
        return known, list(cases(case, table))

    def _tied(self, rows):
        """Mechanisms with these rows by label, the case of each model, and PGAs by hand."""
        if (key := tuple(rows)) not in self._by_rows:
            variant = Variant("tied", added={"facade.ties": self.tied.entries(rows)})
            known, pga_g = self.tied.mechanisms(rows)
            self._by_rows[key] = known, [case.varied(variant) for case in self.cases], pga_g
        return self._by_rows[key]

    def _run(self, rows, part, label, candidate):
        """Row of TRIED of one part."""
        about = {"forces_kn": forces_said(rows), "model": part.model, "part": label}
        about |= {
            "mechanism": candidate.name,
            **self._of(part, candidate),
            "fine": int(self.care == FINE),
        }
        if about not in self.rows:
            self.rows.append(about)
        return about

    def _of(self, part, candidate):
        """What the check says of one part; what decided last is run first: it mostly does again."""
        if (key := self._key(part)) not in self._known:
            self._keep(key, *self._decided(part, candidate, self.many, self.at_once))
        return self._known[key]

    def _keep(self, key, about, turn):
        self._known[key] = about
        if turn is not None:
            self.order.remove(turn)
            self.order.insert(0, turn)

    def _ahead(self, parts):
        """Check some parts side by side, (part, mechanism), and keep what will be asked for.

        What does not hold changes the order of the motions, by which others end that do not hold:
        of these the first is kept alone.
        """
        missing, stands = [], True
        for part, candidate in parts:
            known = self._known.get(self._key(part))
            if known is None:
                missing.append((part, candidate))
            elif not known["holds"]:
                break
        if self.at_once == 1 or len(missing) < 2:
            return
        checks = self.many(lambda pair: self._decided(*pair), missing)
        for (part, _), (about, turn) in zip(missing, list(checks), strict=True):
            if about["holds"] or stands:
                self._keep(self._key(part), about, turn)
            stands = stands and about["holds"]

    def _key(self, part):
        return json.dumps(part.sections, sort_keys=True), self.care  # model, façade and all

    def _decided(self, part, candidate, many=map, at_once=1):
        sections, limits = self.tied.sections, limits_with(candidate)
        count = sections["assessment"]["dynamic_realisations"]
        given = part.sections, self.order, limits, count, sections["seed"], self.care
        return decided(*given, many, at_once)


def forces_said(rows):
    """Forces of rows [kN], in the order of their heights."""
    return " ".join(f"{1e-3 * row.force_n:.4g}" for row in rows)


def behind(candidate, rows):
    """Indices of the rows behind a part that is shaken, the highest first: those its case has.

    Also the row at the level that holds a part in bending: by hand that level stays, shaken it
    gives as a row of its strength does.
    """
    foot_m, held_m, _ = heights(candidate)
    top_m = math.inf if held_m is None else held_m + LEVEL_M
    indices = [k for k, r in enumerate(rows) if r.force_n and foot_m + NEAR_M < r.height_m < top_m]
    return sorted(indices, key=lambda k: -rows[k].height_m)
