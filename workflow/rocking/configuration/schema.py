"""Schemas of the configuration: loading them, completing values, wording what is allowed.

One file `<section>.schema.yaml` describes one section, of the core in `workflow/schemas`, of a
study in its folder of `workflow/studies`; `run` holds the keys at the top level. A file added is a
section added to the configuration; a study's file with the name of a section of the core adds its
keys to that. Beside JSON Schema's own keywords (draft 2020-12) these are understood:

`unit`           unit of the value, "-" for dimensionless
`below`, `at_most`  path of another key whose value is an upper limit, exclusive or inclusive
`ascending`      the numbers of an array increase
`models`         the value is the name of a model; which, a list of `registry` says; `{models}`
                 in the key's description is what each of them is
`measures`       the value is the name of an intensity measure; a list without default has all
`acts_with`      what other keys must be for this one to do anything, see `together`
`usual`          lowest and highest common value, beyond which a run warns, see `units`
`pattern_words`  what `pattern` means, for messages
"""

import copy
import datetime
import functools
import math
import numbers
import operator
import re
import reprlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import jsonschema
import yaml

from rocking.configuration import declared
from rocking.shipped import shipped
from yade_scripts.model import registry

FOLDER = shipped("workflow/schemas")
STUDIES = shipped("workflow/studies")
ENDING = ".schema.yaml"
LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)  # libyaml, where PyYAML has it
TOP = "run"  # the schema whose keys stand at the top level
STUDY_KEYS = ("scenario", "scenarios", "grid")  # of a study, not of one run
MAX_VALUES = 20_000  # values in one configuration; more is a mistake or an attack
MAX_DEPTH = 12
_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
_INTEGER = re.compile(r"[+-]?[0-9]{1,18}")
_NULLS = ("null", "None", "~", "")
_BOOLEANS = {"true": True, "yes": True, "on": True, "false": False, "no": False, "off": False}


class ConfigError(ValueError):
    """A configuration that cannot be run; its text is one printable line."""

    def __init__(self, text: str):
        """Keep `text` on one line: control characters escaped, endless words and lists cut."""
        line = "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
        line = re.sub(r"\S{160,}", lambda word: word[0][:80] + "…", line)
        self.detail = line if len(line) <= 1200 else line[:1200] + "…"
        super().__init__(f"config: {self.detail}")


def files(folder: Path = FOLDER) -> list[tuple[str, Path]]:
    """Name of the section and schema file: those of a folder; of the core's, then the studies'."""
    paths = sorted(folder.glob(f"*{ENDING}"))
    paths += sorted(STUDIES.glob(f"*/*{ENDING}")) if folder == FOLDER else []
    return [(path.name.removesuffix(ENDING), path) for path in paths]


def _loaded(path: Path) -> dict:
    """Schema of one file as it stands there; ConfigError of one line if it is no schema."""
    if not path.is_file():
        raise ConfigError(f"{path}: expected a file")
    try:
        schema = _once(path.read_text("utf-8"), path)
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigError(f"{path}: not readable as text ({error})") from None
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = f" line {mark.line + 1}" if mark else ""
        raise ConfigError(f"{path}{line}: not readable as YAML") from None
    keys = schema.get("properties") if isinstance(schema, dict) else None
    if not isinstance(keys, dict) or not all(isinstance(part, dict) for part in keys.values()):
        raise ConfigError(f"{path}: expected a schema: properties, and below it keys")
    if said := declared.fault(schema):
        raise ConfigError(f"{path}: {said}")
    return schema


def _close(section: dict) -> None:
    """A section is a mapping of the keys that its schema names, and of no others."""
    section |= {"type": "object", "additionalProperties": False}
    for part in section["properties"].values():
        if "properties" in part:
            _close(part)


