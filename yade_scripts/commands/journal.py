"""Finished runs of a job, kept line by line so that none is ever computed twice.

A journal is a JSON-lines file beside the results. Each line carries a key that
hashes everything the run depended on, so a changed parameter, record or module
never finds a stale row, and a job killed half way keeps what it had. It ends in a digest of itself:
a line that was cut or changed counts as not there, and its run is computed again.
"""

import contextlib
import hashlib
import json
import os
from pathlib import Path

from yade_scripts.files import named, write_atomic

SUM_DIGITS = 16
NO_FILE = (
    "expected a journal's file, not a folder or another kind: remove it, then repeat the command"
)


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


def _line(entry):
    """An entry as a line that has its digest too; floats survive, as JSON has all their digits."""
    return json.dumps({**entry, "sum": run_key(entry)[:SUM_DIGITS]}, sort_keys=True)


def _entry(line):
    """The entry of a line; ValueError where it is not as it was written."""
    try:
        entry = json.loads(line)
        written = entry.pop("sum")
        if written == run_key(entry)[:SUM_DIGITS]:
            return entry["key"], entry["row"]
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        pass
    raise ValueError("no line of a journal")


class Journal:
    """Rows by key, appended durably."""

    def __init__(self, path):
        """Read the lines of `path` that are whole; the others are dropped, from the file too.

        ValueError of one line where the path, or what should be its folder, is of another kind.
        """
        self.path = Path(path)
        self.rows = {}
        for above in self.path.parents:
            if os.path.lexists(above) and not above.is_dir():
                raise ValueError(f"{above}: expected a folder of journals: remove it, then repeat")
        if os.path.lexists(self.path) and not self.path.is_file():
            raise ValueError(f"{self.path}: {NO_FILE}")
        if self.path.exists():
            good, data = b"", self.path.read_bytes()
            for line in data.splitlines(keepends=True):
                with contextlib.suppress(ValueError):
                    key, row = _entry(line)
                    self.rows[key] = row
                    good += line if line.endswith(b"\n") else line + b"\n"
            if good != data:
                write_atomic(self.path, good)

    def get(self, key):
        """Return the row stored under `key`, or None."""
        return self.rows.get(key)

    def put(self, key, row, reason=""):
        """Store a row and why its run ended, and force them to disk before returning.

        OSError that names the file, if the line could not be written whole.
        """
        self.rows[key] = row
        line = _line({"key": key, "reason": reason, "row": row}) + "\n"
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            with open(self.path, "ab") as handle:
                handle.write(line.encode())
                handle.flush()
                os.fsync(handle.fileno())
        except OSError as error:
            raise named(error, self.path) from None
