"""Names in a message: the first of many, and the nearest to one that is not there."""

import difflib

MOST = 8  # names in one line
TRIED = 20_000  # more take seconds to compare
LONGEST = 60  # characters of a name that is compared or shown


def listed(names, most=MOST):
    """Names apart by commas; of many the first, and how many more: "a, b and 3 more"."""
    names = [str(name) for name in names]
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(map(_short, names[:most])) + more


def one_of(names, name=None, most=MOST):
    """Names that are known, for the message on one that is not.

    Of few names all, "expected one of a, b"; of many the nearest, "did you mean 'a'?".
    """
    names = [str(word) for word in names]
    near = None
    if name is not None and len(names) > most and len(str(name)) <= LONGEST:
        close = difflib.get_close_matches(str(name), names[:TRIED], 1, 0.7)
        near = next(iter(close), None)
    return f"did you mean '{near}'?" if near else f"expected one of {listed(names, most)}"


def _short(name):
    return name if len(name) <= LONGEST else name[: LONGEST - 1] + "…"
