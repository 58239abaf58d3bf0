"""Safe reading of text files and blocks of numbers, every refusal with its line.

The limits keep memory below 1 GB whatever the file holds: a record of 2 million
samples lasts 10,000 s at 200 Hz.
"""

import codecs
import hashlib
import math
import os
import re
from array import array
from dataclasses import dataclass

import numpy as np

from .errors import RecordError

MAX_BYTES = 64 * 2**20
MAX_LINES = 2_000_000
MAX_LINE_CHARACTERS = 10_000
MAX_SAMPLES = 2_000_000
MIN_DT_S, MAX_DT_S = 1e-4, 0.1  # of a recording

_CONTROL = re.compile(rb"[\x00-\x08\x0b\x0e-\x1f\x7f]")
_FORTRAN = re.compile(r"(\d\.?)[dD]([-+]?\d)")  # 1.5D-03
_DOUBLES = re.compile(r"[0-9+\-.,;dDeE\s]*")
_NUMERIC = re.compile(r"[0-9+\-.eE \t]*")


@dataclass(frozen=True)
class Text:
    """A text file as lines without their ends; `line` arguments count from 1.

    complete: the last line has its end, so the file was not cut off within it.
    """

    path: str
    lines: list
    sha256: str
    complete: bool

    def error(self, line, message):
        """Return the RecordError for a line of this file."""
        return RecordError.at(self.path, line, message)

    def line(self, number, expected):
        """Return line `number` (from 1); raise when the file ends before it."""
        if number > len(self.lines):
            raise self.error(len(self.lines), f"the file ends here; expected {expected}")
        return self.lines[number - 1]

    def said(self):
        """Return (number, line) of those that are neither blank nor remarks, which begin with #."""
        every = enumerate(self.lines, 1)
        return [(n, line) for n, line in every if line.strip() and not line.startswith("#")]


def read_text(path):
    """Read a whole text file of bounded size: UTF-8, or Latin-1 when it is not.

    Raises
    ------
    RecordError
        No such file, not a regular file, empty, larger than MAX_BYTES or MAX_LINES,
        binary, or with a line longer than MAX_LINE_CHARACTERS.
    """
    path = os.fspath(path)
    # A named pipe or a device could block for ever, so only regular files are opened.
    if not os.path.isfile(path):
        state = "is not a regular file" if os.path.exists(path) else "does not exist"
        raise RecordError(f"{path}: the file {state}")
    try:
        with open(path, "rb") as stream:
            data = stream.read(MAX_BYTES + 1)
    except OSError as problem:
        raise RecordError(f"{path}: cannot be read ({problem.strerror})") from None
    return text_from_bytes(path, data)


def text_from_bytes(path, data):
    """Check and decode bytes already read from `path`; see `read_text`."""
    if len(data) > MAX_BYTES:
        raise RecordError(f"{path}: larger than {MAX_BYTES // 2**20} MB; cut it to the motion")
    digest = hashlib.sha256(data).hexdigest()
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):  # as spreadsheets save it
        data = data.decode("utf-16", errors="replace").encode()
    data = data.rstrip(b"\x1a")  # DOS end-of-file mark
    if not data.removeprefix(codecs.BOM_UTF8).strip():
        raise RecordError(f"{path}: the file is empty")
    control = _CONTROL.search(data)
    if control:
        line = data.count(b"\n", 0, control.start()) + 1
        raise RecordError.at(
            path, line, f"binary data (byte 0x{data[control.start()]:02x}); expected a text file"
        )
    if data.count(b"\n") + data.count(b"\r") > 2 * MAX_LINES:
        raise RecordError(f"{path}: more than {MAX_LINES} lines")
    try:
        content = data.decode("utf-8-sig")
    except UnicodeDecodeError:  # names in Latin-1 headings; numbers are ASCII in any encoding
        content = data.decode("cp1252", errors="replace")
    if _FORTRAN.search(content):
        content = "\n".join(
            _FORTRAN.sub(r"\1E\2", line) if _DOUBLES.fullmatch(line) else line
            for line in content.split("\n")
        )
    # Not str.splitlines: it also breaks at separators no record format knows.
    content = content.replace("\r\r\n", "\n")  # copied as text twice
    lines = content.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    complete = not lines[-1]
    if complete:
        lines.pop()
    if len(lines) > MAX_LINES:
        raise RecordError(f"{path}: more than {MAX_LINES} lines")
    for number, line in enumerate(lines, 1):
        if len(line) > MAX_LINE_CHARACTERS:
            raise RecordError.at(path, number, f"longer than {MAX_LINE_CHARACTERS} characters")
    return Text(path, lines, digest, complete)


def parse_number(text, number, token, what):
    """Parse one finite decimal number; `what` names it in the refusal."""
    token = token.strip()
    try:
        value = float(token) if _NUMERIC.fullmatch(token) else math.nan
    except ValueError:
        value = math.nan
    if math.isfinite(value):
        return value
    raise text.error(number, f"expected {what}, found {token[:40]!r}{comma_hint(token)}")


def comma_hint(token):
    """What to say of a number with a decimal comma where a point is expected; else nothing."""
    comma = re.fullmatch(r"\s*[+-]?\d*,\d+([eE][+-]?\d+)?\s*", token)
    return "; write a decimal point, not a comma" if comma else ""


