"""Reading and writing files: JSON, and whole or not at all."""

import glob
import json
import os
import re
from pathlib import Path

from yade_scripts.lists import listed

OF_A_CASE = ("model", "facade", "numerics")  # what no case file is without
SIZES = ("height_m", "thickness_m", "width_m", "density_kg_m3", "e_mpa")
NUMBER = re.compile(r".*_(m|s|g|kg|kg_m3|mpa|pa_m|deg|hz|kn|mm|ratio)")  # keys that name a unit


def read_json(path, *keys):
    """Content of a JSON file; with `keys`, of an object that has them.

    OSError or ValueError of one line that names the file, and the key that is missing.
    """
    if os.path.exists(path) and not os.path.isfile(path) and not os.path.isdir(path):
        raise ValueError(f"{path}: neither a file nor a link to one")  # a pipe would be waited for
    try:
        content = json.loads(Path(path).read_text("utf-8"))
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{path}: not JSON ({error})") from None
    if keys and not isinstance(content, dict):
        raise ValueError(f"{path}: expected an object with {listed(keys)}")
    if missing := [key for key in keys if key not in content]:
        raise ValueError(f"{path}: no {listed(missing)}; expected {listed(keys)}")
    return content


def read_case(path):
    """Content of a case file, as `results/<run>/cases` has them; a scene that is ready has no more.

    ValueError of one line that names the file and the key, for a section that is missing, a size
    that is no number and text under a key that names a unit.
    """
    case = read_json(path, "model")
    if "scene" in case:
        return case
    read_json(path, *OF_A_CASE)
    _check_numbers(path, case, "")
    for key in SIZES:
        value = case["facade"].get(key, 1.0)
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not value > 0.0:
            raise ValueError(f"{path}: facade.{key} = {value!r}: expected a number > 0")
    return case


def _check_numbers(path, value, where):
    """Refuse text where a unit says that there is a number."""
    if isinstance(value, dict):
        for key, part in value.items():
            _check_numbers(path, part, f"{where}.{key}".lstrip("."))
    elif isinstance(value, str) and NUMBER.fullmatch(where.rpartition(".")[2]):
        raise ValueError(f"{path}: {where} = {value!r}: expected a number")
    elif where in ("facade", "numerics"):
        raise ValueError(f"{path}: {where} = {value!r}: expected a section of keys and values")


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
