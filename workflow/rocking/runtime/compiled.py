"""Compilation by numba, for both planar solvers; they share nothing else."""

from numba import njit


def compiled(function):
    """Compile without the interpreter's lock; cached on disk where some folder can be written."""
    try:
        return njit(nogil=True, cache=True)(function)
    except RuntimeError:  # numba found no folder for its cache
        return njit(nogil=True)(function)
