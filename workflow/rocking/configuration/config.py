"""The configuration: defaults filled in, validated, expanded into the runs of a study.

A user's configuration holds what differs from the defaults; `resolve` completes it from the
schemas (see `config_schema`), `check` looks at keys together, `expand_scenarios` makes one
resolved configuration for each run. Everything wrong is a `ConfigError` of one line.
"""

import itertools
import json
import math
from collections.abc import Mapping
from typing import Any

from rocking.configuration import refusals
from rocking.configuration import schema as config_schema
from rocking.configuration.differences import by_path
from rocking.configuration.facade import check_facade
from rocking.configuration.files import changed, check_files, write_resolved
from rocking.configuration.layers import laid_over, nest, nested
from rocking.configuration.schema import STUDY_KEYS, ConfigError, show, value_at
from rocking.configuration.settled import settle, settle_mass
from rocking.configuration.storeys import check_storeys
from rocking.configuration.study import as_in_the_study
from rocking.configuration.units import unusual
from rocking.configuration.words import listed
from yade_scripts.lists import one_of
from yade_scripts.model.part import part_of

__all__ = [
    "ConfigError",
    "check",
    "changed",
    "check_files",
    "expand_scenarios",
    "laid_over",
    "nested",
    "relevant",
    "resolve",
    "write_resolved",
]

MAX_RUNS = 1000
# of a run with risk.hazard, where nothing else is stated: many motions, one number
RATED: dict[str, dict[str, Any]] = {
    "ida": {"power": 0.0, "confirm": "collapse", "confirm_every": 8},
    "ensemble": {"enabled": "off"},
}


def resolve(config: Mapping) -> dict[str, Any]:
    """Complete a configuration with the defaults of every section, and validate it.

    What the user gave has no `scenario`, `scenarios` or `grid`. The result has every key of every
    schema, numbers as float, whole numbers as int, in the order of the schemas: equal
    configurations give equal results, however they were written.
    """
    if not isinstance(config, Mapping):
        raise ConfigError("expected keys and values at the top level")
    values = config_schema.plain(config)
    for key in STUDY_KEYS:
        if values.pop(key, None):
            raise ConfigError(f"'{key}' describes several runs; use expand_scenarios")
    known = config_schema.whole()
    resolved = config_schema.complete(_rated(values), known)
    refusals.refuse_invalid(resolved, known)
    stated = {path for path, _ in by_path(values)}
    settle(resolved, stated)
    try:
        check(resolved)
    except ConfigError as error:  # what follows from a number in another unit is no help alone
        raise ConfigError("; ".join([error.detail, *list(unusual(resolved))[:1]])) from None
    settle_mass(resolved, stated)
    return resolved


def _rated(values: dict) -> dict[str, Any]:
    """Return what was given with `RATED` under it, where a hazard curve is among it."""
    sections = [values.get(name, {}) for name in ("risk", *RATED)]
    if not all(isinstance(section, dict) for section in sections) or not sections[0].get("hazard"):
        return values
    return {**values, **{name: {**RATED[name], **values.get(name, {})} for name in RATED}}


def check(resolved: Mapping) -> None:
    """Check keys of a resolved configuration against each other.

    Limits that one key sets for another come from the schemas, see `check_limits`; geometry that
    cannot stand and combinations that mean nothing are written out here.
    """
    check_limits(resolved)
    check_facade(resolved)
    check_storeys(resolved)
    _check_part(resolved)
    law = resolved["damping"]["law"]
    if resolved["facade"]["sides"] == "two" and law != "value":
        raise ConfigError(
            f"damping.law = {law}: expected value with facade.sides = two, since both laws "
            "describe impacts against return walls"
        )
    low, high = resolved["ensemble"]["percentiles"]
    if not low < 50.0 < high:
        raise ConfigError(
            f"ensemble.percentiles = {show([low, high])}: expected one below and one above 50 (%)"
        )


def _check_part(resolved: Mapping) -> None:
    """Refuse a part that the façade has not, or that is no façade of its own."""
    try:
        heights = {**resolved["part"]}
        wall = resolved["return_wall"]
        wedge = heights.pop("wedge_deg"), wall["count"] * wall["thickness_m"]
        facade = part_of(resolved["facade"], **heights, wedge=wedge)
    except ValueError as error:
        raise ConfigError(str(error)) from None
    if facade != resolved["facade"]:
        try:
            check_facade({**resolved, "facade": facade})
        except ConfigError as error:
            raise ConfigError(
                f"part of the façade from {resolved['part']['foot_m']:g} m: {error}"
            ) from None


