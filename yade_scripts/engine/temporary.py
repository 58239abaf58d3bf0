"""The empty folder that YADE makes for every process, `/tmp/yade-XXXXXX`, and leaves behind.

Its name and place are fixed in YADE's library, and only YADE's own program takes it away. Nothing
here writes into it, so it goes as soon as YADE is loaded. One that a killed process left goes with
the next that loads YADE, if no process that could have made it is alive.
"""

import contextlib
import os
import re
from pathlib import Path

PLACE = Path("/tmp")
LIBRARY = b"libyade"


def _began_s(pid):
    """When a process began [s since the epoch]."""
    ticks = int(
        Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()[19]
    )
    booted = re.search(r"(?m)^btime (\d+)", Path("/proc/stat").read_text(encoding="utf-8"))
    return int(booted[1] if booted else 0) + ticks / os.sysconf("SC_CLK_TCK")


def _makers(but):
    """When other processes of this user that have YADE began, or that may have it."""
    times_s = []
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit() or int(entry.name) == but:
            continue
        with contextlib.suppress(ProcessLookupError, FileNotFoundError):
            if entry.stat().st_uid != os.getuid():
                continue
            try:
                has = LIBRARY in (entry / "maps").read_bytes()
            except PermissionError:  # as of a container's first process
                has = (entry / "comm").read_text().startswith(("python", "yade"))
            if has:
                times_s.append(_began_s(entry.name))
    return times_s


def clear(folder, place=PLACE):
    """Take away this process's folder, and empty ones of which no living process can be the maker.

    Its own, `folder`, is left if something is in it; `place` is where such folders lie.
    """
    with contextlib.suppress(OSError):
        os.rmdir(folder)
    with contextlib.suppress(OSError):
        left = [path for path in place.glob("yade-??????") if path.lstat().st_uid == os.getuid()]
        if not left:
            return
        began = min(_makers(os.getpid()), default=float("inf"))
        for path in left:
            if path.is_dir() and not path.is_symlink() and path.stat().st_mtime < began - 1.0:
                with contextlib.suppress(OSError):  # something is in it, or another was quicker
                    os.rmdir(path)
