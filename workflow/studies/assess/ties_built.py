"""Rows of ties as they are built: in rods that are sold, on anchors that hold them; see `ties`."""

import math

from studies.assess import anchors
from studies.assess.rods import row_of_rods
from studies.assess.ties_grown import BY_HAND, first_failing

SAME_M = 1e-6  # heights
COMMERCIAL_MM = (6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30, 32, 36, 40, 45, 50, 60, 70, 80)


def commercial(diameter_mm):
    """Next diameter that is sold [mm]; the diameter itself beyond the last."""
    return next((d for d in COMMERCIAL_MM if d >= diameter_mm - 1e-9), math.ceil(diameter_mm))


def in_steel(tied, row, least_n):
    """Row of rods that are sold whose force is no less than `least_n`; None where none is.

    Of all numbers of rods that fit, the least with which each takes less than its anchor holds.
    """
    rods, one_n = tied.rods(), anchors.FULL * tied.anchor(row.height_m).force_n
    first = tied.count(row._replace(force_n=least_n, rods=0))
    for count in range(first, tied.most(row.height_m) + 1):
        rod = row_of_rods({**rods, "count": count}, row.height_m, 1e-3 * least_n)
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
    recommended, whole = [], True
    for row in rows:
        made = in_steel(tied, row, margin * row.force_n) if row.force_n else row
        if made is None:
            made, whole = in_steel(tied, row, row.force_n) or row, False
        recommended.append(made)
    while True:
        which = _pulling(tied, recommended, beyond, shaken)
        said = ", ".join(f"{1e-3 * r.force_n:.4g} kN in {tied.count(r)}" for r in recommended)
        if which is None:
            say(f"as built: {said}: hold")
            return recommended, whole
        larger = None
        if which:
            larger = in_steel(tied, recommended[which[0]], 1.02 * recommended[which[0]].force_n)
        if larger is None:
            say(f"as built: {said}: do not hold")
            return recommended, False
        recommended[which[0]] = larger


def held_by(mechanism, rows):
    """Indices of the rows that pull on a mechanism by hand, the highest first.

    Read off its own pulls: a row at or below its foot, or where it is kept in
    place, does not pull.
    """
    pulled = [float(p.path(0.0)[1].real) for p in mechanism.pulls if p.force_n > 0.0]
    indices = [
        k
        for k, row in enumerate(rows)
        if row.force_n and any(abs(row.height_m - z) < SAME_M for z in pulled)
    ]
    return sorted(indices, key=lambda k: -rows[k].height_m)


def _pulling(tied, rows, beyond, shaken):
    """Rows that pull on a mechanism that fails, the highest first; None where none fails."""
    by_hand = [name for name in tied.failing(rows) if name not in beyond]
    if by_hand:
        return held_by(tied.mechanisms(rows)[0][by_hand[0]].mechanism, rows)
    failing = None if shaken is None else first_failing(shaken, rows, shaken.models[:1])
    return None if failing in (None, BY_HAND) else failing.rows
