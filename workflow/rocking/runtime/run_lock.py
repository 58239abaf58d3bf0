"""One run at a time in a working folder.

Snakemake's own lock is a file that a killed run leaves behind, so that the same command
is refused until somebody unlocks by hand. The lock here belongs to the process: the system
drops it when the process ends, however it ends.
"""

import fcntl
import os
import socket
from pathlib import Path

LOCK_FILE = Path(".snakemake") / "rocking.lock"
_held: list = []  # open files


class Busy(RuntimeError):
    """Another run works in this folder; the text is one line."""


def hold(folder="."):
    """Take the lock of a working folder until this process ends.

    Raises
    ------
    Busy
        In one line, naming the process that holds it.
    """
    path = Path(folder) / LOCK_FILE
    path.parent.mkdir(parents=True, exist_ok=True)
    handle = open(path, "a+")  # noqa: SIM115  kept open: closing it would release the lock
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        handle.seek(0)
        owner = handle.read(200).strip() or "unknown"
        handle.close()
        raise Busy(
            f"another run works in {Path(folder).resolve()} ({owner}): wait until it ends, "
            "or give this one a folder of its own with --directory"
        ) from None
    handle.seek(0)
    handle.truncate()
    handle.write(f"process {os.getpid()} on {socket.gethostname()}\n")
    handle.flush()
    _held.append(handle)
