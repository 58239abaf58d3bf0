"""A first line of numbers that declares how many follow, with their step or without."""

import re

import numpy as np

from .text import MAX_DT_S, MIN_DT_S

MOST = 12  # channels one after another


def declaration(look):
    """Take a count, with a step or without, off the first lines of numbers."""
    for top in (1, 2):
        taken = [cell for row in look.rows[:top] for cell in row]
        if len(look.rows) < top + 2 or len(taken) > 4:
            break
        counts = [int(cell) for cell in taken if re.fullmatch(r"\d{2,9}", cell)]
        rest = look.rows[top:]
        total, many = sum(map(len, rest)), len(rest)
        fits = [c for c in counts if c in (many, total) or (total == 2 * c and c >= 10)]
        fits += [c for c in counts if c >= 10 and c not in fits and divides(total, c)]
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


def divides(total, count):
    """Tell whether a count makes some equal blocks of a total."""
    return total % count == 0 and 2 <= total // count <= MOST
