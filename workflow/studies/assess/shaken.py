"""Which mechanisms of a façade are shaken: each as a case of its own, under each model.

The whole façade, and every other plane mechanism that fails by hand below
`assessment.shaken_within` times the demand's PGA: what is near the demand, whatever the weakest
does. So is one with a tie or an anchor that gives way early, which sets its d_SLV: the millimetres
up to there are elastic sway, of which no check by hand tells. So is every span that bends: by hand
its level stays in place whatever it must bear, and the ties or anchors there may give way long
before. Corners do not turn over the whole width, and parts that are too stocky to rock slide first:
they are judged by hand alone, and the reason is said. The whole façade, one mechanism above a cut,
and a span of it are all cases (`Case.part`).

By default no friction of floors holds the façade while it is shaken (`settled`): by hand it is left
out too, since nobody has verified that it lasts until collapse.
"""

import copy
import math

import pandas as pd
from rocking.collapse.case import Case
from rocking.configuration.facade import TooStockyError
from rocking.tables import read_frame

from studies.assess.anchors import completed
from studies.assess.catalogue import SAY
from studies.assess.dynamic_check import Limits, limits_with
from studies.assess.held import SETTLED
from studies.assess.sites import EXTENT, WHOLE_PART
from yade_scripts.model.facades import Facade

COLUMNS = ["part", "mechanism", "foot_m", "held_m", "hinge_m", "side", "pga_fails_g"]
COLUMNS += [*EXTENT, "at_foot", "d0_m", "d_slv_m", "d_slc_m", "d_slv_bare_m"]
COLUMNS += ["shaken", "why_not", "why_words"]
CORNER, FAR, STOCKY, REFUSED = "corner", "far", "stocky", "refused"  # why one is not shaken
NARROW = "narrow"


def heights(mechanism):
    """Foot, held level and hinge of a `family.Candidate`, as `Case.part` takes them."""
    return mechanism.foot_m, mechanism.held_m, mechanism.hinge_m


def part_of(case, mechanism):
    """Case of a mechanism, a `family.Candidate` or a row of `chosen`."""
    foot, *held = (None if v is None or pd.isna(v) else v for v in heights(mechanism))
    crack_deg = mechanism.crack_deg
    crack_deg = 0.0 if crack_deg is None or pd.isna(crack_deg) else crack_deg
    return case.part(foot, *held, wedge_deg=crack_deg)


def is_far(table):
    """Mask of the mechanisms of `chosen` that are left out since they fail far later by hand."""
    return table["why_not"].fillna("") == FAR


def settled(case, assessment):
    """A case as it is shaken, by the keys SETTLED of section assessment.

    Friction of floors holds it as stated or not at all; every anchor of a tie has a capacity.
    """
    facade = copy.deepcopy(completed(case["facade"], assessment))
    if not assessment["floor_friction"]:
        for row in facade["floors"]:
            row["friction"] = 0.0
    return Case({**case.sections, "facade": facade})


def settled_by(settings):
    """Keys SETTLED of `settings`, which has them by dotted key or in section assessment."""
    assessment = settings.get("assessment") or {}
    return {key: assessment.get(key, settings.get(f"assessment.{key}")) for key in SETTLED}


def rubs(facade):
    """Whether floors of a section facade hold it by friction."""
    return any(row.friction and row.load_kn for row in Facade.of(facade).floors)


def told(why, pga_g):
    """A reason by its key, and in words."""
    return why, SAY(f"verdict.why_told.{why}", pga_g=pga_g)


def why_not(candidate, pga_g, least_g, tried):
    """Key of why a mechanism is not shaken, and the reason in words; both empty if it is.

    `least_g` is the PGA by hand from which on it is left out; `tried` has a case of each model.
    """
    if not candidate.plane:
        return told(CORNER if candidate.side else NARROW, pga_g)
    by_hand = candidate.held_m is None and math.isnan(limits_with(candidate).bare_m)
    if by_hand and not candidate.whole and pga_g > least_g:
        return told(FAR, pga_g)
    try:
        for case in tried:
            part_of(case, candidate)
    except TooStockyError:
        return told(STOCKY, pga_g)
    except ValueError as error:
        return REFUSED, getattr(error, "detail", str(error))
    return "", ""


def chosen(ranked, tried, demand_g, within):
    """Which mechanisms are shaken, and why the others are not: COLUMNS, in the order of `ranked`.

    One of `code_checks.governing` is shaken where it fails by hand below `within` times the
    demand's PGA, has a link that gives way early or is a span that bends, and is a case of each
    of `tried`, one of each model.
    """
    rows = []
    for pga_g, candidate, _ in ranked:
        why = why_not(candidate, pga_g, within * demand_g, tried)
        about = candidate.part, candidate.name, *heights(candidate), candidate.side, pga_g
        about = *about, *(getattr(candidate, key) for key in (*EXTENT, "at_foot"))
        rows.append((*about, *limits_with(candidate), int(not why[0]), *why))
    return pd.DataFrame(rows, columns=COLUMNS)


def cases(case, table):
    """Case of each mechanism that is shaken by the table of `chosen`: (row, Case).

    `case` is the façade's. Those that fail first by hand come first.
    """
    for row in table[table["shaken"] == 1].sort_values("pga_fails_g").itertuples():
        if row.part == WHOLE_PART:
            yield row, case
        else:
            yield row, part_of(case, row)


def cases_of(case, path=None):
    """Cases by part: of the whole façade; with the file of a table what else is shaken, instead."""
    if path is None:
        return {WHOLE_PART: case}
    every = cases(case, read_frame(path))
    return {row.part: part_case for row, part_case in every if row.part != WHOLE_PART}


def limits_by_part(table):
    """`Limits` by part of a table of `chosen`."""
    return {
        row.part: Limits(row.d0_m, row.d_slv_m, row.d_slc_m, row.d_slv_bare_m)
        for row in table.itertuples()
    }
