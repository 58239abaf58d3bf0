"""Wording what a configuration did wrong: the key's path, its value, what was expected."""

import difflib
import re
from typing import Any

import jsonschema

from rocking.configuration.schema import (
    STUDY_KEYS,
    ConfigError,
    decimal_comma,
    expectation,
    leaves,
    show,
    within,
)
from rocking.configuration.units import meant
from yade_scripts.lists import listed


def unknown_key(path: str, known: dict) -> ConfigError:
    """Refuse a key by name, with the nearest known one or those of its section."""
    if slip := re.fullmatch(r"(?:(.*)\.)?(\w+):(\S+)", path):
        where, key, value = slip.groups()
        return ConfigError(
            f"'{key}:{value}' {within(where or '')}: write a space after the colon, {key}: {value}"
        )
    if re.fullmatch(r"(.*\.)?[0-9]+", path):
        where, _, digits = path.rpartition(".")
        return decimal_comma(digits, where)
    paths = [p for p, _ in leaves(known)]
    section, _, leaf = path.rpartition(".")
    alike = [p for p in paths if p.rpartition(".")[2] == leaf]
    depth = min((p.count(".") for p in alike), default=0)
    same = [p for p in alike if p.count(".") == depth]  # not what lies deeper in another section
    near = same
    if same and not section:  # "record" at the top level is rather "records" than "pictures.record"
        near = [*difflib.get_close_matches(leaf, known["properties"], 1, 0.85), *same]
    if not near and len(path) < 100:  # long junk is near nothing and would only cost time
        in_section = {p.rpartition(".")[2]: p for p in paths if p.rpartition(".")[0] == section}
        others = {p.rpartition(".")[2]: p for p in paths}
        tops = {} if section else {name: name for name in (*known["properties"], *STUDY_KEYS)}
        for names in ({**in_section, **tops}, others):
            near = near or [names[m] for m in difflib.get_close_matches(leaf, names, 1, 0.7)]
    if near:
        meant = " or ".join(f"'{name}'" for name in near)
        return ConfigError(f"unknown key '{path}'; did you mean {meant}?")
    properties = known["properties"]
    for part in section.split(".") if section else ():
        properties = properties.get(part, {}).get("properties", {})
    return ConfigError(f"unknown key '{path}'; expected one of {listed(properties or paths)}")


def refusal(error: jsonschema.ValidationError, known: dict) -> ConfigError:
    """Turn a validator's error into one line: key path, value, what was expected."""
    schema: dict = known
    unit = "-"
    path = ""
    for step in error.absolute_path:
        path += f"[{step + 1}]" if isinstance(step, int) else f".{step}" if path else step
        if isinstance(step, int):
            options = [schema, *schema.get("anyOf", []), *schema.get("oneOf", [])]
            schema = next((o["items"] for o in options if isinstance(o.get("items"), dict)), {})
        else:
            other = schema.get("additionalProperties")
            fallback = other if isinstance(other, dict) else {}
            schema = schema.get("properties", {}).get(step, fallback)
        unit = schema.get("unit", unit)
    if error.validator == "additionalProperties":
        extra = [k for k in error.instance if k not in error.schema.get("properties", {})]
        if "[" in path:  # an entry of a list has keys of its own
            keys = schema.get("properties", {})
            near = difflib.get_close_matches(extra[0], keys, 1, 0.7)
            meant = f"did you mean '{near[0]}'?" if near else f"expected one of {listed(keys)}"
            return ConfigError(f"unknown key '{path}.{extra[0]}'; {meant}")
        return unknown_key(f"{path}.{extra[0]}" if path else extra[0], known)
    if not schema:
        schema = error.schema if isinstance(error.schema, dict) else {}
    if error.validator == "required":
        missing = next(k for k in error.validator_value if k not in error.instance)
        return ConfigError(f"{path}.{missing}: missing".lstrip("."))
    words = expectation({**schema, "unit": schema.get("unit", unit)})
    hint = _other_unit(error.instance, schema, unit)
    if isinstance(error.instance, str) and re.fullmatch(r"[+-]?\d+,\d+", error.instance):
        hint = "; write a decimal point, not a comma"
    return ConfigError(f"{path} = {show(error.instance)}: expected {words}{hint}")


def _other_unit(value: Any, schema: dict, unit: str) -> str:
    """Return "; 6480 mm would be 6.48 m" of a number that is usual in another unit."""
    number = isinstance(value, int | float) and not isinstance(value, bool)
    return f"; {said}" if number and (said := meant(value, unit, schema.get("usual"))) else ""


def refuse_invalid(value: Any, known: dict) -> None:
    """Raise `ConfigError` for the first error of `value`; unknown keys come before the rest."""

    def place(error):
        return error.validator != "additionalProperties", list(map(str, error.absolute_path))

    errors = jsonschema.Draft202012Validator(known).iter_errors(value)
    if first := min(errors, key=place, default=None):
        raise refusal(first, known)
