"""Formulas of codes that the checks use: the document that each is from, and how it was read.

Nothing here is computed. A check names the formulas it applies by these keys, so that whoever signs
can look each of them up: number and text stand in the catalogue under the same keys.

Of New Zealand's guidelines (section C8 of the assessment of existing buildings, July 2017, and its
drafts of 2015 and 2016) the public copies that could be searched give title pages and contents
alone: the displacement-based check of face-loaded walls, which %NBS rests on, is not here. Nor are
the h/t limits of ASCE 41, whose table was not found.
"""

from typing import NamedTuple

from studies.assess.catalogue import SAY

OFFICIAL = "official"  # wording, in a public transcription with page numbers
TRANSCRIPTION = "transcription"  # of the formula, in the same place, from the page's image
SECOND_HAND, DERIVED, UNREAD = "second_hand", "derived", "unread"
CIRCOLARE, NTC, EUROCODE, NEW_ZEALAND = "circolare", "ntc", "eurocode", "new_zealand"
SPECTRA = "spectra"  # of EN 1998-1
MECHANICS, OFFICE, CASAPULLA = "mechanics", "office", "casapulla"


class Formula(NamedTuple):
    """Document of a formula or rule and how it was read, by key (a constant above)."""

    document: str = CIRCOLARE
    read: str = TRANSCRIPTION


FORMULAS = {
    **dict.fromkeys(("multiplier", "interlocking", "acceleration", "displacement"), Formula()),
    **dict.fromkeys(("mass", "elastic", "period", "onset", "onset_free"), Formula()),
    "confidence": Formula(read=OFFICIAL),
    "limits": Formula(read=OFFICIAL),
    "lasting": Formula(read=OFFICIAL),
    "punching": Formula(OFFICE, SECOND_HAND),
    "crushing": Formula(MECHANICS, UNREAD),
    "behaviour": Formula(read=OFFICIAL),
    "secant_slv": Formula(),
    "secant_slc": Formula(),
    "largest": Formula(read=OFFICIAL),
    "at_height": Formula(),
    "dynamic": Formula(read=OFFICIAL),
    "floor": Formula(),
    "floor_peak": Formula(),
    "damaged": Formula(read=OFFICIAL),
    "spectrum": Formula(NTC),
    "eta": Formula(NTC),
    "motions": Formula(NTC, OFFICIAL),
    "rocking": Formula(EUROCODE, SECOND_HAND),
    "en_spectrum": Formula(SPECTRA, SECOND_HAND),
    "parts": Formula(NEW_ZEALAND, SECOND_HAND),
    "wedge": Formula(MECHANICS, DERIVED),
    "crack": Formula(CASAPULLA, SECOND_HAND),
    "hanging": Formula(MECHANICS, DERIVED),
    "energy": Formula(MECHANICS, DERIVED),
}


def cited(*keys):
    """Numbers of formulas by document, with how they were read, in one line of a table."""
    by: dict = {}
    for key in keys:
        by.setdefault(FORMULAS[key].document, []).append(key)
    parts = []
    for document, of_document in by.items():
        numbers = ", ".join(dict.fromkeys(SAY(f"formula.{key}.number") for key in of_document))
        read = dict.fromkeys(SAY(f"formula.read.{FORMULAS[key].read}") for key in of_document)
        parts.append(f"{SAY(f'formula.document.{document}')} {numbers} ({', '.join(read)})")
    return "; ".join(parts)
