"""The rows of ties that a façade is recommended, for the model that its rate rests on.

Rows may stand at `levels`. By hand a set of rows passes if the SLV check of every mechanism of the
façade with these rows does. More force raises the multiplier, and the least is found by halving:
first one force common to all levels, then each row for itself, the lowest first, since it has the
least lever arm; a row that is not needed goes. What is left is least in each of its rows: with less
in any one, a mechanism fails.

Mechanisms that fail under the strongest rows too (the gable above a row, bending between two of
them) are *beyond* these levels. They are left out of the search and named.

Then the façade with its rows is held to the code's dynamic check with the model that the rate rests
on, mechanism by mechanism. For one that does not hold a row that pulls on it is made stronger, in
steps of 1/0.95, until it does (`ties_grown.grown`). Last, every row gives back what the others'
growth has made needless (`ties_grown.lowered`). What no added row makes hold is left out here too.

No row is stronger than its anchors: as many as fit side by side, each with what a plate holds on
that wall (`anchors`). What is recommended is the least force times `assessment.tie_margin`, in rods
that are sold, of which each takes less than its anchor holds (`ties_built`). Under the motions a
stronger row may fail where a weaker one holds, so those rods are shaken again, and larger ones
tried where they fail. What the other models ask for alone is found roughly and told beside.
"""

import itertools
import math
from typing import NamedTuple

from studies.assess import anchors, weakest
from studies.assess.dynamic_check import FINE, ROUGH
from studies.assess.family import Family
from studies.assess.rods import row_of_rods
from studies.assess.sites import LEAST_PART_M
from studies.assess.slv import Slv, read_as
from studies.assess.ties_built import built
from studies.assess.ties_grown import LEAST_SHARE, MOST_SHARE, grown, lowered, sum_n, with_force
from yade_scripts.model.facades import Facade

CLOSE = 0.005  # relative, of a row's least force
WEAKER = 0.99  # a place is weaker than those that are known from here on
ROUNDS = 8  # in which weaker places are looked for


class TieRow(NamedTuple):
    """A row to be added: its height above the façade's base, its capacity, its rods.

    Of 0 rods there are as many as the anchors ask for.
    """

    height_m: float
    force_n: float
    rods: int = 0


