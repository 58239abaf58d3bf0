"""Compilation by numba, for both planar solvers; they share nothing else."""

import contextlib
import fcntl
import hashlib
import os
import stat
import sys
import time
from functools import cache as cache_once
from pathlib import Path
from typing import Any

from numba import njit
from numba.core.caching import IndexDataCacheFile
from numba.extending import register_jitable

OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy"}  # without the interpreter's lock
OTHERS = stat.S_IWGRP | stat.S_IWOTH  # may write
UNCOUNTED: dict[str, Any] = {"_nrt": False}  # without numba's counts of who refers to an array
OTHER_S = 600.0  # at most, until another process has compiled the same
WITHIN: Any = {"forceinline": True, "no_cfunc_wrapper": True, **OPTIONS, **UNCOUNTED}


def is_own(path, source):
    """Whether nobody but this user, root and who can write the source may write a file or folder.

    What lies in a cache is run. One that is this user's and that others may write too is closed to
    them where that can be done, unless the source beside it is as open.
    """
    try:
        at, code = os.stat(path), os.stat(Path(source).parent)
    except OSError:
        return False
    mine = at.st_uid == os.geteuid()
    if not mine and at.st_uid not in (0, code.st_uid):
        return False
    allowed = code.st_mode & (OTHERS if at.st_gid == code.st_gid else stat.S_IWOTH)
    if not (open_to := at.st_mode & OTHERS & ~allowed):
        return True
    return False if not mine or not os.path.isdir(path) else _closed(path, at.st_mode & ~open_to)


def _closed(path, mode):
    """Close a folder to others; whether that could be done."""
    try:
        os.chmod(path, stat.S_IMODE(mode))
    except OSError:
        return False
    return True


class KeptLoops(IndexDataCacheFile):
    """Machine code on disk and its index by types; the code is written before the index.

    numba writes the index first. After a change of the source that index names files of the old
    source. A process that reads at that moment, or after the writer was killed, runs the old
    machine code, or crashes in it where types have changed. Here a file's name is the digest of its
    content, and the index names files that exist alone.

    Machine code is run, so a file that others may have written counts as missing.

    One process at a time compiles what is missing; those that waited for it read what it kept.
    """

    source = ""  # of the function

    def __init__(self, *given):
        """As numba's."""
        super().__init__(*given)
        self._turns: dict[str, int] = {}  # locks of what this process compiles, by their files

    def load(self, key):
        """Read machine code; none where it is this process's turn to compile it."""
        code = super().load(key)
        if code is None and (lock := self._lock(key)) not in self._turns:
            self._wait(lock)
            code = super().load(key)
            if code is not None:
                self._done(lock)
        return code

    def save(self, key, data):
        """Keep what was compiled; one process at a time where the file system has locks."""
        with self._alone():
            content = hashlib.sha256(self._dump(data)).hexdigest()
            name = self._data_name(int(content[:16], 16))
            self._save_data(name, data)
            overloads = {**self._load_index(), key: name}
            self._save_index(overloads)
            self._clear({*overloads.values()})
        self._done(self._lock(key))

    def _lock(self, key):
        name = hashlib.sha256(repr(key).encode()).hexdigest()[:16]
        return f"{self._index_path}.{name}.lock"

    def _wait(self, lock):
        """Take the turn to compile, where the folder can be written and has locks."""
        with contextlib.suppress(OSError):
            how = os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW
            held, end = os.open(lock, how, 0o600), time.monotonic() + OTHER_S
            try:
                while time.monotonic() < end:
                    try:
                        fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    except BlockingIOError:
                        time.sleep(0.1)
                    else:
                        self._turns[lock] = held
                        return
            finally:
                if lock not in self._turns:
                    os.close(held)

    def _done(self, lock):
        if (held := self._turns.pop(lock, None)) is not None:
            with contextlib.suppress(OSError):
                os.unlink(lock)
            os.close(held)

    def _load_index(self):
        """Read what is of this source; an index that names modules that are gone is of another."""
        if os.path.exists(self._index_path) and not is_own(self._index_path, self.source):
            return {}
        try:
            return super()._load_index()
        except (ImportError, AttributeError):
            return {}

    def _load_data(self, name):
        """Read machine code; numba takes an OSError for none."""
        if not is_own(path := self._data_path(name), self.source):
            raise PermissionError(f"{path}: others may have written it")
        return super()._load_data(name)

    @contextlib.contextmanager
    def _open_for_write(self, filepath):
        """Write a file that others cannot, whatever is usual here."""
        with super()._open_for_write(filepath) as handle:
            os.fchmod(handle.fileno(), 0o644)
            yield handle

    @contextlib.contextmanager
    def _alone(self):
        folder = os.open(self._cache_path, os.O_RDONLY)
        try:
            with contextlib.suppress(OSError):
                fcntl.flock(folder, fcntl.LOCK_EX)
            yield
        finally:
            os.close(folder)

    def _clear(self, named):
        """Remove what the index does not name: of the source before, or of other names."""
        pattern = self._data_name_pattern.replace("{number:d}", "*")
        for path in Path(self._cache_path).glob(pattern):
            if path.name not in named:
                path.unlink(missing_ok=True)


def compiled(function, **more):
    """Compile, with `more` of numba's options; cached on disk where some folder can be written.

    numba's cache looks at the file of a function alone, and would keep what it calls from the
    files beside it as these were; here a change of any of them makes it anew.
    """
    try:
        made: Any = njit(cache=True, **OPTIONS, **more)(function)
    except RuntimeError:  # numba found no folder for its cache
        return njit(**OPTIONS, **more)(function)
    if not is_own(made._cache.cache_path, function.__code__.co_filename):
        _said_foreign(made._cache.cache_path)
        return njit(**OPTIONS, **more)(function)
    beside = sorted(Path(function.__code__.co_filename).parent.glob("*.py"))
    digest = hashlib.sha256(b"".join(path.read_bytes() for path in beside)).hexdigest()
    cache = made._cache
    stamp = (cache._cache_file._source_stamp, digest)
    cache._cache_file = KeptLoops(cache.cache_path, cache._impl.filename_base, stamp)
    cache._cache_file.source = function.__code__.co_filename
    return made


@cache_once
def _said_foreign(path):
    """Say once a folder why its machine code is not used."""
    print(
        f"warning: {path}: others may write there, so its machine code is not run and every start"
        " compiles: NUMBA_CACHE_DIR on a folder of your own",
        file=sys.stderr,
    )


def looped(function):
    """Compile a loop, as `compiled`, that neither makes nor returns an array; see `inlined`."""
    return compiled(function, **UNCOUNTED)


def inlined(function, **more):
    """Compile into whatever calls it, so that cutting a loop into named steps costs nothing.

    `more` are numba's options. It does not count who refers to an array, which in a loop may take
    longer than all the rest: so it may neither make nor return any. Called from Python it runs as
    Python.
    """
    return register_jitable(**WITHIN, **more)(function)
