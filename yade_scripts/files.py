"""Reading and writing files: JSON, and whole or not at all."""

import glob
import json
import os
from pathlib import Path


def read_json(path):
    """Content of a JSON file; OSError or ValueError of one line that names the file."""
    try:
        return json.loads(Path(path).read_text("utf-8"))
    except ValueError as error:
        raise ValueError(f"{path}: not JSON ({error})") from None


def named(error, path):
    """Return an OSError with the file it concerns, which errors of writing lack."""
    return OSError(error.errno, error.strerror, str(path))


def write_atomic(path, data):
    """Write bytes or text under a temporary name and move it to `path` when complete.

    One run at a time works in a folder, so temporary files found for the same `path` are those of
    killed jobs; they go.
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


def write_json(path, data, indent=1, sort_keys=False):
    """Write data as JSON that ends with a line feed; see `write_atomic`."""
    write_atomic(path, json.dumps(data, indent=indent, sort_keys=sort_keys) + "\n")
