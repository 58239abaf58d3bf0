"""What a block of numbers is: accelerations in a row, channels side by side or one after another.

The block decides, not its title. A declared number of samples that fits one reading only; columns
that rise evenly, which are times or running numbers; captions that name components; a last line
that is short; and at last how the numbers go on: neighbours in time are close to each other, so
accelerations in a row are close along the line, and channels are close down the column. What stays
open is a question of one line.
"""

import re
from dataclasses import dataclass, field

import numpy as np

from ..record import MAX_DT_S, MIN_DT_S
from ..text import check_last
from .block import MAX_COLUMNS, Block, once, read_block, values
from .header import heading_unit, stated_channels, stated_counts, whole_numbers

MOST = 12  # channels one after another
TIME_UNITS = {
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds", "sek", "segundos", "secondi"), 1.0),
    **dict.fromkeys(("ms", "msec", "milliseconds"), 1e-3),
}
LONG_LINE = 4  # numbers a line from which accelerations in a row are usual
FEW_LINES = 30  # below it the places along a line differ by chance
ALIKE = 0.8  # ratio of mean differences that counts as the same
CLOSER = 1.3  # ratio of neighbours' differences across to down, or down to across, that decides
_TIME = re.compile(
    r"\W*(time\w*|zeit|temps|tempo|tiempo|zaman|sec|secs|seconds?|ms|t\W*[(\[]\s*m?s\w*)(?![\w-])",
    re.I,
)
_COMPONENT = re.compile(
    r"(?i)(n-?s|e-?w|u-?d|w-?e|s-?n|[nsewuzxyltv]|up|north\w*|south\w*|east\w*|west\w*|nord|sud|est"
    r"|ovest|ost|norte|sur|este|oeste|vert\w*|long\w*|trans\w*|radial|[rt]|h[12nle]\w*"
    r"|(ch|can|kan)\w*[-.]?\d*|[ns]\d+[ew]|acc\w*|ace\w*|a[xyz_]\w*|\d{1,3}\s*(deg\w*|°))\W*(?:[ (\[_,/].*)?"
)


@dataclass(frozen=True)
class Layout:
    """What a block is.

    Attributes
    ----------
    kind : str
        Name of a format: "csv", "two-column", "columns", "wrapped" or "single-column".
    block : Block
    channels : list of (label, values, line)
        With the captions that the file has, empty where it has none.
    time_s : ndarray or None
        Times as printed, before their unit counts; caption and cells of them in `time`.
    time : (str, list)
    declared : (int or None, float or None)
        Number of samples and step of a first line of numbers.
    """

    kind: str
    block: Block
    channels: list
    time_s: np.ndarray | None = None
    time: tuple = ("", [])
    declared: tuple = (None, None)


@dataclass
class _Look:
    """A block under examination; `rows` is what is left of it."""

    text: object
    block: Block
    rows: list
    lines: list
    gaps: dict
    counts: list
    declared: tuple = (None, None)
    x: np.ndarray = field(default_factory=lambda: np.empty(0))

    @property
    def widths(self):
        return [len(row) for row in self.rows]

    def error(self, message, row=0):
        return self.text.error(self.lines[row], message)


def kind_of(text):
    """Name of the format that a file looks like; empty where it has no line of numbers."""
    found = once(text, layout)
    return found.kind if found else ""


def layout(text, as_columns=None):
    """`Layout` of a file, None without a line of numbers; a RecordError where it stays open.

    `as_columns` is what the user states: True for channels side by side, False for accelerations
    in a row.
    """
    block = read_block(text)
    if block is None:
        return None
    look = _Look(text, block, block.rows, block.lines, block.gaps, stated_counts(block.heading))
    _declaration(look)
    look.x = values(text, look.rows, look.lines)
    for decide in (_interleaved, _segments, _table, _in_a_row):
        found = decide(look, as_columns)
        if found:
            return found
    raise AssertionError("the last one decides")


# ---- a first line of count and step ----


def _declaration(look):
    """Take a count, with a step or without, off the first lines of numbers."""
    for top in (1, 2):
        taken = [cell for row in look.rows[:top] for cell in row]
        if len(look.rows) < top + 2 or len(taken) > 4:
            break
        counts = [int(cell) for cell in taken if re.fullmatch(r"\d{2,9}", cell)]
        rest = look.rows[top:]
        total, many = sum(map(len, rest)), len(rest)
        fits = [c for c in counts if c in (many, total) or (total == 2 * c and c >= 10)]
        fits += [c for c in counts if c >= 10 and c not in fits and _parts(total, c)]
        others = [float(cell) for cell in taken]
        if fits:
            others.remove(float(fits[0]))
            steps = [v if v <= MAX_DT_S else 1.0 / v for v in others if v > 0.0]
            steps = [v for v in steps if MIN_DT_S <= v <= MAX_DT_S]
            look.declared = fits[0], steps[0] if steps else None
            look.counts = [fits[0]]
            look.rows, look.lines = rest, look.lines[top:]
            look.gaps = {at - top: said for at, said in look.gaps.items() if at > top}
            return
    _refuse_lost_declaration(look)