def parse_count(text, number, token, what):
    """Parse a number of samples, 2 … MAX_SAMPLES."""
    token = token.strip()
    if not re.fullmatch(r"[0-9]{1,9}", token) or not 2 <= int(token) <= MAX_SAMPLES:
        raise text.error(number, f"expected {what} (2 … {MAX_SAMPLES}), found {token[:40]!r}")
    return int(token)


def _numbers(text, number, tokens, values):
    """Append the tokens of one line to `values`, refusing anything but finite decimals."""
    if not _NUMERIC.fullmatch("".join(tokens)):
        bad = next(token for token in tokens if not _NUMERIC.fullmatch(token))
        raise text.error(number, f"expected a number, found {bad.strip()[:40]!r}{comma_hint(bad)}")
    try:
        values.extend(map(float, tokens))
    except ValueError:
        for token in tokens:
            parse_number(text, number, token, "a number")
        raise
    if len(values) > MAX_SAMPLES:
        raise text.error(number, f"more than {MAX_SAMPLES} samples")


def _finite(text, values, line_of_value):
    """Return the array, checked finite."""
    result = np.asarray(values)
    bad = np.flatnonzero(~np.isfinite(result))
    if bad.size:
        line = max(line for start, line in line_of_value if start <= bad[0])
        raise text.error(line, "a number too large for double precision")
    return result


def _shape(token):
    """Return the number of digits after the point, and of characters from the e onwards."""
    mantissa, mark, exponent = token.lower().partition("e")
    return len(mantissa.partition(".")[2]), len(mark + exponent)


def check_last(text, number, token, earlier):
    """Refuse a last number that was cut off, "1.75291" of "1.7529137E-02".

    Only where the file does not end in a line end; `earlier` are numbers of its column.
    """
    shapes = [_shape(word) for word in earlier]
    if text.complete or not shapes:
        return
    digits, exponent = _shape(token)
    if digits < min(s[0] for s in shapes) or exponent < min(s[1] for s in shapes):
        raise text.error(
            number, f"the file ends in {token[-40:]!r}, unlike the numbers before: is it cut off?"
        )


def free_block(text, first, count):
    """Read blank-separated numbers from line `first` (from 1) to the end of the file.

    Blank lines and a closing "*** End data ***" are skipped. `count` is the declared
    number of values, or None.

    Returns
    -------
    ndarray, shape (count,)
    """
    values, line_of_value, last = array("d"), [], len(text.lines)
    while last > first and text.lines[last - 1].lstrip()[:3] in ("", "***"):
        last -= 1
    for number in range(first, last + 1):
        tokens = text.lines[number - 1].split()
        if tokens:
            line_of_value.append((len(values), number))
            _numbers(text, number, tokens, values)
            if count is not None and len(values) > count:
                raise text.error(
                    number, f"more values than the {count} samples the header declares"
                )
    number = first
    if line_of_value:
        number = line_of_value[-1][1]
        *earlier, token = text.lines[number - 1].split()
        check_last(text, number, token, text.lines[first - 1].split() + earlier)
    result = _finite(text, values, line_of_value)
    if count not in (None, len(result)):
        raise text.error(
            number, f"{len(result)} values up to here, but the header declares {count} samples"
        )
    return result


def gridded_block(text, first, width, indent, per_line, count):
    """Read `count` numbers (None: any) to the end of the file, in columns if the first line is.

    The columns end at indent, indent + width, …; then every line must keep to them,
    which shows a lost digit. Otherwise the numbers are free, apart by blanks.
    """
    line = text.line(first, f"{count or 'the'} values").rstrip()
    whole = indent + width * (per_line - 1)
    ends = [match.end() for match in re.finditer(r"\S+", line[: whole + 1])]
    if count is None or len(line) != whole or ends != list(range(indent, whole + 1, width)):
        return free_block(text, first, count)
    values, following = fixed_block(text, first, width, per_line, count, indent)
    for number in range(following, len(text.lines) + 1):
        if text.lines[number - 1].strip():
            raise text.error(number, f"more values than the {count} samples the header declares")
    return values


def fixed_block(text, first, width, per_line, count, indent=None):
    """Read `count` numbers of a Fortran record, fields `width` wide, `per_line` a line.

    Neighbouring fields may touch, so blanks do not separate them. Fields are
    right-justified: one that ends in a blank means a shifted or damaged line. The
    first field ends at `indent`, `width` when None; what is before it by more than that is blank.

    Returns
    -------
    values : ndarray, shape (count,)
    next_line : int
        The line (from 1) after the block.
    """
    rows = -(-count // per_line)
    margin = " " * (width - indent) if indent else ""
    blank = max((indent or width) - width, 0)
    values, line_of_value = array("d"), []
    for row in range(rows):
        number = first + row
        line = margin + text.line(number, f"{count - len(values)} more values").rstrip()
        line = line[blank:] if not line[:blank].strip() else line
        expected = min(per_line, count - len(values))
        if "\t" in line or len(line) != expected * width:
            raise text.error(
                number,
                f"expected {expected} values in columns of {width} characters "
                f"(sample {len(values) + 1} of {count} onwards)",
            )
        tokens = [line[i : i + width] for i in range(0, len(line), width)]
        if any(token[-1] == " " or " " in token.strip() for token in tokens):
            raise text.error(number, f"values are not in columns of {width} characters")
        line_of_value.append((len(values), number))
        _numbers(text, number, tokens, values)
    return _finite(text, values, line_of_value), first + rows
