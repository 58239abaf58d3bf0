"""One change of an experiment: a name and what it changes, in the case and in the motion."""

import copy
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from numbers import Real
from typing import Any

from record_files.reader import nearest

from rocking.configuration import config as configuration
from rocking.configuration import refusals, schema
from yade_scripts.model import registry


@dataclass(frozen=True)
class Variant:
    """One change of an experiment, as plain data.

    Attributes
    ----------
    name : str
    changes : mapping of str to value
        New values of a case by dotted key, as "facade.friction_deg"; "model" changes the model.
    factors : mapping of str to float
        Factors on values of a case, by dotted key.
    added : mapping of str to sequence of dict
        Rows appended to a list of a case, by dotted key, as "facade.ties".
    motion : mapping of str to value
        See `motion.Motion.varied`: the share of the vertical motion, the source, a first shock.
    about : mapping of str to value
        What a table says of it, by column.
    """

    name: str = "as configured"
    changes: Mapping[str, Any] = field(default_factory=dict)
    factors: Mapping[str, float] = field(default_factory=dict)
    added: Mapping[str, Sequence[Mapping[str, Any]]] = field(default_factory=dict)
    motion: Mapping[str, Any] = field(default_factory=dict)
    about: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self):
        """Check that what it changes is stated by key."""
        for what in ("changes", "factors", "added", "motion", "about"):
            given = getattr(self, what)
            if not isinstance(given, Mapping):
                raise TypeError(
                    f"variant {self.name!r}: {what} = {given!r}: expected a mapping by key"
                )


def applied(variant, sections):
    """Return a case's sections with a variant's changes, and the names of those that it touches.

    ValueError in one line, as `Case.varied` says.
    """
    sections = copy.deepcopy(sections)
    for key, value in variant.changes.items():
        part, name = place(sections, key)
        part[name] = allowed(key, value)
        if key == "model" and registry.model(value).walls == "bricks" and "w3" not in sections:
            raise ValueError(f"model = {value}: expected a case that was configured with bricks")
    for key, factor in variant.factors.items():
        part, name = place(sections, key)
        if not _is_number(part[name]):
            raise ValueError(f"{key} = {schema.show(part[name])}: expected a number to multiply")
        if not _is_number(factor):
            raise ValueError(f"{key}: factor {factor!r}: expected a number")
        part[name] = allowed(key, part[name] * factor)
    for key, rows in variant.added.items():
        part, name = place(sections, key)
        if not isinstance(part[name], list) or not isinstance(rows, (list, tuple)):
            raise ValueError(f"{key}: expected rows added to a list, as [{{…}}]")
        part[name] = [*part[name], *allowed(key, [_completed(key, row) for row in rows])]
    changed = {key.split(".")[0] for key in (*variant.changes, *variant.factors, *variant.added)}
    return sections, changed


def place(sections, key):
    """Section of a dotted key, its name in it."""
    *path, name = str(key).split(".")
    part = sections
    for section in path:
        part = part.get(section) if isinstance(part, dict) else None
    if not isinstance(part, dict) or name not in part:
        near = nearest(name, part) if isinstance(part, dict) else ""
        raise ValueError(f"{key}: the case has no such key{near}")
    return part, name


def allowed(key, value):
    """Value of a dotted key, if the configuration allows it there; β has no key of its own."""
    if key == "model":
        return registry.model(value).name
    if key == "beta_s" and not (_is_number(value) and 0.0 <= value < math.inf):
        raise ValueError(f"beta_s = {value!r}: expected a number ≥ 0 (s)")
    if isinstance(value, Mapping):
        raise ValueError(f"{key}: expected single values by dotted key, as 'facade.height_m'")
    value = schema.plain(value, key)
    if key != "beta_s":
        refusals.refuse_invalid(configuration.nested({key: value}), schema.whole())
    return value


def _is_number(value):
    return isinstance(value, Real) and not isinstance(value, bool)


def _completed(key, row):
    """Row of a list with the defaults of its schema."""
    items = schema.whole()
    for name in key.split("."):
        items = items["properties"][name]
    return schema.complete(row, items["items"])
