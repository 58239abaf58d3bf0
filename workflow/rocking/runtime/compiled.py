"""Compilation by numba, for both planar solvers; they share nothing else."""

import hashlib
from pathlib import Path
from typing import Any

from numba import njit

OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy"}  # without the interpreter's lock
UNCOUNTED: dict[str, Any] = {"_nrt": False}  # without numba's counts of who refers to an array


def compiled(function):
    """Compile; cached on disk where some folder can be written.

    numba's cache looks at the file of a function alone, and would keep what it calls from the
    files beside it as these were; here a change of any of them makes it anew.
    """
    try:
        made: Any = njit(cache=True, **OPTIONS)(function)
    except RuntimeError:  # numba found no folder for its cache
        return njit(**OPTIONS)(function)
    beside = sorted(Path(function.__code__.co_filename).parent.glob("*.py"))
    digest = hashlib.sha256(b"".join(path.read_bytes() for path in beside)).hexdigest()
    index = made._cache._cache_file
    index._source_stamp = (index._source_stamp, digest)
    return made


def inlined(function):
    """Compile into whatever calls it, so that cutting a loop into named steps costs nothing.

    It does not count who refers to an array, which in a loop may take longer than all the rest: so
    it may neither make nor return any.
    """
    return njit(forceinline=True, **OPTIONS, **UNCOUNTED)(function)


def taking_functions(function):
    """Compile into whatever calls it what has compiled functions among its arguments.

    Apart, it would hold the address of each, and with that could be kept in no cache.
    """
    return njit(inline="always", **OPTIONS)(function)
