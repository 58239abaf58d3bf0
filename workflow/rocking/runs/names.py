"""Names of many runs as one short pattern."""

import re
from collections import defaultdict


def any_of(names):
    """Return the pattern that matches these names and no others, much shorter than `a|b|…`.

    Snakemake writes it into the path of every file and reads that anew for every job: with 500
    names in a row, that was most of what planning took. Names that begin alike are written once,
    and so is what several ends have in common.

    Examples
    --------
    >>> any_of(["tall", "tall-1", "tall-2"])
    'tall(?:\\\\-[12])?'
    """
    tree: dict = {}
    for name in names:
        at = tree
        for letter in name:
            at = at.setdefault(letter, {})
        at[""] = {}
    return _pattern(tree)


def _pattern(tree):
    """Pattern of what may follow in a tree of letters, in which "" is an end."""
    letters = defaultdict(list)
    for letter, below in tree.items():
        if letter:
            letters[_pattern(below)].append(re.escape(letter))
    ways = [
        (heads[0] if len(heads) == 1 else f"[{''.join(heads)}]") + rest
        for rest, heads in letters.items()
    ]
    if not ways:
        return ""
    if "" in tree:
        return f"(?:{'|'.join(ways)})?"
    return ways[0] if len(ways) == 1 else f"(?:{'|'.join(ways)})"
