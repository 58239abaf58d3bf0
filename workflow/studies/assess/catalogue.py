"""Sentences of the report by key and language: code computes keys and values, text is made here.

A language is a folder of `language/`; the text under `ties` of its `heading.yaml` has the key
`heading.ties`. A text names its values and how each is written, `{pga_g:g3} g`: code hands numbers
on. How many there are is told by key too: `one` and `many` beside each other (`Catalogue.count`).

Numbers are written as the language does: Italian ones with a decimal comma, as reports in Italy
have them. Tables of results keep the point.
"""

import math
import string
from functools import cache
from numbers import Integral
from pathlib import Path

import yaml

FOLDER = Path(__file__).parent / "language"
ENGLISH, ITALIAN = "en", "it"
LANGUAGES = (ENGLISH, ITALIAN)
POINT: dict = {}
COMMA = str.maketrans(".,", ",.")
MARKS = {ENGLISH: POINT, ITALIAN: COMMA}  # decimal mark, and that of thousands
MINUS = str.maketrans("-", "−")
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
NOTHING, ENDLESS = "–", "∞"


def percent(value):
    """Whole per cent; what is just short of the whole keeps a tenth, and is not 100 %."""
    if 0.995 <= value < 1.0:
        return f"{math.floor(1000.0 * value) / 10.0:.1f} %"
    return f"{100 * value:.0f} %".translate(MINUS)


def power(value):
    """Two figures of a rate: 0.0014, 8.8·10⁻⁵."""
    if not 0.0 < value < 1e-3:
        return f"{value:.2g}"
    digits, exponent = f"{value:.1e}".split("e")
    return f"{digits}·10{str(int(exponent)).translate(RAISED)}"


def three(value):
    """Three figures, `ENDLESS` without an end, a dash where there is none."""
    if value != value:
        return NOTHING
    return ENDLESS if value == math.inf else f"{value:.3g}"


def force(force_kn):
    """A force to a tenth, and to two digits where that would leave nothing of it."""
    return f"{force_kn:.1f} kN" if force_kn >= 0.05 else f"{force_kn:.2g} kN"


SPECS = {  # beside Python's own
    "percent": percent,
    "power": power,
    "g3": three,
    "kn": force,
    "mm": lambda metres: f"{1e3 * metres:.0f} mm",
    "mm3": lambda metres: f"{1e3 * metres:.3g} mm",
    "two": lambda value: f"{float(f'{value:.2g}'):g}",
    "six": lambda value: f"{value:.6g}".translate(MINUS),
}


class _Formatter(string.Formatter):
    """Writes numbers by `SPECS` and as a language does; a number without a format is refused."""

    def __init__(self, marks, endless):
        self.marks, self.endless = marks, endless

    def format_field(self, value, spec):
        if isinstance(value, str):
            return format(value, spec)
        if not spec:
            if isinstance(value, Integral):
                return str(value)
            raise ValueError(f"number {value!r} without a format")
        text = SPECS[spec](value) if spec in SPECS else format(value, spec)
        return self.endless if text == ENDLESS else text.translate(self.marks)


class Catalogue:
    """Texts of one language by key; called with a key and the values that its text names.

    `marks` is the table for `str.translate` from a number in Python to one of the language.
    """

    def __init__(self, language, texts):
        """Know how numbers are written."""
        self.language, self.texts, self.marks = language, texts, MARKS[language]
        self._formatter = _Formatter(self.marks, texts["number.never"])

    def __call__(self, key, /, **values):
        """Text of a key; KeyError without such a key, or without a value that it names."""
        return self._formatter.vformat(self.texts[key], (), values)

    def count(self, key, n, /, **values):
        """Text of one, or of many: `key.one` and `key.many`, which may name `n`."""
        return self(f"{key}.{'one' if n == 1 else 'many'}", n=int(n), **values)

    def number(self, value, spec):
        """A number as the language writes it."""
        return self._formatter.format_field(value, spec)

    def all_of(self, names):
        """Names in a sentence: one, two and three."""
        names = list(names)
        last = self.texts["number.and"].join(("", " ")) if names[1:] else ""
        return f"{', '.join(names[:-1])} {last}{names[-1]}" if last else "".join(names)


def flat(tree, before=""):
    """Texts by dotted key."""
    texts: dict[str, str] = {}
    for key, value in tree.items():
        name = f"{before}{key}"
        texts |= flat(value, f"{name}.") if isinstance(value, dict) else {name: value}
    return texts


@cache
def catalogue(language=ENGLISH):
    """`Catalogue` of a language; a ValueError of one line for one that there is not."""
    if language not in LANGUAGES:
        known = ", ".join(LANGUAGES)
        raise ValueError(f"assessment.language = {language!r}: expected one of {known}")
    texts: dict[str, str] = {}
    for path in sorted((FOLDER / language).glob("*.yaml")):
        texts |= flat(yaml.safe_load(path.read_text("utf-8")), f"{path.stem}.")
    return Catalogue(language, texts)


SAY = catalogue()  # tables and messages are in English, whatever the report is in
