"""Keys that act only beside another one, and were stated without it.

A schema says so of a key as `acts_with`: what other keys must be, each as a schema of its value. Of
a list of such, one must hold. In an entry of a list keys without a section are the entry's own.
"""

import copy
import functools
from collections.abc import Iterator, Mapping
from typing import Any

import jsonschema

from rocking.configuration.config import resolve
from rocking.configuration.differences import flat
from rocking.configuration.layers import nested
from rocking.configuration.schema import (
    ConfigError,
    expectation,
    leaves,
    show,
    value_at,
    whole,
)

Needs = dict[str, dict[str, Any]]


class NoEffectWarning(UserWarning):
    """A key was stated without the one it acts with."""


def without_effect(resolved: Mapping, stated: Mapping) -> Iterator[str]:
    """Say which stated keys do nothing in a run, one line each: the key, and what it acts with.

    Parameters
    ----------
    resolved : mapping
        Complete.
    stated : mapping
        What the user's configuration says, by section or dotted key. A key that it leaves open, or
        that would be the same if it did, is not named.
    """
    given = nested(stated)
    named = set(flat(given))
    for path, schema, entries in _conditional():
        if path not in named or (value := value_at(resolved, path)) == schema.get("default"):
            continue
        said = list(_said(path, value, schema, resolved, {}))
        yield from said if said and value != _left_open(path, given) else ()
        rows = value if entries and isinstance(value, list) else ()
        for number, entry in enumerate(rows, 1):
            for key, part in entries:
                if entry.get(key) not in (None, part.get("default")):
                    yield from _said(f"{path}[{number}].{key}", entry[key], part, resolved, entry)


@functools.lru_cache(maxsize=1)
def _conditional() -> list[tuple[str, dict, list]]:
    """Keys that act beside others, with those of the entries of a list: path, schema, entries."""
    conditional = []
    for path, schema in leaves(whole()):
        entries = [(key, part) for key, part in leaves(schema.get("items", {})) if needs(part)]
        if needs(schema) or entries:
            conditional.append((path, schema, entries))
    return conditional


def needs(schema: Mapping) -> list[Needs]:
    """Return the sets of conditions under which a key acts; any one set is enough."""
    given = schema.get("acts_with", [])
    return given if isinstance(given, list) else [given]


def _left_open(path: str, given: Mapping) -> Any:
    """Value of a key in a configuration without it; some defaults hang on other keys."""
    rest = copy.deepcopy(dict(given))
    *sections, key = path.split(".")
    inner = rest
    for name in sections:
        inner = inner[name]
    del inner[key]
    try:
        return value_at(resolve(rest), path)
    except ConfigError:  # what is stated is needed
        return ...


def _said(
    path: str, value: Any, schema: Mapping, resolved: Mapping, entry: Mapping
) -> Iterator[str]:
    """One line where none of a key's conditions holds."""
    sets = needs(schema)
    if sets and not any(met(conditions, resolved, entry) for conditions in sets):
        words = " or ".join(_words(conditions, resolved, entry) for conditions in sets)
        yield f"{path} = {show(value)} has no effect without {words}"


def met(conditions: Needs, resolved: Mapping, entry: Mapping | None = None) -> bool:
    """Whether all of a set of conditions hold in a run; of an entry of a list, its own keys too."""
    return all(_holds(pair) for pair in _found(conditions, resolved, entry or {}))


def _found(conditions: Needs, resolved: Mapping, entry: Mapping) -> Iterator[tuple[Any, dict]]:
    """Value of every key of a set of conditions, and what it must be."""
    for key, wanted in conditions.items():
        yield entry[key] if key in entry else value_at(resolved, key), wanted


def _holds(pair: tuple[Any, dict]) -> bool:
    value, wanted = pair
    return jsonschema.Draft202012Validator(wanted).is_valid(value)


def _words(conditions: Needs, resolved: Mapping, entry: Mapping) -> str:
    """Word the conditions that do not hold: "smdof.loops = flag (found bilinear)"."""
    said = []
    for (key, wanted), pair in zip(
        conditions.items(), _found(conditions, resolved, entry), strict=True
    ):
        if not _holds(pair):
            said.append(f"{key} = {_expected(wanted)} (found {show(pair[0])})")
    return " and ".join(said)


def _expected(wanted: Mapping) -> str:
    if "contains" in wanted:
        return f"a list with {expectation(wanted['contains'])}"
    if "minItems" in wanted:
        return "a list that is not empty"
    return expectation(dict(wanted))