def check_limits(resolved: Mapping) -> None:
    """Check values against what the schemas say of them by another key or by each other.

    `below` and `at_most` of a list's entries hold for each of them. `resolved` may lack sections,
    as a case does.
    """
    alone = resolved["facade"]["sides"] == "two"
    for path, schema in config_schema.leaves(config_schema.whole()):
        if path.split(".")[0] not in resolved or (alone and path.startswith("return_wall.")):
            continue  # there are no walls
        value = value_at(resolved, path)
        _check_below(resolved, path, value, schema)
        if isinstance(value, list):
            for number, entry in enumerate(value, 1):
                _check_below(resolved, f"{path}[{number}]", entry, schema.get("items", {}))
        if schema.get("ascending") and value and any(a >= b for a, b in itertools.pairwise(value)):
            raise ConfigError(f"{path} = {show(value)}: expected ascending values")


def _check_below(resolved: Mapping, path: str, value: Any, schema: Mapping) -> None:
    for word in ("below", "at_most"):
        limit = value_at(resolved, schema[word]) if word in schema else None
        if value is None or limit is None:
            continue
        if value > limit or (word == "below" and value == limit):
            text = f"{word.replace('_', ' ')} {schema[word]} = {show(limit)}"
            raise ConfigError(f"{path} = {show(value)}: expected a value {text}")


class Settings(str):
    """Sections of the configuration as JSON, for a rule's `params`; captions take its `words`."""

    __slots__ = ()

    @property
    def words(self):
        """The values that are set, in words.

        Left out are values that the workflow chooses itself, and parts that the façade does not
        have: an empty list, or a 0 that is the 3DEC study's (gables, gaps, courses).
        """
        usual = resolve(as_in_the_study())
        return listed(
            (key, value)
            for section, values in json.loads(self).items()
            for key, value in values.items()
            if isinstance(value, bool) or value != 0 or usual.get(section, {}).get(key) != 0
        )


def relevant(resolved: Mapping, *paths: str) -> Settings:
    """Return the named sections or keys as canonical JSON, for the `params` of a rule.

    A rule that names what it depends on reruns when that changes, and only then. Paths are sections
    ("facade"), top-level keys ("seed") or dotted ("numerics.step_s"); a KeyError for one that is
    not there.
    """
    parts = {path: value_at(resolved, path) for path in paths}
    return Settings(json.dumps(parts, sort_keys=True, separators=(",", ":"), ensure_ascii=False))


def expand_scenarios(config: Mapping) -> dict[str, dict[str, Any]]:
    """Return the resolved configuration of every run of a study, by run name.

    `scenarios` maps names to overrides (nested or with dotted keys); `scenario` chooses one, a list
    or `all` of them; `grid` maps dotted keys to lists of values and gives every combination. Runs
    are called <run>, <run>-<scenario>, <run>-<key>_<value>-… or <run>-<scenario>-<key>_<value>-….
    An error names the scenario.
    """
    return {name: resolved for name, (resolved, _) in expanded(config).items()}


def expanded(config: Mapping) -> dict[str, tuple[dict[str, Any], dict[str, Any]]]:
    """(resolved, stated) of every run as `expand_scenarios`, by run name.

    `stated` is the user's configuration with the run's scenario and cell of the grid.
    """
    if not isinstance(config, Mapping):
        raise ConfigError("expected keys and values at the top level")
    common = config_schema.plain(config)
    wanted, scenarios, grid = (common.pop(key, None) for key in STUDY_KEYS)
    cells = _grid(grid)
    named = _scenarios(scenarios)
    chosen = _chosen(wanted, named)
    named = {name: overrides for name, overrides in named.items() if name in chosen}
    if len(cells) * max(len(named), 1) > MAX_RUNS:
        raise ConfigError(f"scenarios and grid make more than {MAX_RUNS} runs")
    runs: dict[str, tuple[dict, dict]] = {}
    called: dict[str, str] = {}
    for name, overrides in (named or {"": {}}).items():
        for label, cell in cells.items():
            ending = "-".join(part for part in (name, label) if part)
            given = laid_over(laid_over(common, overrides), cell)
            try:
                resolved = resolve(given)
                if ending:
                    resolved = resolve({**given, "run": f"{resolved['run']}-{ending}"})
            except ConfigError as error:
                if not ending or error.detail == _fault(common):
                    raise
                raise ConfigError(f"scenario '{ending}': {error.detail}") from None
            # one folder where names of files have no case
            if (other := called.setdefault(resolved["run"].casefold(), resolved["run"])) in runs:
                raise ConfigError(f"two runs would be called '{other}' and '{resolved['run']}'")
            runs[resolved["run"]] = resolved, given
    return runs


