"""Says that loops are compiled before the first history, which looks as if nothing went on."""

import sys
from functools import cache
from pathlib import Path

MINUTES = "one or two minutes on a free core, a quarter of an hour on a loaded machine"


@cache
def say_first_compilation() -> bool:
    """Say it on the error stream, once, where no loop is kept; tell whether."""
    from rocking.solver import block  # slow to load, and loaded by whoever runs a history

    folder = getattr(block.march_block._cache, "cache_path", None)
    kept = ("block.march_block*.nbi", "stack_kernel.march_stack*.nbi")
    if folder and any(True for name in kept for _ in Path(folder).glob(name)):
        return False
    print(f"compiling the solver, once: {MINUTES}", file=sys.stderr, flush=True)
    return True
