"""What files were when they were written down: a digest of them, and the commit they are from."""

import hashlib
import subprocess
from pathlib import Path


def digest(*paths):
    """SHA-256 over some files, one after the other."""
    return hashlib.sha256(b"".join(Path(path).read_bytes() for path in paths)).hexdigest()


def commit_of(*paths):
    """Last commit that changed some files of a folder, or "none" where git knows none."""
    command = ["git", "log", "-1", "--format=%H", "--", *(Path(path).name for path in paths)]
    where = Path(paths[0]).resolve().parent
    done = subprocess.run(command, cwd=where, capture_output=True, text=True, timeout=30)
    return done.stdout.strip() or "none"