def _fault(config: dict) -> str | None:
    """Return what is wrong with a configuration, None if nothing is."""
    try:
        resolve(config)
    except ConfigError as error:
        return error.detail
    return None


def _scenarios(given: Any) -> dict[str, dict]:
    if given is None:
        return {}
    if not isinstance(given, dict):
        raise ConfigError(f"scenarios = {show(given)}: expected names with overrides under each")
    out = {}
    for name, overrides in given.items():
        if overrides is not None and not isinstance(overrides, dict):
            raise ConfigError(f"scenarios.{name} = {show(overrides)}: expected keys and values")
        out[name] = nest(overrides or {}, f"scenarios.{name}")
        for key in ("run", *STUDY_KEYS):
            if key in out[name]:
                raise ConfigError(f"scenarios.{name}.{key}: a scenario cannot set '{key}'")
    if "" in out or "all" in out:
        raise ConfigError("scenarios: expected names other than 'all' and the empty one")
    return out


def _chosen(wanted: Any, named: dict) -> set[str]:
    if wanted is None or wanted == "all":
        return set(named)
    names = wanted if isinstance(wanted, list) else str(wanted).split(",")
    for name in names or [[]]:
        if not isinstance(name, str) or name.strip() not in named:
            known = f"{one_of(named, name)}, or all" if named else "no scenarios are defined"
            raise ConfigError(f"scenario = {show(name)}: {known}")
    return {name.strip() for name in names}


def _grid(given: Any) -> dict[str, dict]:
    """Return {label: overrides} for every combination of a grid; {"": {}} without one."""
    if given is None:
        return {"": {}}
    if not isinstance(given, dict):
        raise ConfigError(f"grid = {show(given)}: expected keys with a list of values each")
    known = config_schema.whole()
    schemas = dict(config_schema.leaves(known))
    axes = []
    lists: dict[str, Any] = {}
    for path, values in by_path(given):
        if path in lists:
            raise ConfigError(f"grid.{path}: given twice")
        lists[path] = values
    count = math.prod(len(v) if isinstance(v, list) else 1 for v in lists.values())
    if count > MAX_RUNS:
        raise ConfigError(f"grid: {count} combinations, expected at most {MAX_RUNS}")
    short = [path.rpartition(".")[2] for path in lists]
    for path, values in lists.items():
        if path == "run":
            raise ConfigError("grid.run: a grid names its runs itself")
        if path in known["properties"] and path not in schemas:
            raise ConfigError(f"grid.{path}: expected a key of that section, as in {path}.…")
        if path not in schemas:
            raise refusals.unknown_key(path, known)
        if not isinstance(values, list) or not values:
            raise ConfigError(f"grid.{path} = {show(values)}: expected a list of values")
        leaf = path.rpartition(".")[2]
        leaf = leaf if short.count(leaf) == 1 else path
        points = [config_schema.complete(value, schemas[path]) for value in values]
        labels = [f"{leaf}_{_word(point)}" for point in points]
        if len(set(labels)) < len(labels):
            raise ConfigError(f"grid.{path} = {show(values)}: expected different values")
        axes.append([(label, path, point) for label, point in zip(labels, points, strict=True)])
    return {
        "-".join(label for label, *_ in cell): nest({path: at for _, path, at in cell}, "grid")
        for cell in itertools.product(*axes)
    }


def _word(value: Any) -> str:
    """Return a value as part of a run's name; text that does not suit one is refused later."""
    if isinstance(value, list):
        return "_".join(_word(v) for v in value)
    if isinstance(value, float):
        return format(value, ".10g").replace("+", "")
    return value if isinstance(value, str) else show(value)
