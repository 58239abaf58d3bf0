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
that are sold, of which each takes less than its anchor holds (`built`). Under the motions a
stronger row may fail where a weaker one holds, so those rods are shaken again, and larger ones
tried where they fail. What the other models ask for alone is found roughly and told beside.
"""

import itertools
import math
from typing import NamedTuple

from rocking.assessment import anchors, weakest
from rocking.assessment.dynamic_check import FINE, ROUGH
from rocking.assessment.family import Family
from rocking.assessment.shaken import label
from rocking.assessment.sites import LEAST_PART_M
from rocking.assessment.slv import Slv, read_as
from rocking.assessment.ties_grown import (
    BY_HAND,
    LEAST_SHARE,
    MOST_SHARE,
    first_failing,
    grown,
    lowered,
    with_force,
)
from rocking.strengthening import row_of_rods

CLOSE = 0.005  # relative, of a row's least force
SAME_M = 1e-6  # heights
COMMERCIAL_MM = (6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30, 32, 36, 40, 45, 50, 60, 70, 80)
FULL = 0.999  # of what an anchor holds that a rod may take: the rod yields first
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
        self.slv = Slv(sections, demand)
        self.weight_n = Family(sections).masonry.weight_n
        self._known: dict[tuple, tuple] = {}  # feet and spans by heights of the rows
        self._spans: dict[tuple, list] = {}  # places at which it bends between two levels
        self._between: list = []  # between feet
        self._corners: list = []
        self._first: list[str] = []  # mechanisms that failed last are tried first

    def anchor(self, height_m):
        """`anchors.Anchor` of a row at a height."""
        own, facade = self.sections["assessment"], self.sections["facade"]
        return anchors.anchor(own, anchors.thickness_at(facade, height_m))

    def most(self, height_m):
        """Anchors that fit into a row at a height, at least one."""
        return anchors.most_in_a_row(self.sections["assessment"], self.sections["facade"], height_m)

    def most_n(self, height_m):
        """Force of the strongest row at a height [N]: what its anchors hold."""
        return FULL * self.most(height_m) * self.anchor(height_m).force_n

    def rods(self):
        """Section strengthening with the length of rods that are recommended."""
        length = self.sections["assessment"]["tie_length_m"] or self.sections["facade"]["width_m"]
        return {**self.sections["strengthening"], "length_m": length}

    def count(self, row):
        """Rods of a row: as stated, or as many as the anchors ask for."""
        if row.rods:
            return row.rods
        needed = math.ceil(row.force_n / (FULL * self.anchor(row.height_m).force_n) - 1e-9)
        return max(min(self.sections["strengthening"]["count"], self.most(row.height_m)), needed, 1)

    def entry(self, row):
        """Entry of facade.ties for a row."""
        own = {**self.rods(), "count": self.count(row)}
        found = row_of_rods(own, row.height_m, 1e-3 * row.force_n)
        return {**found, "anchor_kn": 1e-3 * self.anchor(row.height_m).force_n}

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
            own, before = self._pga_g([site], rows), known.get(site.part, math.inf)
            if own < WEAKER * before or own < WEAKER * self.demand.pga_g <= before:
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
            one = family.at(site)
            read = self.slv.reading(one)
            if read.pga_g < pga_g.get(label(one), math.inf):
                known[label(one)], pga_g[label(one)] = read_as(one, read), read.pga_g
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
            rows, beyond = self._least(levels)
            if not rows or not self.looked_again(rows) or self.passes(rows, beyond):
                break
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
    facade, stated = sections["facade"], sections["assessment"]["tie_levels_m"]
    if stated is not None:
        return list(stated)
    top = facade["height_m"]
    found = [top]
    for z in sorted((row["height_m"] for row in facade["floors"]), reverse=True):
        if LEAST_PART_M <= z <= found[-1] - LEAST_PART_M:
            found.append(z)
    return found[::-1]


def check_levels(sections):
    """Refuse stated levels at which no return wall stands, by a ValueError of one line."""
    top = sections["facade"]["height_m"]
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


def commercial(diameter_mm):
    """Next diameter that is sold [mm]; the diameter itself beyond the last."""
    return next((d for d in COMMERCIAL_MM if d >= diameter_mm - 1e-9), math.ceil(diameter_mm))


class Found(NamedTuple):
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


def found(tied, shaken, say=lambda text: None):
    """Rows with which a façade passes by hand and under the chosen motions, as `Found`.

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
    return Found(rows, by_hand, beyond, why, made, holds, alone)