def _once(text: str, path: Path) -> Any:
    """Read YAML in which no key stands twice in one mapping."""
    loader = LOADER(text)
    try:
        node = loader.get_single_node()
        for twice in _twice(node, 0):
            raise ConfigError(
                f"{path} line {twice.start_mark.line + 1}: {twice.value} stands twice"
            )
        return None if node is None else loader.construct_document(node)
    finally:
        loader.dispose()


def _twice(node: Any, depth: int) -> Iterator[yaml.Node]:
    """Keys that stand in a mapping a second time, down to a depth."""
    if not isinstance(node, yaml.CollectionNode) or depth > MAX_DEPTH:
        return
    seen = set()
    for part in node.value:
        key, value = part if isinstance(node, yaml.MappingNode) else (None, part)
        if isinstance(key, yaml.ScalarNode):
            if key.value in seen:
                yield key
            seen.add(key.value)
        yield from _twice(value, depth + 1)


def read(path: Path) -> dict:
    """Schema of one file, models and measures named."""
    section = _loaded(path)
    _close(section)
    for _, leaf in leaves(section):
        _name_all(leaf)
    return section


@functools.lru_cache(maxsize=4)
def sections(folder: Path = FOLDER) -> dict[str, dict]:
    """Schema of every section by name, the top level first, then in alphabetical order."""
    loaded: dict[str, dict] = {}
    for name, path in files(folder):
        top = {*STUDY_KEYS, *loaded.get(TOP, {}).get("properties", {})} - {TOP}
        if name in top:
            raise ConfigError(f"{path}: {name} is a key at the top level; expected another name")
        if (known := loaded.setdefault(name, section := read(path))) is section:
            continue
        if both := sorted({*known["properties"]} & {*section["properties"]}):
            raise ConfigError(f"{path}: {name}.{both[0]} stands elsewhere too")
        known["properties"] |= section["properties"]
    if TOP not in loaded:
        raise FileNotFoundError(f"{folder}: no {TOP}.schema.yaml")
    return {name: loaded[name] for name in sorted(loaded, key=lambda name: (name != TOP, name))}


def _name_all(leaf: dict) -> None:
    """Put what can be named in place of the keywords `models` and `measures` of a key."""
    for part in (leaf, leaf.get("items", {})):
        if "models" in part:
            part["enum"] = list(getattr(registry, part.pop("models")))
            meant = "; ".join(f"{name}: {registry.MODELS[name].meaning}" for name in part["enum"])
            leaf["description"] = leaf.get("description", "").replace("{models}", meant)
        if part.pop("measures", False):
            from rocking.records.intensity_measures import MEASURES  # loads spectra

            part["enum"] = list(MEASURES)
            leaf.setdefault("default", list(MEASURES))


@functools.lru_cache(maxsize=4)
def whole(folder: Path = FOLDER) -> dict:
    """Return the schema of a complete configuration, assembled from the sections."""
    parts = dict(sections(folder))
    top = parts.pop(TOP)
    all_of_them = {
        "type": "object",
        "additionalProperties": False,
        "properties": {**top["properties"], **parts},
    }
    if said := declared.unknown_path(dict(leaves(all_of_them))):
        raise ConfigError(f"schema of {said}")
    return all_of_them


