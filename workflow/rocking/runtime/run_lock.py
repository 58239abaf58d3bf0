"""One run at a time under a name; runs of other names go side by side.

Snakemake's own lock is a file for the whole folder that a killed run leaves behind, so that the
same command is refused until somebody unlocks by hand. The locks here belong to the process: the
system drops them when the process ends, however it ends. Beside that of every run there is one for
each folder of motions that runs share: who makes files there has it alone, who reads them with
other readers.
"""

import errno
import fcntl
import os
import socket
import stat
import sys
import threading
import time
from pathlib import Path

FOLDER = Path(".snakemake") / "rocking"
LOOK_S = 1.0
WITHOUT = (errno.ENOLCK, errno.ENOTSUP, errno.EOPNOTSUPP, errno.ENOSYS, errno.EINVAL)
NO_FILE = "expected a lock's file, not a link or another kind: remove it, then repeat the command"
NO_FOLDER = "expected the folder of locks, not a link or a file: remove it, then repeat the command"
_held: list = []  # open files


class Busy(RuntimeError):
    """Another run works under this name or on these motions; the text is one line."""


def _take(path, how):
    """Lock a file; return it, None where the file system has no locks.

    BlockingIOError with the text that the one who has it wrote; ValueError of one line where the
    path is no file of its own, or lies in no folder of its own: what a link leads to would be
    emptied.
    """
    _make_own_folder(path.parent)
    handle = _own_file(path)
    try:
        fcntl.flock(handle, how | fcntl.LOCK_NB)
    except BlockingIOError:
        handle.seek(0)
        owner = handle.read(200).strip() or "unknown"
        handle.close()
        raise BlockingIOError(owner) from None
    except OSError as error:
        handle.close()
        if error.errno not in WITHOUT:
            raise
        return None
    if how == fcntl.LOCK_EX:
        handle.seek(0)
        handle.truncate()
        handle.write(f"process {os.getpid()} on {socket.gethostname()}\n")
        handle.flush()
    return handle


def _make_own_folder(path):
    """Make the folder of locks; one that is a link or a file is refused.

    `.snakemake` above it may be a link, for Snakemake follows that too.
    """
    try:
        path.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError):
        wrong = next(
            place for place in (path.parent, path) if os.path.lexists(place) and not place.is_dir()
        )
        raise ValueError(f"{wrong}: {NO_FOLDER}") from None
    if path.is_symlink():
        raise ValueError(f"{path}: {NO_FOLDER}")


def _own_file(path):
    """Open a lock's file, which stays open: closing it would release the lock."""
    flags = os.O_RDWR | os.O_CREAT | os.O_APPEND | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC
    try:
        number = os.open(path, flags, 0o666)
    except OSError as error:
        if error.errno not in (errno.ELOOP, errno.EISDIR, errno.ENXIO):
            raise
        raise ValueError(f"{path}: {NO_FILE}") from None
    at = os.fstat(number)
    if not stat.S_ISREG(at.st_mode) or at.st_nlink > 1:
        os.close(number)
        raise ValueError(f"{path}: {NO_FILE}")
    return os.fdopen(number, "a+")


def hold(runs, reads=(), makes=(), folder="."):
    """Take the locks of runs and of motions until this process ends.

    `reads` and `makes` are the folders of `results/.shared` from which files are taken, and in
    which files are made; returned are the locks of these, for `share`. Busy, in one line that
    names the process that holds one; none is held then.
    """
    taken: list = []
    making: list = []
    wanted = [(f"run-{name}", fcntl.LOCK_EX) for name in sorted(runs)]
    wanted += [(f"motions-{name}", fcntl.LOCK_EX) for name in sorted(makes)]
    wanted += [(f"motions-{name}", fcntl.LOCK_SH) for name in sorted(set(reads) - set(makes))]
    for name, how in wanted:
        try:
            lock = _take(Path(folder) / FOLDER / f"{name}.lock", how)
        except BlockingIOError as error:
            for other in taken:
                other.close()
            raise Busy(_busy(name, how, error, Path(folder).resolve())) from None
        if lock is None:
            print(
                f"warning: the file system of {Path(folder).resolve()} has no locks: see to it that"
                " no second run of the same name or of the same new records is started",
                file=sys.stderr,
            )
            break
        taken.append(lock)
        if name.startswith("motions-") and how == fcntl.LOCK_EX:
            making.append(lock)
    _held.extend(taken)
    return making


def _busy(name, how, owner, folder):
    kind, _, which = name.partition("-")
    if kind == "run":
        return (
            f"another run works in {folder} under the name {which} ({owner}): wait until it ends,"
            " or give this one another name (--config run=…)"
        )
    reads = how == fcntl.LOCK_EX
    doing = "works on the motions that this one would make" if reads else "makes motions"
    return (
        f"another run {doing} in results/.shared/{which} ({owner}): repeat the command when its"
        " motions are made, or give this one a folder of its own with --directory"
    )


def share(locks, made, look_s=LOOK_S):
    """Let other runs read motions as soon as all are `made`; a thread looks now and then.

    `locks` are what `hold` returned.
    """

    def loop():
        while not made():
            time.sleep(look_s)
        for lock in locks:
            fcntl.flock(lock, fcntl.LOCK_SH)

    if locks:
        threading.Thread(target=loop, name="locks", daemon=True).start()
