"""Configuration files: the resolved one beside a run's results, stricter reading of users' own."""

import os
from collections.abc import Iterable, Mapping
from pathlib import Path

import yaml

from rocking.configuration.differences import flat
from rocking.configuration.schema import ConfigError
from yade_scripts.files import write_atomic


def write_resolved(resolved: Mapping, path: str | os.PathLike, chosen: Iterable[str] = ()) -> None:
    """Write a resolved configuration as YAML that can be given back with `--configfile`.

    What null stands for is said at the end in comments, the lines of `chosen`. The file is replaced
    at once, and left alone where it already says the same.
    """
    target = Path(path)
    text = "# Every key of this run, defaults included; written by the workflow.\n"
    text += yaml.safe_dump(dict(resolved), sort_keys=False, allow_unicode=True, width=100)
    text += "".join(f"# {line}\n" for line in chosen)
    if target.is_file() and target.read_text("utf-8") == text:
        return
    write_atomic(target, text)


SHOWN_CHANGES = 4  # keys named in one line


def changed(resolved: Mapping, path: str | os.PathLike) -> str:
    """What a run's settings change of those that its results were made with, in one line.

    `path` is its config.yaml, written by `write_resolved`; missing or unreadable, nothing is said.
    """
    try:
        before = flat(yaml.safe_load(Path(path).read_text("utf-8")))
    except (OSError, ValueError, yaml.YAMLError, AttributeError):
        return ""
    now = flat(resolved)
    keys = [key for key in now if key in before and before[key] != now[key]]
    if not keys:
        return ""
    named = [f"{key} {_shown(before[key])} → {_shown(now[key])}" for key in keys[:SHOWN_CHANGES]]
    more = f" and {len(keys) - SHOWN_CHANGES} more" if len(keys) > SHOWN_CHANGES else ""
    return (
        f"run {resolved['run']} gets other settings than its results have: {', '.join(named)}"
        f"{more}; what depends on them is made again (run=<another name> keeps both)"
    )


def _shown(value):
    """A value in few characters."""
    words = str(value)
    return words if len(words) <= 24 else words[:21] + "…"


_CONVERSION = (ValueError, TypeError, LookupError, ArithmeticError, AttributeError)


class _UniqueKeys(yaml.SafeLoader):
    """YAML's safe loader, refusing a key that stands twice in one mapping."""

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key_node, _ in node.value:
            if isinstance(key_node, yaml.ScalarNode) and key_node.tag != "tag:yaml.org,2002:merge":
                if key_node.value in seen:
                    raise yaml.constructor.ConstructorError(
                        None, None, f"key '{key_node.value}' stands twice", key_node.start_mark
                    )
                seen.add(key_node.value)
        return super().construct_mapping(node, deep)


def _refuse_other_bases(text, name):
    """Refuse a number that YAML reads as another: 010 is 8, 1:30 is 90, 0x10 is 16."""
    for event in yaml.parse(text, yaml.SafeLoader):
        if not isinstance(event, yaml.ScalarEvent) or not event.implicit[0]:
            continue
        value = yaml.safe_load(event.value) if event.value[:1] in "+-0123456789" else None
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            continue
        try:
            as_written = float(event.value) == value
        except ValueError:
            as_written = False
        if not as_written:
            line = event.start_mark.line + 1 if event.start_mark else "?"
            raise ConfigError(
                f"{name} line {line}: {event.value} is {value:g} to YAML; expected a decimal "
                "number, or text in quotation marks"
            )


def check_text(text: str, name: str, empty: bool = True) -> None:
    """Refuse the text of a configuration that is not YAML, or says what hardly is meant.

    A key that stands twice, no keys at the top level, or a number that YAML reads as another; where
    not `empty`, also nothing at all, which Snakemake does not take. The error has `name` and line.
    """
    try:
        found = yaml.load(text, _UniqueKeys)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        line = f" line {mark.line + 1}" if mark else ""
        raise ConfigError(f"{name}{line}: {error.problem or 'not readable as YAML'}") from None
    except (*_CONVERSION, yaml.YAMLError, RecursionError) as error:
        # PyYAML lets the errors of its conversions through, such as those of the date 2024-13-45.
        reason = str(error).partition("\n")[0] or type(error).__name__
        raise ConfigError(f"{name}: not readable as YAML ({reason})") from None
    if not isinstance(found, Mapping) and (found is not None or not empty):
        raise ConfigError(f"{name}: expected keys at the top level, as run: mine")
    _refuse_other_bases(text, name)


def check_files(paths: Iterable[str | os.PathLike], empty: bool = True) -> None:
    """Refuse configuration files that cannot be read, or that `check_text` refuses."""
    for path in paths:
        try:
            text = Path(path).read_text("utf-8")
        except OSError as error:
            raise ConfigError(f"{path}: {error.strerror or error}") from None
        except UnicodeDecodeError as error:
            raise ConfigError(f"{path}: not UTF-8 text at byte {error.start}") from None
        check_text(text, str(path), empty)
