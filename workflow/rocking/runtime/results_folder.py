"""Whether results can be written, asked before anything is planned."""

import os
import shutil
from pathlib import Path

LEAST_B = 200_000  # Snakemake's own notes of a small run; less stops it in the middle of one


def misplaced(outputs):
    """Say in one line which output of a job cannot be written in its place; empty where all can.

    `outputs` are pairs of a path and whether it is to be a folder.
    """
    seen: set = set()
    for path, folder in outputs:
        for above in Path(path).parents:
            if above in seen:
                break
            seen.add(above)
            if os.path.lexists(above) and not above.is_dir():
                return f"{above} is no folder: {path} is to lie in it; move it away"
        if not folder and Path(path).is_dir():
            return f"{path} is a folder: a result's file is to lie there; move it away"
    return ""


def unreachable(folder):
    """Say in a few words why a folder can be neither entered nor made; empty where it can."""
    path = Path(folder).absolute()
    try:
        os.lstat(path)
    except (FileNotFoundError, NotADirectoryError, PermissionError):
        pass  # what is above it tells
    except OSError as error:  # such as a name that is too long
        return str(error.strerror)
    there = next(p for p in (path, *path.parents) if os.path.lexists(p))
    if not there.is_dir():
        return f"{there} is no folder"
    if not os.access(there, os.X_OK if there == path else os.W_OK | os.X_OK):
        return f"no right to {'enter' if there == path else 'make a folder in'} {there}"
    return ""


def fault(folder="results"):
    """Say in one line why a folder cannot take results; empty where it can.

    Of one that does not exist the nearest existing parent counts.
    """
    path = Path(folder).absolute()
    there = next(p for p in (path, *path.parents) if os.path.lexists(p))
    if not there.is_dir():
        return f"{there} is no folder: a run writes into {folder}/; move it away"
    if not os.access(there, os.W_OK | os.X_OK):
        return f"no right to write in {there}: give this run a folder of yours with --directory"
    if (free := shutil.disk_usage(there).free) < LEAST_B:
        left = f"{free // 1000} kB left"
        return f"the disk of {there} is full ({left}): make room, then repeat the command"
    return ""
