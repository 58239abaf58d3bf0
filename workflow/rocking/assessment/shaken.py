"""Which mechanisms of a façade are shaken: each as a case of its own, under each model.

The whole façade, the one that fails first by hand, and every other plane one that fails by hand
within `assessment.shaken_within` times the least PGA. Corners do not turn over the whole width,
and parts that are too stocky to rock slide first: they are judged by hand alone, and the reason is
said. The whole façade, one mechanism above a cut, and a span of it are all cases (`Case.part`).
"""

import pandas as pd

from rocking.tables import read_frame

COLUMNS = ["part", "mechanism", "foot_m", "held_m", "hinge_m", "pga_fails_g", "shaken", "why_not"]
WHOLE_PART = "whole"
CORNER = "turns about a corner, not over the whole width"
LATER = "fails by hand"
ROCKS = "for a wall that rocks"  # end of what refuses a wall lower than twice its thickness
STOCKY = "lower than twice its thickness, so that it slides before it rocks"


def heights(one):
    """Foot, held level and hinge of a `family.Candidate`, as `Case.part` takes them."""
    return one.foot_m, one.held_m, one.hinge_m


def is_later(table):
    """Mask of the mechanisms of `chosen` that are left out since they fail far later by hand."""
    return table["why_not"].fillna("").str.startswith(LATER)


def of_label(family):
    """Mechanisms of a façade by their `label`."""
    return {label(one): one for one in family.all()}


def label(one):
    """Short name of a mechanism, of letters, digits, `_` and `.`; unique within a façade."""
    if not one.plane:
        return one.name.replace(" ", "_").replace("_above", "").replace("_m", "")
    if one.whole:
        return WHOLE_PART
    foot = float(round(one.foot_m, 6))
    return f"above_{foot}" if one.held_m is None else f"from_{foot}_to_{float(one.held_m)}"


def chosen(ranked, tried, within):
    """Which mechanisms are shaken, and why the others are not: COLUMNS, in the order of `ranked`.

    One of `code_checks.governing` is shaken where it fails by hand within `within` times the least
    PGA and is a case of each of `tried`, one of each model.
    """
    least, rows = ranked[0][0], []
    for pga_g, one, _ in ranked:
        why = "" if one.plane else CORNER
        if not why and not one.whole and pga_g > within * least:
            why = f"{LATER} beyond {within:g} times the least"
        if not why:
            try:
                for case in tried:
                    case.part(*heights(one))
            except ValueError as error:
                why = str(error).removeprefix("config: ")
                if why.endswith(ROCKS):
                    why = STOCKY
        rows.append((label(one), one.name, *heights(one), pga_g, int(not why), why))
    return pd.DataFrame(rows, columns=COLUMNS)


def cases(case, table):
    """Case of each mechanism that is shaken by the table of `chosen`: (row, Case).

    `case` is the façade's.
    """
    for row in table[table["shaken"] == 1].itertuples():
        if row.part == WHOLE_PART:
            yield row, case
        else:
            held = (None if pd.isna(v) else v for v in (row.held_m, row.hinge_m))
            yield row, case.part(row.foot_m, *held)


def cases_of(case, path=None):
    """Cases by part: of the whole façade; with the file of a table what else is shaken, instead."""
    if path is None:
        return {WHOLE_PART: case}
    every = cases(case, read_frame(path))
    return {row.part: own for row, own in every if row.part != WHOLE_PART}
