"""Finished runs of a job, kept line by line so that none is ever computed twice.

A journal is a JSON-lines file beside the results. Each line carries a key that
hashes everything the run depended on, so a changed parameter, record or module
never finds a stale row, and a job killed half way keeps what it had.
"""

import hashlib
import json
import os
from pathlib import Path

from yade_scripts.files import named, write_atomic


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

        OSError that names the file, if the line could not be written whole.
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
