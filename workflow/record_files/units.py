"""Units of acceleration: their names, their values in m/s², and words that are no unit.

One grammar for the column `units` of a table, the captions of columns and free headings: a unit is
what its spelling says, in any case, with or without blanks, accents and superscripts.
"""

import re
import unicodedata

G_M_S2 = 9.80665  # standard gravity, in which motions are stated

UNITS_M_S2 = {
    **{"g": G_M_S2, "m/s2": 1.0, "cm/s2": 1e-2, "mm/s2": 1e-3},
    **{"mg": 1e-3 * G_M_S2, "%g": 1e-2 * G_M_S2, "g/10": 0.1 * G_M_S2},
    **{"in/s2": 0.0254, "ft/s2": 0.3048},
}
_PER_S2 = (
    r"(?:\s*/\s*\(?s(?:ec(?:ond)?s?)?\.?\s*(?:\^|\*\*)?\s*2\)?"  # /s2, /sec^2, /(s**2)
    r"|\s*/\s*\(?s(?:ec)?\s*[/*.]?\s*s(?:ec)?\)?"  # /s/s, /(s*s)
    r"|[ .*]?\s*s(?:ec)?\s*(?:\^|\*\*)?\s*\(?-2\)?"  # m s-2, m.s^-2
    r"|_s2|\s+per\s+s(?:ec(?:ond)?)?\s+(?:per\s+s(?:ec(?:ond)?)?|squared))"
)
_LENGTH = r"(?P<length>mm|cm|m|in|ft)"
_PER_S = r"\s*(?:/\s*s(?:ec(?:ond)?s?)?|[ .*]s\s*(?:\^|\*\*)?\s*-1|_s|\s+per\s+s(?:ec(?:ond)?)?)"
# The order decides: a spelling counts as the first that it fits as a whole.
_SPELLINGS = {
    "length/s2": rf"{_LENGTH}{_PER_S2}",
    "g/10": r"g\s*/\s*10|0?\.1\s*\*?\s*g|tenths?\s+of\s+(?:a\s+)?g",
    "mg": r"mg'?s?|milli-?\s*g'?s?|g\s*/\s*1000|0?\.001\s*\*?\s*g"
    r"|1\.?0?e-0?3\s*\*?\s*g|10\s*\^?-3\s*\*?\s*g",
    "%g": r"%\s*(?:of\s+)?g|g\s*%|per\s?cent\s*(?:of\s+)?g|pct\s*g|0?\.01\s*\*?\s*g|g\s*/\s*100",
    "g": r"g'?s?|g\s*units?",
    "cm/s2": r"gals?",
}
_OTHERS = {  # what is no acceleration, or none that is known
    "velocity": rf"(?:mm|cm|km|m|in|ft){_PER_S}|kines?",
    "displacement": r"mm|cm|m|meters?|metres?|inch(?:es)?|ft|feet",
    "an instrument": r"counts?|cuentas?|conteggi|coups|digits?|lsb|adc(?:\s*counts?)?",
    "voltage": r"v|mv|[uμ]v|(?:milli|micro)?volts?",
    "milligal": r"m(?:illi)?gals?",
    "rotation": rf"(?:m?rad|deg)(?:{_PER_S2}|{_PER_S})",
}
_WHOLE = {name: re.compile(words) for name, words in (_SPELLINGS | _OTHERS).items()}
_KNOWN = tuple(_SPELLINGS)
# Any of them within words, the longest first.
WITHIN = "|".join(
    f"(?:{words.replace('?P<length>', '?:')})"
    for words in (
        *(_SPELLINGS[k] for k in ("length/s2", "g/10", "mg", "%g")),
        *(_OTHERS[k] for k in ("milligal", "rotation", "velocity", "an instrument")),
        *(_SPELLINGS["cm/s2"], _SPELLINGS["g"], _OTHERS["voltage"], _OTHERS["displacement"]),
    )
)


def plain(text):
    """Text in lower case without accents and superscripts, "m/s²" as "m/s2"."""
    text = text.replace("μ", "u").replace("µ", "u").replace("−", "-").replace("·", " ")
    text = "".join(c for c in unicodedata.normalize("NFKD", text) if not unicodedata.combining(c))
    return text.replace("−", "-").replace("⁻", "-").lower()


def _kind(text):
    """Name of the spelling that a word is, and its match; (None, None) for no unit."""
    word = " ".join(plain(text).split()).strip(" .,;:")
    matches = ((name, form.fullmatch(word)) for name, form in _WHOLE.items())
    return next(((name, match) for name, match in matches if match), (None, None))


def unit_name(text):
    """Return the canonical unit, a key of `UNITS_M_S2`, of a spelling, or None.

    Accepts g, g's, gal, mg, %g, g/10 and m, cm, mm, in, ft with /s2, /s^2, /s**2, /s/s, /sec2,
    /sec/sec, s-2, _s2, in either case, and superscripts.
    """
    name, match = _kind(text)
    if name == "length/s2":
        return f"{match['length']}/s2"
    return name if name in _KNOWN else None


def no_acceleration(text):
    """What a unit measures that is no acceleration ("velocity"); empty for one, or for no unit."""
    name, _ = _kind(text)
    return name if name in _OTHERS else ""