class Tied:
    """A façade that rows of ties may be added to, and what it is held to by hand.

    Of sections facade, return_wall, smdof, assessment and strengthening of a configuration; the
    last says what rods the rows are of. Where its mechanisms are weakest is looked for once, and
    again for what was found (`looked_again`).
    """

    def __init__(self, sections, demand):
        """Keep what every trial takes."""
        self.sections, self.demand = sections, demand
        self.facade = Facade.of(sections["facade"])
        self.slv = Slv(sections, demand)
        self.weight_n = Family(sections).masonry.weight_n
        self._known: dict[tuple, tuple] = {}  # feet and spans by heights of the rows
        self._spans: dict[tuple, list] = {}  # places at which it bends between two levels
        self._between: list = []  # between feet
        self._corners: list = []
        self._first: list[str] = []  # mechanisms that failed last are tried first

    def anchor(self, height_m):
        """`anchors.Anchor` of a row at a height."""
        thickness_m = anchors.thickness_at(self.facade, height_m)
        return anchors.anchor(self.sections["assessment"], thickness_m)

    def most(self, height_m):
        """Anchors that fit into a row at a height, at least one."""
        return anchors.most_in_a_row(self.sections["assessment"], self.facade, height_m)

    def most_n(self, height_m):
        """Force of the strongest row at a height [N]: what its anchors hold."""
        return anchors.FULL * self.most(height_m) * self.anchor(height_m).force_n

    def rods(self):
        """Section strengthening with the length of rods that are recommended."""
        length = self.sections["assessment"]["tie_length_m"] or self.facade.width_m
        return {**self.sections["strengthening"], "length_m": length}

    def count(self, row):
        """Rods of a row: as stated, or as many as the anchors ask for."""
        if row.rods:
            return row.rods
        needed = math.ceil(row.force_n / (anchors.FULL * self.anchor(row.height_m).force_n) - 1e-9)
        return max(min(self.sections["strengthening"]["count"], self.most(row.height_m)), needed, 1)

    def entry(self, row):
        """Entry of facade.ties for a row."""
        rods = {**self.rods(), "count": self.count(row)}
        entry = row_of_rods(rods, row.height_m, 1e-3 * row.force_n)
        return {**entry, "anchor_kn": 1e-3 * self.anchor(row.height_m).force_n}

    def entries(self, rows):
        """Entries of facade.ties for rows, those without force left out."""
        return [self.entry(row) for row in rows if row.force_n]

    def family(self, rows, slv=None):
        """Mechanisms of the façade with rows added."""
        facade = self.sections["facade"]
        ties = [*facade["ties"], *self.entries(rows)]
        return Family({**self.sections, "facade": {**facade, "ties": ties}}, slv=slv)

    def _places(self, rows):
        """`Site`s of the façade with rows at these levels: what is known, and what is new to it.

        Feet follow from the rows; where it is weakest between feet, and where a wall bends between
        two levels, is looked for when it is met first.
        """
        key = tuple(row.height_m for row in rows if row.force_n)
        if key not in self._known:
            family = self.family(rows, self.slv)
            if not self._known:
                feet = family.feet()
                self._between = [s for s in weakest.parts(family) if s.foot_m not in feet]
                self._corners = weakest.corners(family)
            levels = family.levels()
            for low, high in itertools.combinations(levels, 2):
                if (low, high) not in self._spans:
                    site = weakest.bending(family, low, high)
                    self._spans[low, high] = [] if site is None else [site]
            self._known[key] = weakest.feet(family), list(itertools.combinations(levels, 2))
        feet, pairs = self._known[key]
        bends = [site for pair in pairs for site in self._spans[pair]]
        return [*feet, *self._between, *bends, *self._corners]

    def looked_again(self, rows):
        """Look for places that are weaker with these forces; whether there were any."""
        known, weaker = self.mechanisms(rows)[1], False
        for site in self.family(rows, self.slv).sites():
            pga_g, before = self._pga_g([site], rows), known.get(site.part, math.inf)
            if pga_g < WEAKER * before or pga_g < WEAKER * self.demand.pga_g <= before:
                if site.held_m is None:
                    self._between.append(site)
                else:
                    low = float(site.part.split("_")[1])
                    self._spans.setdefault((low, site.held_m), []).append(site)
                weaker = True
        return weaker

    def _pga_g(self, sites, rows):
        family = self.family(rows)
        return min(self.slv(family.at(site)) for site in sites)

    def mechanisms(self, rows):
        """Mechanisms of the façade with rows added, by label, with the PGA at which each fails.

        Of several known places of one the weakest; what never loses its multiplier is left out.
        """
        family, known = self.family(rows), {}
        pga_g: dict[str, float] = {}
        for site in self._places(rows):
            candidate = family.at(site)
            read = self.slv.reading(candidate)
            if read.pga_g < pga_g.get(candidate.part, math.inf):
                known[candidate.part], pga_g[candidate.part] = read_as(candidate, read), read.pga_g
        return known, pga_g

    def failing(self, rows):
        """Labels of the mechanisms that fail by hand, and the PGA at which each does [g]."""
        _, pga_g = self.mechanisms(rows)
        return {name: at for name, at in pga_g.items() if at < self.demand.pga_g}

    def passes(self, rows, beyond=()):
        """Whether every mechanism passes by hand but those that are beyond."""
        family = self.family(rows)
        places = [site for site in self._places(rows) if site.part not in beyond]
        for site in sorted(places, key=lambda site: site.part not in self._first):
            if self.slv(family.at(site)) < self.demand.pga_g:
                self._first = [site.part, *(n for n in self._first if n != site.part)]
                return False
        return True

    def least(self, levels):
        """Least rows that pass by hand.

        Returns
        -------
        rows : list of TieRow
            Ascending; empty where none is needed, or none helps.
        beyond : list of str
            Labels of mechanisms that fail with the strongest rows too.
        """
        for _ in range(ROUNDS):
            rows, beyond = self._least_in_sum(levels)
            if not rows or not self.looked_again(rows) or self.passes(rows, beyond):
                break
        return rows, beyond

    def _least_in_sum(self, levels):
        """Of all levels, of each alone and of all but one the rows that need the least in sum.

        None of them leaves more mechanisms beyond than all levels do.
        """
        rows, beyond = self._least(levels)
        used = [row.height_m for row in rows]
        others = [[z] for z in levels] + [[z for z in used if z != out] for out in used]
        for some in others if len(used) > 1 else [[z] for z in levels if z not in used]:
            if not rows or not some:
                continue
            fewer, left = self._least(some)
            if fewer and set(left) <= set(beyond) and sum_n(fewer) < sum_n(rows):
                rows, beyond = fewer, left
        return rows, beyond

    def _least(self, levels):
        def common(share):
            most = [min(share * self.weight_n, self.most_n(z)) for z in levels]
            return [TieRow(z, force) for z, force in zip(levels, most, strict=True)]

        if not self.failing([]):
            return [], []
        beyond = sorted(self.failing(common(MOST_SHARE)))
        if self.passes([], beyond):
            return [], beyond
        share = _halved(lambda s: self.passes(common(s), beyond), LEAST_SHARE, MOST_SHARE)
        rows = common(share)
        for _ in range(2):
            for k in range(len(rows)):
                rows[k] = rows[k]._replace(force_n=self._less(rows, k, beyond))
        return [row for row in rows if row.force_n], beyond

    def _less(self, rows, k, beyond):
        """Least force of one row, the others as they are."""

        def holds(force_n):
            return self.passes(with_force(rows, k, force_n), beyond)

        if holds(0.0):
            return 0.0
        return _halved(holds, LEAST_SHARE * self.weight_n, rows[k].force_n)


