"""The numbers of a file without a header of its own kind: where they begin, and their cells.

A file is lines of words and lines of numbers. Cells are apart by blanks, tabs, commas or
semicolons, in quotation marks or not; numbers may have decimal commas where those are not
separators too. Words between numbers, and blank lines, part a block into segments.
"""

import re
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from .header import NUMBER, is_numbers
from .text import MAX_SAMPLES, parse_number

MAX_COLUMNS = 64
MAX_HEADING = 500
LOOK = 200  # lines that decide on separators
FEW = 3  # lines of numbers within a heading: a date, coordinates
_COMMA = re.compile(r"[-+]?(?:\d*,)?\d+(?:[eE][-+]?\d+)?")
_QUOTED = re.compile(r"[\"']\s*([-+.,\deEdD]*)\s*[\"']")
_START = re.compile(r"\s*[-+]?\.?\d")
_DIGIT = re.compile(r"\d")


@dataclass(frozen=True)
class NumberBlock:
    """The lines of numbers, as rows of words that are numbers.

    Attributes
    ----------
    heading : list of str
        The lines before.
    rows : list of list of str
    lines : list of int
        The line of each row, from 1.
    gaps : dict
        Row before which lines are blank or words -> the words, empty for blank lines.
    separator : str or None
        None: blanks.
    decimal_comma : bool
    """

    heading: list
    rows: list
    lines: list
    gaps: dict = field(default_factory=dict)
    separator: str | None = None
    decimal_comma: bool = False

    @property
    def first(self):
        """Line of the first numbers."""
        return self.lines[0]

    def cells(self, line):
        """Cells of a line, with decimal points."""
        return cells(line, self.separator, self.decimal_comma)


def cells(line, separator, decimal_comma):
    """Cells of a line, with decimal points, without an empty one at the end."""
    if '"' in line or "'" in line:
        line = _QUOTED.sub(r"\1", line)
    words = line.split(separator)
    if separator:
        words = [cell.strip() for cell in words]
        while len(words) > 1 and not words[-1]:
            words.pop()
    return [cell.replace(",", ".") for cell in words] if decimal_comma else words


def read_block(text):
    """Return the `NumberBlock` of a file, None where no line is numbers alone."""
    first = _first(text)
    if not first:
        return None
    lines = text.lines
    separator, comma = _separator(lines, first)
    last = len(lines)
    while last > first and (not lines[last - 1].strip() or _footer(lines[last - 1])):
        last -= 1
    rows: list[list[str]] = []
    numbers: list[int] = []
    gaps: dict[int, list[str]] = {}
    words: list[str] | None = None
    for number in range(first, last + 1):
        line = lines[number - 1]
        if not line.strip():
            words = words or []
            continue
        if not _START.match(line) and not is_numbers(line):
            if not _may_part(line):
                raise _no_number(text, number, line, separator, comma)
            words = [*(words or []), line]
            continue
        if words is not None:
            gaps[len(rows)] = words
            words = None
        row = cells(line, separator, comma)
        if len(rows) < 2 and not all(map(_PLAIN.fullmatch, row)):  # a count and a step
            row = line.replace(";", " ").split() if is_numbers(line) else row
        rows.append(_checked(text, number, row))
        numbers.append(number)
    return NumberBlock(lines[: first - 1], rows, numbers, gaps, separator, comma)


def _first(text):
    """Line of the first numbers of the block; lines of numbers in its heading are none of it.

    A heading may hold a few lines of numbers, of another form than the block's, before words.
    """
    head = text.lines[:MAX_HEADING]
    runs: list[list[int]] = []  # first and last line of numbers in a row
    for number, line in enumerate(head, 1):
        if line.strip() and is_numbers(line):
            if runs and runs[-1][1] == number - 1:
                runs[-1][1] = number
            else:
                runs.append([number, number])
    place = 0
    while place + 1 < len(runs):
        (a, b), (c, d) = runs[place], runs[place + 1]
        between = [line for line in head[b : c - 1] if line.strip()]
        short = b - a + 1 <= FEW < d - c + 1
        if not (short and between and all(map(_may_part, between)) and _differ(head, b, c)):
            break
        place += 1
    first = runs[place][0] if runs else 0
    if first:
        before = next((row for row in reversed(text.lines[: first - 1]) if row.strip()), "")
        same = len(before.split()) == len(text.lines[first - 1].split())
        if _START.match(before) and same and not _worded(before):
            raise text.error(
                first - 1, f"expected numbers as in the next line, found {before[:40]!r}"
            )
    return first


def _differ(head, number, other):
    """Tell whether two lines of numbers have another form: whole numbers, or another count."""
    a, b = head[number - 1].split(), head[other - 1].split()
    return len(a) != len(b) or not any("." in word or "," in word for word in a)


def _may_part(line):
    """Tell whether a line is words as a caption between numbers, not a damaged number."""
    return not _START.match(line) and _worded(line)


def _worded(line):
    words = re.findall(r"[^\W\d_]{2,}", line)
    return any(word.lower() not in ("nan", "inf") for word in words)


def _footer(line):
    return not _DIGIT.search(line) and (_may_part(line) or not line.strip(" \t*/&-=_#%!|."))


def _no_number(text, number, line, separator, comma):
    for cell in cells(line, separator, comma):
        parse_number(text, number, cell, "a number")
    return text.error(number, f"expected a number, found {line.strip()[:40]!r}")


def _checked(text, number, row):
    for cell in row:
        if not _PLAIN.fullmatch(cell):
            parse_number(text, number, cell, "a number")
    return row


_PLAIN = re.compile(NUMBER, re.ASCII)


def _separator(lines, first):
    rows = [row for row in lines[first - 1 : first - 1 + LOOK] if row.strip() and is_numbers(row)]
    rows = [_QUOTED.sub(r"\1", row) if '"' in row or "'" in row else row for row in rows]
    rows = rows[2:] if len(rows) > 4 else rows  # the first ones may be a count and a step
    words = [word for row in rows for word in row.replace(";", " ").split()]
    comma = any("," in word for word in words) and all(map(_COMMA.fullmatch, words))
    if 2 * sum(";" in row for row in rows) > len(rows):
        return ";", comma
    return "," if 2 * sum("," in row for row in rows) > len(rows) and not comma else None, comma


def values(text, rows, lines):
    """Numbers of rows as one array, in the order of reading, each checked finite."""
    count = sum(map(len, rows))
    if count > 4 * MAX_SAMPLES:
        raise text.error(lines[0], f"more than {4 * MAX_SAMPLES} numbers")
    numbers = np.fromiter((float(cell) for row in rows for cell in row), float, count)
    bad = np.flatnonzero(~np.isfinite(numbers))
    if bad.size:
        ends = np.cumsum([len(row) for row in rows])
        raise text.error(
            lines[int(np.searchsorted(ends, bad[0], side="right"))],
            "a number too large for double precision",
        )
    return numbers


@lru_cache(maxsize=1)
def _kept(key):
    return {}


def once(text, make):
    """`make(text)`, once for a file that is looked at and then read."""
    kept = _kept((text.path, text.sha256))
    if "made" not in kept:
        kept["made"] = make(text)
    return kept["made"]
