"""Kinds of mechanisms by key, and their names by language: code compares keys, reports print names.

Italian terms are those of the Circolare and of the practice that follows it (`catalogue`).
"""

from studies.assess.catalogue import SAY
from studies.assess.sites import CORNERS, WHOLE_PART, known

COMPOUND, HORIZONTAL, PART_WIDTH = "compound", "horizontal", "part_width"
OVERTURNING, BENDING, CORNER = "overturning", "bending", "corner"
BEYOND = (COMPOUND, HORIZONTAL, PART_WIDTH)  # kinds of `assessment.mechanisms`
BETWEEN = "between"  # begins the part of a mechanism whose foot lies between two changes
AND = "+"  # between keys of what is at a foot
PLACES = ("foot_m", "hinge_m", "held_m", "crack_deg", "left_m", "right_m")


def kind_of(mechanism):
    """Key of the kind of a mechanism: a `family.Candidate`, a `sites.Site`, a row of a table."""
    if mechanism.side:
        return CORNER
    if known(mechanism.crack_deg) is not None:
        return COMPOUND
    if known(mechanism.left_m) is not None:
        return PART_WIDTH if known(mechanism.middle_m) is None else HORIZONTAL
    return OVERTURNING if known(mechanism.held_m) is None else BENDING


def key_of(mechanism):
    """Key of a mechanism's name in the catalogue."""
    kind = kind_of(mechanism)
    if kind == CORNER:
        return f"{CORNERS[int(mechanism.side)]}_corner"
    if kind == OVERTURNING:
        return "whole" if mechanism.part == WHOLE_PART else "part"
    return kind


def _foot(mechanism, say):
    """What is at the foot of a part, in words; empty where that is not told."""
    at_foot = getattr(mechanism, "at_foot", "")
    if not isinstance(at_foot, str) or not at_foot:
        return ""
    if at_foot == BETWEEN:
        _, low, _, high = mechanism.part.split("_")
        return say("mechanism.foot.between", low_m=float(low), high_m=float(high))
    word = say("number.and")
    return f" {word} ".join(say(f"mechanism.foot.{key}") for key in at_foot.split(AND))


def _placed(mechanism, say, form):
    places = {key: known(getattr(mechanism, key, None)) for key in PLACES}
    given = {key: value for key, value in places.items() if value is not None}
    return say(f"mechanism.{key_of(mechanism)}.{form}", **given)


def name(mechanism, say=SAY):
    """Name of a mechanism with its places, and with what is at its foot."""
    placed = _placed(mechanism, say, "name")
    foot = _foot(mechanism, say) if key_of(mechanism) == "part" else ""
    return say("mechanism.at_foot", name=placed, foot=foot) if foot else placed


def the(mechanism, say=SAY):
    """Its name within a sentence, with an article where there is one."""
    placed = _placed(mechanism, say, "the")
    foot = _foot(mechanism, say) if key_of(mechanism) == "part" else ""
    return say("mechanism.at_foot", name=placed, foot=foot) if foot else placed


def short(mechanism, say=SAY):
    """Its name within a list, without what is at its foot."""
    return _placed(mechanism, say, "the")


def not_asked(asked, say=SAY):
    """Kinds that could be checked by hand and were not, in words; empty where all were.

    `asked` are the kinds of `assessment.mechanisms`.
    """
    left = [say(f"mechanism.kind.{kind}") for kind in BEYOND if kind not in asked]
    return say("mechanism.not_asked", kinds=", ".join(left)) if left else ""
