"""Configuration files: the resolved one beside a run's results, stricter reading of users' own."""

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import yaml

from rocking.configuration.differences import flat
from rocking.configuration.schema import MAX_VALUES, ConfigError
from yade_scripts.files import write_atomic
from yade_scripts.lists import listed


def write_resolved(resolved: Mapping, path: str | os.PathLike, chosen: Iterable[str] = ()) -> None:
    """Write a resolved configuration as YAML that can be given back with `--configfile`.

    What null stands for is said at the end in comments, the lines of `chosen`. The file is replaced
    at once, and left alone where it already says the same. ConfigError where a folder stands there.
    """
    target = Path(path)
    if target.is_dir():
        raise ConfigError(f"{target} is a folder: a run's settings are written there; move it away")
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
    changes = [f"{key} {_shown(before[key])} → {_shown(now[key])}" for key in keys]
    return (
        f"run {resolved['run']} gets other settings than its results have: "
        f"{listed(changes, SHOWN_CHANGES)}; what depends on them is made again "
        "(run=<another name> keeps both)"
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


MAX_BYTES = 250_000  # PyYAML takes seconds for it; MAX_VALUES values are no more
MAX_NODES = 3 * MAX_VALUES  # keys, values, lists and sections, those of aliases each time
MAX_NUMBER = 64  # characters
NO_FILE = "neither a file nor a link to one; expected a configuration"  # a pipe is read once
TEMPLATE = "__use_yte__"  # with it Snakemake runs expressions of the file as Python
_NUMBERS = ("tag:yaml.org,2002:int", "tag:yaml.org,2002:float")


def _refuse_growth(node, name):
    """Refuse what aliases let grow beyond all measure, or without end.

    A merge (`<<`) copies what an alias stands for; nine aliases of nine aliases, and so on, make
    millions of values of 500 bytes. Here each is counted once, and what it stands for multiplied.
    """
    sizes: dict[int, int | None] = {}

    def size(branch):
        if id(branch) not in sizes:
            sizes[id(branch)] = None
            parts = branch.value if isinstance(branch, yaml.CollectionNode) else ()
            pairs = isinstance(branch, yaml.MappingNode)
            inner = [part for pair in parts for part in pair] if pairs else parts
            sizes[id(branch)] = 1 + sum(map(size, inner))
        if (known := sizes[id(branch)]) is None:
            raise ConfigError(f"{name} line {branch.start_mark.line + 1}: stands within itself")
        return known

    if (total := size(node)) > MAX_NODES:
        raise ConfigError(f"{name}: {total:.4g} values with all aliases; expected {MAX_NODES}")


def _numbers(node):
    """Numbers below a node that are written without quotation marks, each once."""
    todo, seen = [node], set()
    while todo:
        branch = todo.pop()
        if id(branch) in seen:
            continue
        seen.add(id(branch))
        if isinstance(branch, yaml.MappingNode):
            todo.extend(part for pair in reversed(branch.value) for part in reversed(pair))
        elif isinstance(branch, yaml.SequenceNode):
            todo.extend(reversed(branch.value))
        elif branch.tag in _NUMBERS and branch.style is None:
            yield branch


def _refuse_long_numbers(node, name):
    """Refuse a number of thousands of digits, before it is read."""
    for number in _numbers(node):
        if len(number.value) > MAX_NUMBER:
            raise ConfigError(
                f"{name} line {number.start_mark.line + 1}: a number of {len(number.value)} "
                f"characters; expected at most {MAX_NUMBER}"
            )


def _refuse_other_bases(node, name):
    """Refuse a number that YAML reads as another: 010 is 8, 1:30 is 90, 0x10 is 16."""
    for number in _numbers(node):
        value = yaml.safe_load(number.value) if number.value[:1] in "+-0123456789" else None
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            continue
        try:
            as_written = float(number.value) == value
        except ValueError:
            as_written = False
        if not as_written:
            shown = f"{float(value):g}"
            raise ConfigError(
                f"{name} line {number.start_mark.line + 1}: {number.value} is {shown} to YAML; "
                "expected a decimal number, or text in quotation marks"
            )


def _asks_for_template(node):
    """Whether a mapping, or one that is merged into it, has the key, whatever its tag."""
    for key, value in node.value if isinstance(node, yaml.MappingNode) else ():
        if key.value == TEMPLATE:
            return True
        merged = value.value if isinstance(value, yaml.SequenceNode) else [value]
        if key.value == "<<" and any(map(_asks_for_template, merged)):
            return True
    return False


def _refuse_template(node, name):
    """Refuse a file that asks for what Snakemake calls a template, whatever it says of it."""
    if _asks_for_template(node):
        raise ConfigError(f"{name}: {TEMPLATE} would run code of the file; expected plain values")


def _loaded(text: str, name: str):
    """Content and node of a text that neither runs code nor stalls; ConfigError of any other."""
    if (size := len(text.encode("utf-8", "surrogatepass"))) > MAX_BYTES:
        raise ConfigError(f"{name}: {size} bytes; expected at most {MAX_BYTES} of a configuration")
    loader = None
    try:
        loader = _UniqueKeys(text)
        if (node := loader.get_single_node()) is None:
            return None, None
        _refuse_growth(node, name)
        _refuse_long_numbers(node, name)
        _refuse_template(node, name)
        return loader.construct_document(node), node
    except ConfigError:
        raise
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        line = f" line {mark.line + 1}" if mark else ""
        raise ConfigError(f"{name}{line}: {error.problem or 'not readable as YAML'}") from None
    except (*_CONVERSION, yaml.YAMLError, RecursionError) as error:
        # PyYAML lets the errors of its conversions through, such as those of the date 2024-13-45.
        reason = str(error).partition("\n")[0] or type(error).__name__
        raise ConfigError(f"{name}: not readable as YAML ({reason})") from None
    finally:
        if loader:
            loader.dispose()


def check_text(text: str, name: str, empty: bool = True) -> None:
    """Refuse the text of a configuration that is not YAML, or says what hardly is meant.

    One that runs code or stalls, a key that stands twice, no keys at the top level, or a number
    that YAML reads as another; where not `empty`, also nothing at all, which Snakemake does not
    take. The error has `name` and line.
    """
    content, node = _loaded(text, name)
    if not isinstance(content, Mapping) and (content is not None or not empty):
        raise ConfigError(f"{name}: expected keys at the top level, as run: mine")
    if node is not None:
        _refuse_other_bases(node, name)


def check_inline(text: str, name: str) -> None:
    """Refuse a value of a command line that is no YAML, grows, or has a key that stands twice."""
    _loaded(text, name)


def read_text(path: str | os.PathLike) -> str:
    """Text of a configuration file, of which no more is read than one may have; ConfigError."""
    if os.path.exists(path) and not os.path.isfile(path) and not os.path.isdir(path):
        raise ConfigError(f"{path}: {NO_FILE}")
    try:
        with open(path, "rb") as handle:
            data = handle.read(MAX_BYTES + 1)
    except OSError as error:
        raise ConfigError(f"{path}: {error.strerror or error}") from None
    if len(data) > MAX_BYTES:
        raise ConfigError(f"{path}: larger than {MAX_BYTES} bytes; expected a configuration")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise ConfigError(f"{path}: not UTF-8 text at byte {error.start}") from None


def read_yaml(path: str | os.PathLike) -> Any:
    """Content of a YAML file of a user's, read as strictly as a configuration; ConfigError."""
    text = read_text(path)
    check_text(text, str(path))
    return _loaded(text, str(path))[0]


def check_files(paths: Iterable[str | os.PathLike], empty: bool = True) -> None:
    """Refuse configuration files that cannot be read, or that `check_text` refuses."""
    for path in paths:
        check_text(read_text(path), str(path), empty)


def refuse_harmful(path: str | os.PathLike) -> None:
    """Refuse a file that would run code in Snakemake's own reading of it, or let that stall.

    What else is wrong with it others say. ConfigError of one line.
    """
    try:
        text = read_text(path)
    except ConfigError:
        small = os.path.isfile(path) and os.path.getsize(path) <= MAX_BYTES
        if small or not os.path.exists(path) or os.path.isdir(path):
            return
        raise
    try:
        node = yaml.compose(text, yaml.SafeLoader)
        if node is None:
            return
        _refuse_growth(node, str(path))
        _refuse_long_numbers(node, str(path))
        _refuse_template(node, str(path))
    except ConfigError:
        raise
    except (*_CONVERSION, yaml.YAMLError, RecursionError):
        return
