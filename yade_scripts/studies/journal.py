"""Finished runs of a job, kept line by line so that none is ever computed twice.

A journal is a JSON-lines file beside the results. Each line carries a key that
hashes everything the run depended on, so a changed parameter, record or module
never finds a stale row, and a job killed half way keeps what it had.
"""

import glob
import hashlib
import json
import os
from pathlib import Path

# what a run's numbers depend on; a change in any of these files makes old rows stale
PHYSICS = (
    "quadrature",
    "scene",
    "stiffness",
    "facade",
    "interlocking",
    "models",
    "faces",
    "bonds",
    "motion",
    "engine",
    "simulate",
    "ledger",
    "run_ida",
)


def source_digest(modules=PHYSICS):
    """Hash of the modules that decide a run's numbers, hex."""
    folder = Path(__file__).parent
    digest = hashlib.sha256()
    for name in modules:
        digest.update((folder / f"{name}.py").read_bytes())
    return digest.hexdigest()


def run_key(*parts):
    """Hash of strings, bytes and JSON-able values, hex."""
    digest = hashlib.sha256()
    for part in parts:
        if isinstance(part, bytes):
            data = part
        else:
            data = json.dumps(part, sort_keys=True).encode()
        digest.update(len(data).to_bytes(8, "little") + data)
    return digest.hexdigest()[:32]


class Journal:
    """Rows by key, appended durably."""

    def __init__(self, path):
        """Read the complete lines of `path`; a torn last line is dropped."""
        self.path = Path(path)
        self.rows = {}
        if self.path.exists():
            good = b""
            for line in self.path.read_bytes().splitlines(keepends=True):
                try:
                    entry = json.loads(line)
                    key, row = entry["key"], entry["row"]
                except (ValueError, KeyError, TypeError):
                    break  # torn by a kill: everything after it is suspect
                if not line.endswith(b"\n"):
                    break
                self.rows[key] = row
                good += line
            if good != self.path.read_bytes():
                write_atomic(self.path, good)

    def get(self, key):
        """Return the row stored under `key`, or None."""
        return self.rows.get(key)

    def put(self, key, row, reason=""):
        """Store a row and why its run ended, and force them to disk before returning.

        Raises
        ------
        OSError
            Naming the file, if the line could not be written whole.
        """
        self.rows[key] = row
        line = json.dumps({"key": key, "reason": reason, "row": row}, sort_keys=True) + "\n"
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            with open(self.path, "ab") as handle:
                handle.write(line.encode())
                handle.flush()
                os.fsync(handle.fileno())
        except OSError as error:
            raise named(error, self.path) from None


def named(error, path):
    """Return an OSError with the file it concerns, which errors of writing lack."""
    return OSError(error.errno, error.strerror, str(path))


def write_atomic(path, data):
    """Write bytes or text under a temporary name and move it to `path` when complete.

    One run at a time works in a folder, so temporary files found for the same `path`
    are those of killed jobs; they go.
    """
    path = Path(path)
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        for stale in path.parent.glob(f".{glob.escape(path.name)}.*.part"):
            stale.unlink(missing_ok=True)
        with open(temporary, "wb") as handle:
            handle.write(data if isinstance(data, bytes) else data.encode())
            handle.flush()
            os.fsync(handle.fileno())
        os.replace(temporary, path)
    except OSError as error:
        raise named(error, path) from None
    finally:
        if temporary.exists():
            temporary.unlink()