def _alone(shaken, rows, say):
    """Forces that every other model asks for, found roughly; None where no row makes it hold."""
    found = {}
    for model in shaken.models[1:]:
        shaken.care, shaken.left = ROUGH, set(shaken.beyond)
        own, _ = grown(shaken, rows, [model], say, every=False)
        lost = shaken.left - shaken.beyond
        found[model] = None if lost else [row.force_n for row in own]
    shaken.care = FINE
    return found


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


def in_steel(tied, row, least_n):
    """Row of rods that are sold whose force is no less than `least_n`; None where none is.

    Of all numbers of rods that fit, the least with which each takes less than its anchor holds.
    """
    own, one_n = tied.rods(), FULL * tied.anchor(row.height_m).force_n
    first = tied.count(row._replace(force_n=least_n, rods=0))
    for count in range(first, tied.most(row.height_m) + 1):
        rod = row_of_rods({**own, "count": count}, row.height_m, 1e-3 * least_n)
        size = commercial(rod["diameter_mm"])
        force_n = least_n * (size / rod["diameter_mm"]) ** 2
        if force_n <= count * one_n:
            return row._replace(force_n=force_n, rods=count)
    return None


def built(tied, rows, beyond, shaken, say=lambda text: None):
    """Rows as they are recommended, and whether the façade passes with them as with the least.

    Each is the least force times `assessment.tie_margin` in rods that are sold (`in_steel`); while
    a mechanism fails with them, by hand or shaken, the highest of the rows that pull on it gets the
    next larger. Where a row fits no such rods it is as strong as its anchors let it be.
    """
    margin = tied.sections["assessment"]["tie_margin"]
    found, whole = [], True
    for row in rows:
        made = in_steel(tied, row, margin * row.force_n) if row.force_n else row
        if made is None:
            made, whole = in_steel(tied, row, row.force_n) or row, False
        found.append(made)
    while True:
        which = _pulling(tied, found, beyond, shaken)
        said = ", ".join(f"{1e-3 * r.force_n:.4g} kN in {tied.count(r)}" for r in found)
        if which is None:
            say(f"as built: {said}: hold")
            return found, whole
        larger = None
        if which:
            larger = in_steel(tied, found[which[0]], 1.02 * found[which[0]].force_n)
        if larger is None:
            say(f"as built: {said}: do not hold")
            return found, False
        found[which[0]] = larger


def held_by(mechanism, rows):
    """Indices of the rows that pull on a mechanism by hand, the highest first.

    Read off its own pulls: a row at or below its foot, or where it is kept in place, is none.
    """
    pulled = [float(p.path(0.0)[1].real) for p in mechanism.pulls if p.force_n > 0.0]
    own = [
        k
        for k, row in enumerate(rows)
        if row.force_n and any(abs(row.height_m - z) < SAME_M for z in pulled)
    ]
    return sorted(own, key=lambda k: -rows[k].height_m)


def _pulling(tied, rows, beyond, shaken):
    """Rows that pull on a mechanism that fails, the highest first; None where none fails."""
    by_hand = [name for name in tied.failing(rows) if name not in beyond]
    if by_hand:
        return held_by(tied.mechanisms(rows)[0][by_hand[0]].mechanism, rows)
    failing = None if shaken is None else first_failing(shaken, rows, shaken.models[:1])
    return None if failing in (None, BY_HAND) else failing.rows
