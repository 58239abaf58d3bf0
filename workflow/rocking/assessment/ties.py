"""The least rows of ties with which a façade passes: by hand first, then under the chosen motions.

Rows may stand at `levels`. By hand a set of rows passes if the SLV check of every mechanism of the
façade with these rows does (`code_checks.slv_pga`). Every row pulls with its capacity, so more
force raises the multiplier, and the least is found by halving: first one force common to all
levels, then each row for itself, the lowest first, since it has the least lever arm; a row that is
not needed goes. What is left is least in each of its rows: with less in any one, a mechanism fails.

Mechanisms that fail under the strongest rows too (the gable above a row, bending between two of
them) are *beyond* these levels. They are left out of the search and named.

Then the façade with its rows is held to the code's dynamic check, mechanism by mechanism. For one
that does not hold a row that pulls on it is made stronger, in steps of 1/0.95, until it does
(`ties_grown.grown`). Last, every row gives back what the others' growth has made needless
(`ties_grown.lowered`), so that 95 % of each row, the others as they are, has been tried and does
not pass. What no added row makes hold is left out here too. Both are done with long steps first,
and from there once more as finely as the report's own check.

Rods come in sizes, and under the motions a stronger row may fail where a weaker one holds. So the
rows are tried with rods that are sold too, the next size wherever they fail (`sold`).
"""

import math
from typing import NamedTuple

from rocking.assessment.code_checks import slv_pga
from rocking.assessment.dynamic_check import FINE, ROUGH
from rocking.assessment.family import LEAST_PART_M, Family
from rocking.assessment.shaken import label
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
COMMERCIAL_MM = (8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30, 32, 36, 40, 45, 50, 60, 70, 80)
ROWS = ["height_m", "force_by_hand_kn", "force_kn", "count", "diameter_mm", "commercial_mm"]
ROWS += ["yield_mpa", "length_m", "model", "governed_by", "relied", "force_relied_kn"]
ROWS += ["sold_holds"]
AFTER = ["part", "mechanism", "pga_fails_g", "ratio", "exceed_d0", "mean_d_m", "d_slv_m", "holds"]
AFTER += ["beyond"]


class TieRow(NamedTuple):
    """A row to be added: its height above the façade's base and its capacity."""

    height_m: float
    force_n: float


class Tied:
    """A façade that rows of ties may be added to, and what it is held to by hand.

    Of sections facade, return_wall, smdof, assessment and strengthening of a configuration; the
    last says what rods the rows are of.
    """

    def __init__(self, sections, demand):
        """Keep what every trial takes."""
        self.sections, self.demand = sections, demand
        family = Family(sections)
        self.weight_n = family.masonry.weight_n
        self.corners = {label(one): one for one in family.corners()}  # which no row holds
        self.corners_pga_g = self._pga_g(self.corners)
        self._first: list[str] = []  # mechanisms that failed last are tried first

    def _pga_g(self, known):
        """PGA at which mechanisms by label fail by hand [g]."""
        return {name: slv_pga(one, self.sections, self.demand) for name, one in known.items()}

    def entries(self, rows):
        """Entries of facade.ties for rows, those without force left out."""
        own = self.sections["strengthening"]
        return [row_of_rods(own, row.height_m, 1e-3 * row.force_n) for row in rows if row.force_n]

    def family(self, rows):
        """Mechanisms of the façade with rows added."""
        facade = self.sections["facade"]
        ties = [*facade["ties"], *self.entries(rows)]
        return Family({**self.sections, "facade": {**facade, "ties": ties}})

    def mechanisms(self, rows):
        """Mechanisms of the façade with rows added, by label, with the PGA at which each fails."""
        known = {label(one): one for one in self.family(rows).plane()}
        return known | self.corners, self._pga_g(known) | self.corners_pga_g

    def failing(self, rows):
        """Labels of the mechanisms that fail by hand, and the PGA at which each does [g]."""
        _, pga_g = self.mechanisms(rows)
        return {name: at for name, at in pga_g.items() if at < self.demand.pga_g}

    def passes(self, rows, beyond=()):
        """Whether every mechanism passes by hand but those that are beyond.

        Corners, which no row holds, are beyond or pass.
        """
        known = {label(one): one for one in self.family(rows).plane()}
        for name in sorted(known, key=lambda name: name not in self._first):
            if name in beyond:
                continue
            if slv_pga(known[name], self.sections, self.demand) < self.demand.pga_g:
                self._first = [name, *(n for n in self._first if n != name)]
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

        def common(share):
            return [TieRow(z, share * self.weight_n) for z in levels]

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
    """Rows of ties that make a façade pass: one `TieRow` at each level, 0 N for none.

    There none is needed, or none helps.
    """

    rows: list
    by_hand_n: list  # least force of each by hand
    beyond: list  # labels of the mechanisms that these rows do not make pass
    why: list  # `Failing` with 0.95 of a row's force; None where nothing was shaken
    relied_n: list  # forces that make all hold under the model that was tried first


