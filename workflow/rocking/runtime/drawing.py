"""What draws, marked: it is no part of what a study computes.

The stamp on which computing depends leaves marked functions out (`yade_scripts.sources`), so that
another colour computes nothing anew. For that nothing that computes may call one: it would not be
computed again when the function changes. So such a call is refused when it happens.
"""

import contextlib
import functools
import os

COMPUTES = "ROCKING_COMPUTES"  # in the environment: what a job starts inherits it


@contextlib.contextmanager
def refused():
    """Refuse all that is marked, here and in what is started from here."""
    before = os.environ.get(COMPUTES)
    os.environ[COMPUTES] = "1"
    try:
        yield
    finally:
        if before is None:
            del os.environ[COMPUTES]
        else:
            os.environ[COMPUTES] = before


def drawing(function):
    """Mark a function that draws, and that imports what it draws with itself.

    RuntimeError when it is called by a job that computes.
    """

    @functools.wraps(function)
    def drawn(*args, **kwargs):
        if os.environ.get(COMPUTES):
            raise RuntimeError(
                f"{function.__module__}.{function.__qualname__} is marked @drawing, and called by"
                " what computes: a change of it would compute nothing anew; take the mark away"
            )
        return function(*args, **kwargs)

    del drawn.__wrapped__  # type: ignore[attr-defined]  # no way round
    return drawn
