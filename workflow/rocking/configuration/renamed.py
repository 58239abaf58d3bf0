"""Keys and values of a configuration under former names, which are accepted for one version.

A schema says what it was called: `formerly`, the dotted path of a section or key, and
`former_values`, the values of a key that have another name now.
"""

from collections.abc import Mapping
from functools import cache
from typing import Any

from rocking.configuration import schema as config_schema
from rocking.configuration.schema import ConfigError


@cache
def _names() -> dict[str, str]:
    """Present path of every section and key that had another one."""
    sections = config_schema.sections()
    keys = config_schema.leaves(config_schema.whole())
    found = [*((name, schema) for name, schema in sections.items()), *keys]
    return {schema["formerly"]: path for path, schema in found if "formerly" in schema}


@cache
def _values() -> dict[str, dict[str, str]]:
    """Values of keys that had another name, by the present path of the key."""
    keys = config_schema.leaves(config_schema.whole())
    return {path: schema["former_values"] for path, schema in keys if "former_values" in schema}


def _now(path: str) -> str:
    """Present path of a dotted one."""
    for old, new in _names().items():
        if path == old or path.startswith(f"{old}."):
            path = new + path[len(old) :]
    return path


def _value(given: Any, known: dict[str, str]) -> Any:
    """Return a value, or the values of a list, under present names."""
    if isinstance(given, list):
        return [_value(one, known) for one in given]
    return known.get(given, given) if isinstance(given, str) else given


def current(given: Any, said: list | None = None, path: str = "") -> Any:
    """Return a configuration, or a part of it, under present names.

    `said` takes a line for every former name; `path` is the dotted path of `given` with a dot at
    its end. A key that is given under both names is refused.
    """
    if not isinstance(given, Mapping):
        new = _value(given, _values().get(path[:-1], {}))
        if new != given and said is not None:
            said.append(f"{path[:-1]} = {given} is now called {new}; the old name goes")
        return new
    out: dict[str, Any] = {}
    for key, value in given.items():
        new = _now(f"{path}{key}")[len(path) :] if isinstance(key, str) else key
        if new != key and said is not None:
            said.append(f"{path}{key} is now called {path}{new}; the old name goes")
        if new in out or (new != key and new in given):
            raise ConfigError(f"{path}{key} is now called {path}{new}: given under both names")
        inner = f"{path}{new}." if isinstance(key, str) else path
        out[new] = current(value, said, inner)
    return out


def lines(config: Mapping) -> list[str]:
    """Lines for the former names in a configuration with its scenarios and grid, each once."""
    said: list[str] = []
    rest = {key: value for key, value in config.items() if key not in config_schema.STUDY_KEYS}
    scenarios = config.get("scenarios") or {}
    parts = scenarios.values() if isinstance(scenarios, Mapping) else ()
    for part in (rest, config.get("grid"), *parts):
        current(part, said)
    return list(dict.fromkeys(said))
