"""A way back for what leans on the inside of Snakemake: another release may not have it.

Nothing of that changes a result; it saves time, or tells how far a run is.
"""

import contextlib
import inspect
import sys

from yade_scripts.lists import listed


@contextlib.contextmanager
def left_out_if_unknown(what):
    """Leave `what` out, with a line that says so, where this Snakemake is not as it is known."""
    try:
        yield
    except (ImportError, AttributeError, TypeError) as error:
        print(f"warning: without {what}: Snakemake differs here ({error})", file=sys.stderr)


def expect_parameters(function, *names):
    """Raise TypeError where a function of Snakemake takes other parameters than these."""
    if tuple(parameters := inspect.signature(function).parameters) != names:
        raise TypeError(f"{function.__qualname__} takes {listed(parameters)}")