def _parts(total, count):
    return total % count == 0 and 2 <= total // count <= MOST


def _refuse_lost_declaration(look):
    """Refuse a first line that reads as a count or a step, and fits nothing that follows."""
    row, rest = look.rows[0], look.rows[1:12]
    if len(rest) < 3 or look.block.separator:
        return
    whole = re.compile(r"\d+")
    bare = [bool(whole.fullmatch(cell)) for cell in row]
    after = [bool(whole.fullmatch(cell.lstrip("-+"))) for other in rest for cell in other]
    odd = len(row) != len(rest[0]) and len({len(other) for other in rest}) == 1
    if len(row) <= 2 and bare[0] and int(row[0]) >= 10 and not any(after) and (odd or sum(bare)):
        total, many = sum(map(len, look.rows)) - len(row), len(look.rows) - 1
        raise look.error(
            f"the line {' '.join(row)!r} reads as a number of samples, but {many} lines with "
            f"{total} numbers follow"
        )
    step = float(row[0])
    if len(row) == 1 and MIN_DT_S <= step <= MAX_DT_S and len(row[0].rstrip("0").lstrip("0.")) <= 2:
        x = np.array([float(cell) for other in rest for cell in other])
        shape = {len(c.partition(".")[2]) for other in rest for c in other}
        other_print = len(shape) == 1 and len(row[0].partition(".")[2]) not in shape
        jump = abs(step - x[0]) > 20.0 * np.max(np.abs(np.diff(x)), initial=0.0)
        if (other_print and jump) or odd:
            raise look.error(
                f"the first number is {row[0]}: a time step, or an acceleration? Write "
                f"'DT= {row[0]}' there, or delete it"
            )


# ---- times ----


