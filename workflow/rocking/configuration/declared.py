"""What a schema of the configuration may hold, looked at before anything is taken from it."""

import re
from collections.abc import Iterable, Mapping
from numbers import Real
from typing import Any

from yade_scripts.lists import one_of
from yade_scripts.model import registry

KINDS = ("array", "boolean", "integer", "null", "number", "object", "string")
NAME = re.compile(r"[a-z][a-z0-9_]*")
DEEPEST = 12
_COUNT, _NUMBER = (int,), (int, float)
WORDS: dict[str, tuple[type, ...]] = {  # a keyword, and types of its value
    **dict.fromkeys(("$schema", "title", "description", "unit"), (str,)),
    **dict.fromkeys(("pattern", "pattern_words", "models", "below", "at_most"), (str,)),
    **dict.fromkeys(("minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"), _NUMBER),
    **dict.fromkeys(("minItems", "maxItems", "minLength", "maxLength"), _COUNT),
    **dict.fromkeys(("uniqueItems", "ascending", "measures"), (bool,)),
    **dict.fromkeys(("enum", "required", "anyOf", "oneOf", "usual"), (list,)),
    **dict.fromkeys(("properties", "items"), (dict,)),
    **dict.fromkeys(("default", "const"), (object,)),
    "type": (str, list),
    "additionalProperties": (bool, dict),
    "acts_with": (dict, list),
    "contains": (dict,),
}


def fault(schema: Mapping, leaf: bool = False, depth: int = 0) -> str:
    """Say in a few words what is no schema that the configuration takes; empty where all is.

    `leaf` is of a key that is not itself a section: it has a default.
    """
    if depth > DEEPEST:
        return f"nested more than {DEEPEST} levels deep"
    for word, value in schema.items():
        if word not in WORDS:
            return f"keyword {word!r}: {one_of(WORDS, word)}"
        kinds = WORDS[word]
        if not isinstance(value, kinds) or (isinstance(value, bool) and kinds in (_COUNT, _NUMBER)):
            return f"{word}: expected {' or '.join(kind.__name__ for kind in kinds)}"
    if said := _of_values(schema):
        return said
    listed = schema.get("items", {}).get("measures", False)  # a list of these has all by default
    if leaf and "default" not in schema and not listed:
        return "default: missing"
    parts = [("items", schema.get("items")), ("contains", schema.get("contains"))]
    parts += [(word, option) for word in ("anyOf", "oneOf") for option in schema.get(word, ())]
    for word, part in parts:
        if part is not None and (said := _inside(part, False, depth)):
            return f"{word}: {said}"
    for name, part in schema.get("properties", {}).items():
        if not isinstance(name, str) or not NAME.fullmatch(name):
            return f"key {name!r}: expected lower-case letters, digits and _, a letter first"
        is_leaf = isinstance(part, dict) and "properties" not in part and depth == 0
        if said := _inside(part, is_leaf, depth):
            return f"{name}: {said}"
    return ""


def _inside(part: Any, leaf: bool, depth: int) -> str:
    """Fault of a schema inside another."""
    return fault(part, leaf, depth + 1) if isinstance(part, dict) else "expected keywords"


def _of_values(schema: Mapping) -> str:
    """What the value of a keyword may not be, though it has the type."""
    kinds = schema.get("type", ())
    for kind in [kinds] if isinstance(kinds, str) else kinds:
        if kind not in KINDS:
            return f"type {kind!r}: {one_of(KINDS, kind)}"
    if not schema.get("enum", True):
        return "enum: expected values"
    usual = schema.get("usual", (0.0, 1.0))
    if len(usual) != 2 or not all(isinstance(v, Real) for v in usual) or usual[0] >= usual[1]:
        return "usual: expected two ascending numbers"
    try:
        re.compile(schema.get("pattern", ""))
    except re.error as error:
        return f"pattern: {error}"
    if not isinstance(getattr(registry, schema.get("models", "WITH_WALLS"), None), Iterable):
        return f"models {schema['models']!r}: expected the name of a list of models"
    return ""


def unknown_path(leaves: Mapping[str, Mapping]) -> str:
    """Say which key a schema names that no schema has; `leaves` are all keys by dotted path."""
    for path, schema in leaves.items():
        entries = schema.get("items", {}).get("properties", {})
        for place, part in ((path, schema), *((f"{path}[].{k}", v) for k, v in entries.items())):
            named = [(word, part[word]) for word in ("below", "at_most") if word in part]
            sets = part.get("acts_with", [])
            for conditions in sets if isinstance(sets, list) else [sets]:
                if not isinstance(conditions, Mapping) or not all(
                    isinstance(v, dict) for v in conditions.values()
                ):
                    return f"{place}: acts_with: expected keys, and a schema of each"
                named += [("acts_with", key) for key in conditions]
            for word, key in named:
                if key not in leaves and key not in entries:
                    return f"{place}: {word} {key!r}: {one_of(leaves, key)}"
    return ""
