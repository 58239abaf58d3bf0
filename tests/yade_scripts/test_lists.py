"""Lists of names in messages: short, whatever they list, and one way everywhere."""

import ast
from pathlib import Path

import pytest
from code_rules import as_python

from yade_scripts.lists import LONGEST, MOST, listed, one_of

ROOT = Path(__file__).parents[2]
PACKAGES = {path.parent.name for path in ROOT.glob("*/__init__.py")} - {"tests"}
FOLDERS = sorted({*PACKAGES, "smdof", "tools", "workflow"})


def test_few_names_are_all_named_and_of_many_the_first():
    assert listed(["a"]) == "a"
    assert listed("abcdefgh") == "a, b, c, d, e, f, g, h"
    assert listed("abcdefghi") == "a, b, c, d, e, f, g, h and 1 more"
    assert listed([1, 2, 3], most=2) == "1, 2 and 1 more"


def test_however_many_and_however_long_it_is_one_short_line():
    names = [f"{'x' * 500}{k}" for k in range(20_000)]
    assert len(one_of(names, "y" * 5000)) < (LONGEST + 2) * MOST + 40
    assert listed(names).endswith("… and 19992 more")


def test_of_many_the_nearest_is_named():
    names = [f"R{k:05d}_NS" for k in range(5000)]
    assert one_of(names, "R01234_ns") == "did you mean 'R01234_NS'?"
    assert one_of(names, "elsewhere").startswith("expected one of R00000_NS, ")
    assert one_of(["pos", "neg"], "po") == "expected one of pos, neg"  # few: all


def _joined(node):
    """What a call `", ".join(…)` joins; None for anything else."""
    if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)):
        return None
    between = node.func.value
    comma = isinstance(between, ast.Constant) and between.value == ", "
    return node.args[0] if comma and node.func.attr == "join" else None


def _own(node):
    """Whether a name in capitals is joined, or what such a name holds: the code's own list."""
    if isinstance(node, (ast.Tuple, ast.List)):
        return all(map(_own, node.elts))
    if isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Slice) and node.slice.upper:
        return True  # the first of them
    if isinstance(node, (ast.Starred, ast.Subscript)):
        return _own(node.value)
    if isinstance(node, ast.Attribute):
        return node.attr.isupper()
    return isinstance(node, ast.Constant) or (isinstance(node, ast.Name) and node.id.isupper())


def _ends(node):
    """Whether a statement or call ends or warns with a message."""
    if isinstance(node, ast.Raise):
        return True
    called = node.func if isinstance(node, ast.Call) else None
    name = getattr(called, "id", getattr(called, "attr", ""))
    return name in ("stop", "exit", "SystemExit", "warn") or name.endswith("Error")


def unbounded(source):
    """Lines whose message joins a list that the code does not hold itself."""
    found = set()
    for function in ast.walk(ast.parse(source)):
        if not isinstance(function, (ast.Module, ast.FunctionDef)):
            continue
        names = {}
        for node in ast.walk(function):
            if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
                lists = filter(None, map(_joined, ast.walk(node.value)))
                for line in (one.lineno for one in lists if not _own(one)):
                    names[node.targets[0].id] = line
        for ending in filter(_ends, ast.walk(function)):
            for node in ast.walk(ending):
                inside = _joined(node)
                if inside is not None and not _own(inside):
                    found.add(inside.lineno)
                if isinstance(node, ast.Name) and node.id in names:
                    found.add(names[node.id])
    return sorted(found)


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("raise ValueError(f\"no {name}: {', '.join(names)}\")", [2]),
        ("known = ', '.join(cases)\n    stop(f'expected {known}')", [2]),
        ("stop(', '.join(sorted(there)))", [2]),
        ("raise ConfigError(', '.join(MEASURES))", []),
        ("return ', '.join(names)", []),
        ("stop(', '.join(names[:5]))", []),
        ("stop(', '.join(names[5:]))", [2]),
    ],
)
def test_the_rule_below_notices(text, lines):
    assert unbounded(f"def f():\n    {text}\n") == lines


def test_every_message_lists_names_by_the_helper():
    faults = []
    for path in (path for name in FOLDERS for path in (ROOT / name).rglob("*.*")):
        own = "tests" not in path.parts and not path.name.startswith("test_")
        if own and path.suffix in (".py", ".smk"):
            text = path.read_text("utf-8")
            found = unbounded(as_python(text) if path.suffix == ".smk" else text)
            faults += [f"{path.relative_to(ROOT)}:{line}" for line in found]
    assert not faults, "expected yade_scripts.lists.listed"
