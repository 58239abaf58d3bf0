"""What a block of numbers is: accelerations in a row, channels side by side or one after another.

The block decides, not its title. A declared number of samples that fits one reading only; columns
that rise evenly, which are times or running numbers; captions that name components; a last line
that is short; and at last how the numbers go on: neighbours in time are close to each other, so
accelerations in a row are close along the line, and channels are close down the column. What stays
open is a question of one line.
"""

import re

import numpy as np

from .block import MAX_COLUMNS, once, read_block, values
from .captions import COMPONENT, TIME, labels_of
from .declared import MOST, declaration, divides
from .header import stated_channels, stated_counts, whole_numbers
from .look import Layout, Look
from .neighbours import closer
from .text import check_last

LONG_LINE = 4  # numbers a line from which accelerations in a row are usual
FEW_LINES = 30  # below it the places along a line differ by chance


def kind_of(text):
    """Name of the format that a file looks like; empty where it has no line of numbers."""
    file_layout = once(text, layout)
    return file_layout.kind if file_layout else ""


@np.errstate(
    over="ignore", invalid="ignore"
)  # numbers that no record has are refused by their peak
def layout(text, as_columns=None):
    """`Layout` of a file, None without a line of numbers; a RecordError where it stays open.

    `as_columns` is what the user states: True for channels side by side, False for accelerations
    in a row.
    """
    block = read_block(text)
    if block is None:
        return None
    look = Look(text, block, block.rows, block.lines, block.gaps, stated_counts(block.heading))
    declaration(look)
    look.x = values(text, look.rows, look.lines)
    for decide in (_interleaved, _segments, _table, _in_a_row):
        file_layout = decide(look, as_columns)
        if file_layout:
            return file_layout
    raise AssertionError("the last one decides")


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
        labels = labels_of(look.block, period)
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
    labels = labels_of(look.block, width)
    whole = all(count == width for count in look.widths[:-1])
    times = [] if not whole else _times(look, labels, width)
    if not times and not TIME.match(labels[0]):
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
        elif c == 0 or c - 1 in numbered or TIME.match(labels[c]) or _evenly(x):
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
    labels = labels_of(look.block, width)
    if many == 1 and any(labels):
        raise look.error("one line of numbers below its captions; expected at least 2 samples")
    whole = set(look.widths) == {width}
    named = whole and all(labels) and all(map(COMPONENT.fullmatch, labels))
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
    parted = [c for c in look.counts if divides(total, c)]
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
    near = closer(look.x[: many * width].reshape(-1, width)) if whole else 0
    if look.counts:
        if many in look.counts and whole:
            return True
        if total in look.counts and not (named or near > 1):
            return False
        if any(divides(total, c) for c in look.counts) and not named and near <= 1:
            return False
        _fits(look, many if named or near > 1 else total)
        raise _question(look, width)
    if named or near > 1:
        return True
    numbers = whole_numbers(look.block.heading)
    if total in numbers and many not in numbers and near < 1:
        return False
    if whole and many in numbers:
        return True
    if many == 1 or width >= LONG_LINE and stated_channels(look.block.heading) != width:
        short = not whole and set(look.widths[:-1]) == {width}
        if many == 1 or near < 0 or (short and _closer_short(look, width) <= (many < FEW_LINES)):
            return False
    if not whole and set(look.widths[:-1]) != {width}:
        _regular(look)
    raise _question(look, width)


def _closer_short(look, width):
    """As `_closer`, of a block whose last line is short."""
    rows = look.x[: (len(look.rows) - 1) * width].reshape(-1, width)
    return closer(rows) if len(rows) > 1 else 0


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
    parted = [c for c in look.counts if divides(total, c)]
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
    if len(names) > 1 and all(map(COMPONENT.fullmatch, names)):
        several = len(names)
    if several > 1 and total not in look.counts:
        raise look.error(
            f"the heading says {several} channels, but there is one number a line: state their "
            f"number of samples in a line above, as NPTS= {total // several}"
        )
    if total > 5 and _evenly(look.x):
        raise look.error("the numbers rise evenly, as times do and no acceleration does")
    label = labels_of(look.block, 1)[0]
    label = "" if len(label.split()) > 3 or re.search(r"[:=\d]", label) else label
    return Layout(
        "single-column", look.block, [(label, look.x, look.lines[0])], declared=look.declared
    )