def _rises(x, least=0.9):
    """Tell whether numbers rise or fall throughout, as no acceleration does.

    Nine of ten steps, so that a damaged time is refused by its line instead of taken for an
    acceleration. Also where there are too few to tell.
    """
    steps = np.diff(x[:: max(1, len(x) // 1000)])
    return len(steps) < 5 or max(np.mean(steps > 0), np.mean(steps < 0)) >= least


def _evenly(x):
    """Tell whether numbers rise by equal steps, within a third of one."""
    if len(x) < 4:
        return False
    steps = np.diff(x)
    step = (x[-1] - x[0]) / (len(x) - 1)
    return bool(step > 0 and np.all(np.abs(steps - step) < 0.34 * step))


def _counts_up(cells):
    """Tell whether a column holds running numbers, 1, 2, 3 …"""
    if not all(re.fullmatch(r"\d+(?:\.0*)?", cell) for cell in cells[:50]):
        return False
    x = np.array([float(cell) for cell in cells])
    return len(x) > 5 and bool(np.all(np.diff(x) == 1.0))


def _interleaved(look, as_columns):
    """Time and accelerations in turn, more than one set a line or each on its own line."""
    if look.gaps and any(look.gaps.values()):
        return None
    widths = look.widths
    for period in (2, 3, 4):
        regular = widths[0] > period and widths[0] % period == 0
        if len(look.x) % period or len(look.x) < 8 * period:
            continue
        if not (regular or set(widths) == {1}) or not _evenly(look.x[::period]):
            continue
        table = look.x.reshape(-1, period)
        flat = [cell for row in look.rows for cell in row]
        labels = _labels(look.block, period)
        if set(widths) == {1} and _counts_up(flat[::period]):
            continue
        _fits(look, len(table))
        channels = [(labels[c], table[:, c], look.lines[0]) for c in range(1, period)]
        kind = "two-column" if period == 2 else "columns"
        return Layout(
            kind, look.block, channels, table[:, 0], (labels[0], flat[::period]), look.declared
        )
    return None


def _fits(look, count):
    """Refuse a number of samples that is not the one declared."""
    if look.counts and count not in look.counts:
        said = " and ".join(map(str, look.counts))
        raise look.error(f"{count} samples, but the heading declares {said}", -1)


# ---- segments ----


def _segments(look, as_columns):
    """Equal blocks one after another, or pages of one block."""
    if not look.gaps:
        return None
    ends = [*sorted(look.gaps), len(look.rows)]
    starts = [0, *ends[:-1]]
    sizes = [sum(look.widths[a:b]) for a, b in zip(starts, ends, strict=True)]
    place = ends[0]
    paged = len(look.x) in look.counts or _evenly(look.x[:: look.widths[0]])
    if paged and not any(look.gaps.values()):
        look.gaps = {}  # blank lines within one block
        return None
    words = look.gaps[place]
    equal = len(set(sizes)) == 1 and sizes[0] > 1
    if not equal or len(sizes) > MOST:
        if words:
            raise look.error(f"expected a number, found {words[0].strip()[:40]!r}", place)
        raise look.text.error(look.lines[place] - 1, "blank line between the samples")
    if sizes[0] not in look.counts:
        if look.counts:
            _fits(look, len(look.x))
        if not words and sizes[0] < 2 * look.widths[0] + 1:
            raise look.text.error(look.lines[place] - 1, "blank line between the samples")
        if not words:
            raise look.error(
                f"{len(sizes)} equal blocks with a blank line between: one record, or as many "
                f"channels? State their number of samples in a line above, as NPTS= {sizes[0]}",
                place,
            )
    return _blocks(look, [look.x[sum(sizes[:i]) :][: sizes[0]] for i in range(len(sizes))], starts)


def _blocks(look, parts, starts):
    """Channels one after another; the first is their time where it rises evenly."""
    captions = [look.block.heading[-1:], *(look.gaps.get(s, []) for s in starts[1:])]
    labels = [next(iter(w), "").strip()[:80] for w in captions]
    labels = [label or f"block {i}" for i, label in enumerate(labels, 1)]
    lines = [look.lines[s] for s in starts]
    if any(set(look.widths[a:b][:-1]) - {look.widths[0]} for a, b in _spans(look, starts)):
        raise look.error("lines of different lengths within a block")
    width = look.widths[0]
    if width > 1 and _rises(parts[0][::width]):
        raise look.error(
            "blocks with a column of time, one after another; keep one of them in the file"
        )
    if 1 < width < LONG_LINE and (look.counts and len(parts[0]) // width in look.counts):
        raise look.error("blocks of several columns, one after another; keep one in the file")
    channels = list(zip(labels, parts, lines, strict=True))
    if _evenly(parts[0]):
        cells = [cell for row in look.rows for cell in row][: len(parts[0])]
        return Layout(
            "columns", look.block, channels[1:], parts[0], (labels[0], cells), look.declared
        )
    return Layout("columns", look.block, channels, declared=look.declared)


def _spans(look, starts):
    return zip(starts, [*starts[1:], len(look.rows)], strict=True)


# ---- columns ----


def _labels(block, columns):
    """Return the captions of columns, empty strings where no line names them."""
    lines = [line for line in block.heading if line.strip()][-3:]
    for place, line in enumerate(reversed(lines)):
        words = line.lstrip("#%!*/ \t")
        marks = (block.separator, "\t", ";", ",", "|", None)
        split = [
            block.cells(words.strip()),
            re.split(r"\s{2,}", words.strip()),
            *(words.split(m) for m in marks),
        ]
        found = next((c for c in split if len(c) == columns), None)
        if found is None:
            if place and re.search(r"\w", line):
                break
            continue
        found = [cell.strip("\"' ")[:80] for cell in found]
        if columns > 1 and any(re.search(r"[=:]$|^[^a-z%°]+$|^of$", c, re.I) for c in found if c):
            break  # a sentence of as many words
        above = list(reversed(lines))[place + 1 :]
        if above and all(
            heading_unit(c).unit or c.strip("()[]").lower() in TIME_UNITS for c in found
        ):
            for s in (block.separator, None):
                names = [c.strip("\"' ") for c in above[0].lstrip("#%!*/ \t").split(s)]
                if len(names) == columns:
                    return [f"{n} [{u.strip('()[]')}]" for n, u in zip(names, found, strict=True)]
        return found
    return [""] * columns


def _regular(look):
    """Refuse lines of different lengths; a short last one is left to the caller."""
    width = look.widths[0]
    for row, count in enumerate(look.widths):
        if count != width:
            raise look.error(f"{count} values, but {width} in the lines before", row)


def _table(look, as_columns):
    """Time and channels side by side; or named channels, or as many as the count says."""
    width = look.widths[0]
    if width < 2 or as_columns is False and not _rises(look.x[::width]):
        return None
    labels = _labels(look.block, width)
    whole = all(count == width for count in look.widths[:-1])
    times = [] if not whole else _times(look, labels, width)
    if not times and not _TIME.match(labels[0]):
        return None
    if len(look.rows) < 2:
        raise look.error("expected at least 2 samples")
    if width > MAX_COLUMNS:
        raise look.error(f"{width} columns; expected at most {MAX_COLUMNS}")
    _regular(look)
    table = look.x.reshape(-1, width)
    at = times[-1] if times else 0
    _check_commas(look, width)
    cells = [row[at] for row in look.rows]
    _fits(look, len(table))
    _check_end(look)
    left = [c for c in range(width) if c != at and c not in times]
    left = [c for c in left if not np.array_equal(table[:, c], table[:, at])]
    if not left:
        raise look.error("expected an acceleration beside the time")
    named = any(labels)
    channels = [
        (labels[c] if named else f"column {c + 1}", table[:, c], look.lines[0]) for c in left
    ]
    kind = "csv" if look.block.separator else "columns" if width > 2 else "two-column"
    if times and _counts_up(cells):
        return Layout(kind, look.block, channels, declared=look.declared)
    return Layout(kind, look.block, channels, table[:, at], (labels[at], cells), look.declared)


def _times(look, labels, width):
    """Columns that are running numbers or times, the time last."""
    rows = look.rows if len(look.rows[-1]) == width else look.rows[:-1]
    numbered, timed = [], []
    for c in range(width):
        x = look.x[: len(rows) * width][c::width]
        if not _rises(x) or (len(x) < 6 and c) or (len(x) < 2 and width > 2):
            continue
        if _counts_up([row[c] for row in rows]):
            numbered.append(c)
        elif c == 0 or c - 1 in numbered or _TIME.match(labels[c]) or _evenly(x):
            timed.append(c)
    # the first one is the time; others that are the same are left out beside it
    return numbered + timed[:1]


def _check_commas(look, width):
    """Refuse "0,01,0,0012" and "0.01,0,0012", where commas seem to be decimal marks too."""
    if look.block.separator != "," or width < 3:
        return
    for row in look.rows[:200]:
        rest = "".join(row[1:] if width % 2 else row)
        if "." in rest or "e" in rest.lower():
            return
    raise look.error(
        "commas seem to separate the columns and to mark decimals as well; separate them by "
        "semicolons or tabs, or write decimal points"
    )


def _check_end(look):
    """Refuse a last number that was cut off."""
    earlier = [row[-1] for row in look.rows[:1000] if row is not look.rows[-1]]
    if len(look.rows) < 3:
        earlier = [cell for row in look.rows for cell in row][:-1]
    elif look.widths[0] > 1 and len(look.rows[-1]) != look.widths[0]:
        earlier = [*look.rows[0], *look.rows[-1][:-1]]
    check_last(look.text, look.lines[-1], look.rows[-1][-1], earlier)


# ---- numbers without a time ----


def _in_a_row(look, as_columns):
    """Accelerations in a row, or channels without a time, by count, captions and neighbours."""
    width, total, many = look.widths[0], len(look.x), len(look.rows)
    if total < 2:
        raise look.error("expected at least 2 samples")
    if width == 1 and set(look.widths) == {1}:
        return _column(look, as_columns)
    labels = _labels(look.block, width)
    if many == 1 and any(labels):
        raise look.error("one line of numbers below its captions; expected at least 2 samples")
    whole = set(look.widths) == {width}
    named = whole and all(labels) and all(map(_COMPONENT.fullmatch, labels))
    if as_columns or (as_columns is None and _side_by_side(look, width, named, whole)):
        if width > MAX_COLUMNS:
            raise look.error(f"{width} columns; expected at most {MAX_COLUMNS}")
        _regular(look)
        _check_commas(look, width)
        _fits(look, many)
        _check_end(look)
        table = look.x.reshape(-1, width)
        named = any(labels)
        channels = [
            (labels[c] if named else f"column {c + 1}", table[:, c], look.lines[0])
            for c in range(width)
        ]
        kind = "csv" if look.block.separator else "columns"
        return Layout(kind, look.block, channels, declared=look.declared)
    parted = [c for c in look.counts if _parts(total, c)]
    if parted and total not in look.counts:
        starts = _starts(look, parted[0])
        parts = list(look.x.reshape(-1, parted[0]))
        return _blocks(look, parts, starts)
    if total not in look.counts:
        if not whole and set(look.widths[:-1]) != {width}:
            _regular(look)
        _fits(look, total)
    _check_end(look)
    return Layout("wrapped", look.block, [("", look.x, look.lines[0])], declared=look.declared)


def _starts(look, count):
    """Rows at which blocks of a count begin; a RecordError where one begins within a line."""
    ends = np.cumsum(look.widths)
    starts = [0, *(int(i) + 1 for i in np.flatnonzero(ends % count == 0))][:-1]
    if len(starts) != len(look.x) // count:
        raise look.error(f"{len(look.x)} samples, but the heading declares {count}", -1)
    return starts


def _side_by_side(look, width, named, whole):
    """Decide between channels side by side and accelerations in a row."""
    total, many = len(look.x), len(look.rows)
    closer = _closer(look.x[: many * width].reshape(-1, width)) if whole else 0
    if look.counts:
        if many in look.counts and whole:
            return True
        if total in look.counts and not (named or closer > 1):
            return False
        if any(_parts(total, c) for c in look.counts) and not named and closer <= 1:
            return False
        _fits(look, many if named or closer > 1 else total)
        raise _question(look, width)
    if named or closer > 1:
        return True
    numbers = whole_numbers(look.block.heading)
    if total in numbers and many not in numbers and closer < 1:
        return False
    if whole and many in numbers:
        return True
    if many == 1 or width >= LONG_LINE and stated_channels(look.block.heading) != width:
        short = not whole and set(look.widths[:-1]) == {width}
        if many == 1 or closer < 0 or (short and _closer_short(look, width) <= (many < FEW_LINES)):
            return False
    if not whole and set(look.widths[:-1]) != {width}:
        _regular(look)
    raise _question(look, width)


def _closer_short(look, width):
    """As `_closer`, of a block whose last line is short."""
    rows = look.x[: (len(look.rows) - 1) * width].reshape(-1, width)
    return _closer(rows) if len(rows) > 1 else 0


def _closer(table):
    """2 where neighbours down the columns are closer, -1 along the lines; 1 and 0: it is open.

    Down: closer than along the line, at which all distances are alike: a motion of the period of a
    line is close down the columns too, and closer to its neighbours than half a line away. Along:
    each number is as close to the next, over the end of a line too; channels that move alike are
    close along the line, but not over its end, which makes a 1.
    """
    rows, width = table.shape
    if rows < 8:
        return 0
    flat = table.ravel()
    down = np.abs(table[1:] - table[:-1]).mean()
    steps = np.abs(np.diff(flat))
    across = steps.mean()
    if not down > 0.0 or not across > 0.0:
        return 0
    by_place = np.nanmean(np.append(steps, np.nan).reshape(rows, width), axis=0)
    even = by_place.max() < (1.0 + 4.0 / np.sqrt(rows)) * by_place.min()
    if down * CLOSER < across:
        apart = [np.abs(flat[lag:] - flat[:-lag]).mean() for lag in range(2, width)]
        return 2 if across > ALIKE * max(apart, default=0.0) else 1
    if across * CLOSER < down and even:
        return -1
    return 1 if not even else 0


def _question(look, width):
    many = len(look.rows)
    return look.error(
        f"{width} numbers a line, {many} lines, no time: one record read line by line, or {width} "
        f"channels? State the format, wrapped or columns, or the number of samples in a line "
        f"above, as NPTS= {many}"
    )


def _column(look, as_columns):
    """One number a line: one record, or records one after another."""
    total = len(look.x)
    if as_columns:
        raise look.error("expected time and acceleration, two numbers a line")
    parted = [c for c in look.counts if _parts(total, c)]
    if parted and total not in look.counts:
        return _blocks(look, list(look.x.reshape(-1, parted[0])), _starts(look, parted[0]))
    for blocks in (2, 3, 4):
        if total % blocks == 0 and total // blocks > 8 and _evenly(look.x[: total // blocks]):
            parts = list(look.x.reshape(blocks, -1))
            return _blocks(look, parts, [i * (total // blocks) for i in range(blocks)])
    _fits(look, total)
    _check_end(look)
    heading = [line for line in look.block.heading if line.strip()]
    several = stated_channels(heading)
    names = re.split(r"[\s,;|/]+", heading[-1].strip()) if heading else []
    if len(names) > 1 and all(map(_COMPONENT.fullmatch, names)):
        several = len(names)
    if several > 1 and total not in look.counts:
        raise look.error(
            f"the heading says {several} channels, but there is one number a line: state their "
            f"number of samples in a line above, as NPTS= {total // several}"
        )
    if total > 5 and _evenly(look.x):
        raise look.error("the numbers rise evenly, as times do and no acceleration does")
    label = _labels(look.block, 1)[0]
    label = "" if len(label.split()) > 3 or re.search(r"[:=\d]", label) else label
    return Layout(
        "single-column", look.block, [(label, look.x, look.lines[0])], declared=look.declared
    )