def leaves(schema: dict, prefix: str = "") -> Iterator[tuple[str, dict]]:
    """Yield (dotted path, schema) of every key that is not itself a section of named keys."""
    for name, part in schema.get("properties", {}).items():
        if "properties" in part:
            yield from leaves(part, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", part


def value_at(resolved: Mapping, path: str) -> Any:
    """Value of a dotted key."""
    return functools.reduce(operator.getitem, path.split("."), resolved)


def plain(value: Any, path: str = "", depth: int = 0, budget: list | None = None) -> Any:
    """Copy `value` as dicts with text keys, lists, text, finite numbers, booleans and None.

    Anything else is refused by its path, and so are cyclic or very deep nesting and too many
    values.
    """
    budget = [MAX_VALUES] if budget is None else budget
    budget[0] -= 1
    if depth > MAX_DEPTH:
        raise ConfigError(f"{path[:80]}…: nested more than {MAX_DEPTH} levels deep")
    if budget[0] < 0:
        raise ConfigError(f"more than {MAX_VALUES} values in the configuration")
    if isinstance(value, Mapping):
        out = {}
        for key, item in value.items():
            if isinstance(key, int) and item is None:  # "b: 0,42" in braces: b: 0 and a key 42
                raise decimal_comma(str(key), path)
            if not isinstance(key, str):
                raise ConfigError(f"key {show(key)} {within(path)}: expected text; quote it")
            out[key] = plain(item, f"{path}.{key}" if path else key, depth + 1, budget)
        return out
    if isinstance(value, (list, tuple)):
        return [plain(v, f"{path}[{i + 1}]", depth + 1, budget) for i, v in enumerate(value)]
    if value is None or isinstance(value, bool):
        return value
    if isinstance(value, numbers.Integral):  # NumPy's too
        if abs(int(value)) >= 2**63:
            raise ConfigError(f"{path}: expected a number of fewer digits")
        return int(value)
    if isinstance(value, numbers.Real):
        if not math.isfinite(value):
            raise ConfigError(f"{path} = {value}: expected a finite number")
        return float(value)
    if isinstance(value, str):
        if not value.isprintable():
            raise ConfigError(f"{path} = {show(value)}: expected text without control characters")
        return str(value)
    if type(value) is datetime.date:  # YAML's reading of an unquoted 2024-05-17
        return value.isoformat()
    raise ConfigError(f"{path}: a value of type {type(value).__name__} has no place here; quote it")


def within(path: str) -> str:
    """Say where a key stands."""
    return f"in '{path}'" if path else "at the top level"


def complete(value: Any, schema: dict) -> Any:
    """Turn `value` into what `schema` asks for where that is unambiguous, and fill in defaults.

    Values inside `--config 'section={key: 1.5}'` reach a workflow as text, and YAML reads 1e-3 as
    text and `on` as a boolean; a single item stands for a list of one, commas separate more. What
    does not fit is returned as it is, for validation to refuse.
    """
    for branches in (schema.get("anyOf"), schema.get("oneOf")):
        for branch in branches or ():
            candidate = complete(value, branch)
            if jsonschema.Draft202012Validator(branch).is_valid(candidate):
                return candidate
    kinds = schema.get("type", [])
    kinds = [kinds] if isinstance(kinds, str) else kinds
    if "object" in kinds:
        return _complete_object(value, schema, "null" in kinds)
    if "array" in kinds and "string" not in kinds:
        if isinstance(value, str) and not ("null" in kinds and value in _NULLS):
            value = [part.strip() for part in value.split(",")] if value.strip() else []
        elif value is not None and not isinstance(value, (list, dict)):
            value = [value]
        if isinstance(value, list):
            return [complete(item, schema.get("items", {})) for item in value]
    if isinstance(value, str) and "string" not in kinds:
        return _from_text(value, kinds)
    if isinstance(value, bool):
        # YAML 1.1 reads a bare on or off as a boolean
        word = "on" if value else "off"
        return word if "string" in kinds and word in schema.get("enum", ()) else value
    if isinstance(value, int) and "string" in kinds and "integer" not in kinds:
        return str(value)
    if isinstance(value, (int, float)) and "number" in kinds:
        return float(value)
    if isinstance(value, float) and "integer" in kinds and value.is_integer():
        return int(value)
    return value


def _complete_object(value: Any, schema: dict, nullable: bool) -> Any:
    if value is None and not nullable:  # a section heading whose keys are all commented out
        value = {}
    if not isinstance(value, dict):
        return value
    known = schema.get("properties", {})
    other = schema.get("additionalProperties")
    out = {}
    for key, part in known.items():
        if key in value:
            out[key] = complete(value[key], part)
        elif "default" in part:
            out[key] = complete(copy.deepcopy(part["default"]), part)
        elif part.get("type") == "object":
            out[key] = complete({}, part)
    for key, item in value.items():
        if key not in known:
            out[key] = complete(item, other) if isinstance(other, dict) else item
    return out


def _from_text(text: str, kinds: list) -> Any:
    word = text.strip()
    if "null" in kinds and word in _NULLS:
        return None
    if "boolean" in kinds and word.lower() in _BOOLEANS:
        return _BOOLEANS[word.lower()]
    if "integer" in kinds and _INTEGER.fullmatch(word):
        return int(word)
    if "number" in kinds and len(word) <= 40 and _NUMBER.fullmatch(word):
        number = float(word)
        return number if math.isfinite(number) else text
    return text


def show(value: Any) -> str:
    """Return a short one-line form of a value, as the user would write it."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return format(value, ".12g")
    if isinstance(value, int):
        return str(value) if abs(value) < 2**63 else "a very long number"
    if isinstance(value, list) and all(isinstance(v, (int, float, str)) for v in value[:6]):
        return "[" + ", ".join([show(v) for v in value[:6]] + ["…"] * (len(value) > 6)) + "]"
    brief = reprlib.Repr()
    brief.maxstring = brief.maxother = 60
    return brief.repr(value)


def expectation(schema: dict) -> str:
    """Word what a schema allows: "a number > 0 (m)", "one of a, b", "a list of …"."""
    if "anyOf" in schema or "oneOf" in schema:
        return " or ".join(expectation(part) for part in schema.get("anyOf") or schema["oneOf"])
    if "const" in schema:
        return show(schema["const"])
    kinds = schema.get("type", [])
    kinds = [kinds] if isinstance(kinds, str) else list(kinds)
    parts = [_kind(kind, schema) for kind in kinds if kind != "null"]
    if "enum" in schema:
        words = [str(v) for v in schema["enum"] if v is not None]
        parts = ["one of " + ", ".join(words) if len(words) > 1 else words[0]]
    text = " or ".join(parts) or "a value"
    text += f" ({schema['unit']})" if schema.get("unit", "-") != "-" else ""
    text += f", below {schema['below']}" if "below" in schema else ""
    text += f", at most {schema['at_most']}" if "at_most" in schema else ""
    return text + (" or null" if "null" in kinds else "")


def _kind(kind: str, schema: dict) -> str:
    if kind in ("number", "integer"):
        return ("a whole number" if kind == "integer" else "a number") + _range(schema)
    if kind == "array":
        low, high = schema.get("minItems", 0), schema.get("maxItems")
        count = f"{low} " if low == high else (f"{low} or more " if low else "")
        traits = {"uniqueItems": "different", "ascending": "ascending"}
        words = " ".join([*(traits[key] for key in traits if schema.get(key)), "values"])
        return f"a list of {count}{words}, each {expectation(schema.get('items', {}))}"
    if kind == "string":
        allowed = schema.get("pattern_words") or schema.get("pattern")
        return f"text of {allowed}" if allowed else "text"
    return {"boolean": "true or false", "object": "a section of keys and values"}.get(kind, kind)


def _range(schema: dict) -> str:
    low, high = schema.get("minimum"), schema.get("maximum")
    if low is not None and high is not None:
        return f" from {show(low)} to {show(high)}"
    bounds = {
        ">": schema.get("exclusiveMinimum"),
        "≥": low,
        "<": schema.get("exclusiveMaximum"),
        "≤": high,
    }
    limits = [f"{sign} {show(value)}" for sign, value in bounds.items() if value is not None]
    return " " + " and ".join(limits) if limits else ""


def decimal_comma(digits: str, path: str) -> ConfigError:
    """Refuse what follows a decimal comma, which braces take for a key of its own."""
    return ConfigError(
        f"'{digits}' {within(path)} is no key: for a decimal comma write a point, as in 9.5"
    )