def found(tied, shaken, stands, say=lambda text: None):
    """Rows with which a façade passes by hand and under the chosen motions, as `Found`.

    `tied` is a `Tied`, `shaken` its `Shaken`, or None where no motions were chosen: by hand alone
    then. `stands`: whether the dynamic check holds without rows. `say` receives a line a trial.
    """
    levels = levels_of(tied.sections)
    least, beyond = tied.least(levels) if levels else ([], sorted(tied.failing([])))
    say(f"by hand: {', '.join(f'{1e-3 * r.force_n:.3g} kN at {r.height_m:g} m' for r in least)}")
    known = {row.height_m: row.force_n for row in least}
    by_hand = [known.get(z, 0.0) for z in levels]
    rows = [TieRow(*row) for row in zip(levels, by_hand, strict=True)]
    if shaken is None or not levels or (stands and not least):
        return Found(rows, by_hand, beyond, [None] * len(rows), by_hand)
    shaken.beyond = set(beyond)  # no force helps these by hand
    rows, _ = _shaken(shaken, rows, shaken.models[:1], say)
    relied = [row.force_n for row in rows]
    rows, why = _shaken(shaken, rows, shaken.models, say)
    return Found(rows, by_hand, sorted({*tied.failing(rows), *shaken.left}), why, relied)


def _shaken(shaken, rows, models, say):
    """Rows with which some models hold, and why none is less: found roughly, then mended."""
    likely: list = [None] * len(rows)
    for shaken.care in (ROUGH, FINE):
        shaken.left = set(shaken.beyond)
        rows, governs = grown(shaken, rows, models, say)
        for growth in governs:
            for k in growth.which:
                likely[k] = growth.why
        rows, likely = lowered(shaken, rows, models, say, likely)
    return rows, likely


def sold(tied, result, shaken, say=lambda text: None):
    """Rods that are sold with which the façade passes as with the rows found.

    Of each row the next size; while a mechanism fails with them, by hand or shaken, the one after
    that for the highest of the rows that pull on it. Returns the diameter of each row's rods [mm],
    and whether they hold: False where no size does.
    """
    own = tied.sections["strengthening"]
    least = [row_of_rods(own, r.height_m, 1e-3 * r.force_n)["diameter_mm"] for r in result.rows]
    sizes = [commercial(d) if d else 0.0 for d in least]
    while True:
        rows = [
            row._replace(force_n=row.force_n * (size / d) ** 2) if d else row
            for row, size, d in zip(result.rows, sizes, least, strict=True)
        ]
        which = _pulling(tied, rows, result.beyond, shaken)
        said = " ".join(f"{d:g}" for d in sizes)
        if which is None:
            say(f"as sold: φ {said} hold")
            return sizes, True
        larger = commercial(sizes[which[0]] + 0.01) if which else math.inf
        if larger > COMMERCIAL_MM[-1]:
            say(f"as sold: φ {said} do not hold")
            return sizes, False
        sizes[which[0]] = larger


def held_by(mechanism, rows):
    """Indices of the rows that pull on a mechanism by hand, the highest first.

    Read off its own pulls: a row at or below its foot, or where it is kept in place, is none.
    """
    pulled = [float(pull.path(0.0)[1].real) for pull in mechanism.pulls]
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
    failing = None if shaken is None else first_failing(shaken, rows, shaken.models)
    return None if failing in (None, BY_HAND) else failing.rows


def table_of(result, own, relied="", as_sold=None):
    """Rows of `Found` as a table, with the rods of section strengthening that they take (ROWS).

    Also a row of no force that `relied`, the model tried first, asks for; it is empty without the
    dynamic check. `as_sold` is what `sold` returns; without it the next sizes stand there, untried.
    """
    rows, (sizes, holds) = [], as_sold or ([None] * len(result.rows), "")
    every = zip(result.rows, result.by_hand_n, result.why, result.relied_n, sizes, strict=True)
    for row, least_n, why, relied_n, tried_mm in every:
        if not row.force_n and not relied_n:
            continue
        rod = row_of_rods(own, row.height_m, 1e-3 * row.force_n)
        size = rod["diameter_mm"]
        rods = (
            rod["count"],
            size,
            tried_mm or commercial(size),
            rod["yield_mpa"],
            rod["length_m"],
            *((why.model, why.mechanism) if why else ("", "")),
            relied,
            1e-3 * relied_n,
            int(holds) if tried_mm else "",
        )
        forces = 1e-3 * least_n, 1e-3 * row.force_n
        rows.append(dict(zip(ROWS, (row.height_m, *forces, *rods), strict=True)))
    return rows


def after(tied, result, shaken):
    """What each mechanism does with the rows: by hand, and in the dynamic check (AFTER)."""
    rows, beyond = [], set(result.beyond)
    last = shaken.everything(result.rows) if shaken is not None and shaken.rows else {}
    known, fails_g = tied.mechanisms(result.rows)
    for name, one in known.items():
        pga_g, own = fails_g[name], last.get(name, {})
        ratio = pga_g / tied.demand.pga_g
        shake = [own.get(key, math.nan) for key in ("exceed_d0", "mean_d_m", "d_slv_m")]
        held = int(own["holds"]) if own else ""
        about = name, one.name, pga_g, ratio, *shake, held, int(name in beyond)
        rows.append(dict(zip(AFTER, about, strict=True)))
    return sorted(rows, key=lambda row: row["pga_fails_g"])