def levels_of(sections):
    """Heights at which a row may be added [m]: as stated, or floors and eaves.

    Of heights nearer than `LEAST_PART_M` the higher; none below that or above the return walls.
    """
    facade, stated = Facade.of(sections["facade"]), sections["assessment"]["tie_levels_m"]
    if stated is not None:
        return list(stated)
    downward = [facade.height_m]
    for z in sorted((floor.height_m for floor in facade.floors), reverse=True):
        if LEAST_PART_M <= z <= downward[-1] - LEAST_PART_M:
            downward.append(z)
    return downward[::-1]


def check_levels(sections):
    """Refuse stated levels at which no return wall stands, by a ValueError of one line."""
    top = Facade.of(sections["facade"]).height_m
    for z in sections["assessment"]["tie_levels_m"] or ():
        if z > top:
            raise ValueError(
                f"assess: assessment.tie_levels_m: {z:g} m; expected heights up to "
                f"facade.height_m = {top:g} m, where return walls can hold a row"
            )


def _halved(holds, low, high):
    """Least value that holds between one that does not and one that does, by its logarithm."""
    if holds(low):
        return low
    while high > (1.0 + CLOSE) * low:
        middle = math.sqrt(low * high)
        low, high = (low, middle) if holds(middle) else (middle, high)
    return high


class Recommended(NamedTuple):
    """Rows of ties that a façade is recommended: one `TieRow` at each level, 0 N for none.

    There none is needed, or none helps.
    """

    rows: list  # least, of the model that the rate rests on
    by_hand_n: list  # least force of each by hand
    beyond: list  # labels of the mechanisms that the rows do not make pass
    why: list  # `Failing` with 0.95 of a row's force; None where nothing was shaken
    built: list  # rows as they are recommended: with margin, in rods that are sold
    holds: bool  # whether these pass as the least rows do
    alone: dict  # by other model the forces that it asks for by itself [N]; None where none holds


def recommended(tied, shaken, say=lambda text: None):
    """Rows with which a façade passes by hand and under the chosen motions, as `Recommended`.

    `tied` is a `Tied`, `shaken` its `Shaken`, or None where no motions were chosen: by hand alone
    then. `say` receives a line a trial.
    """
    levels = levels_of(tied.sections)
    least, beyond = tied.least(levels) if levels else ([], sorted(tied.failing([])))
    say(f"by hand: {', '.join(f'{1e-3 * r.force_n:.3g} kN at {r.height_m:g} m' for r in least)}")
    known = {row.height_m: row.force_n for row in least}
    by_hand = [known.get(z, 0.0) for z in levels]
    rows = [TieRow(*row) for row in zip(levels, by_hand, strict=True)]
    why, alone = [None] * len(rows), {}
    if shaken is not None and levels:
        shaken.beyond = set(beyond)  # no force helps these by hand
        for _ in range(ROUNDS):
            rows, why = _shaken(shaken, rows, shaken.models[:1], say)
            if not tied.looked_again(rows) or tied.passes(rows, shaken.beyond):
                break
            say("weaker places found: once more")
        beyond = sorted({*tied.failing(rows), *shaken.left})
        alone = _alone(shaken, rows, say)
        shaken.left = set(beyond)
    made, holds = built(tied, rows, beyond, shaken, say)
    return Recommended(rows, by_hand, beyond, why, made, holds, alone)


def _alone(shaken, rows, say):
    """Forces that every other model asks for, found roughly; None where no row makes it hold."""
    forces_n = {}
    for model in shaken.models[1:]:
        shaken.care, shaken.left = ROUGH, set(shaken.beyond)
        stronger, _ = grown(shaken, rows, [model], say, every=False)
        lost = shaken.left - shaken.beyond
        forces_n[model] = None if lost else [row.force_n for row in stronger]
    shaken.care = FINE
    return forces_n


def _shaken(shaken, rows, models, say):
    """Rows with which some models hold, and why none is less: found roughly, then mended."""
    likely: list = [None] * len(rows)
    for care in (ROUGH, FINE):
        shaken.care, shaken.left = care, set(shaken.beyond)
        rows, governs = grown(shaken, rows, models, say)
        for growth in governs:
            for k in growth.which:
                likely[k] = growth.why
        rows, likely = lowered(shaken, rows, models, say, likely)
    return rows, likely
