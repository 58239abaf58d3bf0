"""Code compares keys, never sentences: one edited sentence must not change what is computed."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TOPS = ("smdof", "yade_scripts", "workflow", "tools")
ASIDE = {"tests", "trials"}
LEAST = 4  # words that make a sentence; a value of a table's column has three at most
OF_TEXT = {"startswith", "endswith", "removeprefix", "removesuffix", "partition", "rpartition"}
OF_TEXT |= {"split", "replace", "contains", "find", "index", "match", "fullmatch", "search"}
EDITED = {"startswith", "endswith", "replace", "find", "index"}  # not of a caught error's text
# what others write: readers of records, Snakemake's messages
OTHERS = ("workflow/rocking/records/formats/", "workflow/rocking/runtime/terminal.py")


def texts(node):
    """Texts that stand in a node, also in a tuple, a list or a pattern."""
    return [one.value for one in ast.walk(node) if isinstance(getattr(one, "value", None), str)]


def is_sentence(text):
    return sum(any(c.isalpha() for c in word) for word in text.split()) >= LEAST


def caught_text(node, caught):
    """Whether a node is the text of an error that was caught: `str(error)`."""
    return (
        isinstance(node, ast.Call)
        and isinstance(node.func, ast.Name)
        and node.func.id == "str"
        and len(node.args) == 1
        and isinstance(node.args[0], ast.Name)
        and node.args[0].id in caught
    )


def faults(source):
    """Lines on which a sentence is compared with, or the text of an error is looked into."""
    tree = ast.parse(source)
    handlers = [node for node in ast.walk(tree) if isinstance(node, ast.ExceptHandler)]
    caught = {handler.name for handler in handlers if handler.name}
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare):
            sides = [node.left, *node.comparators]
            alike = [
                side for side in sides if isinstance(side, ast.Constant | ast.Tuple | ast.List)
            ]
            if any(is_sentence(text) for side in alike for text in texts(side)):
                found.add(node.lineno)
            if any(caught_text(side, caught) for side in sides):
                found.add(node.lineno)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            if node.func.attr in OF_TEXT and any(map(is_sentence, texts_of_first(node))):
                found.add(node.lineno)
            if node.func.attr in EDITED and caught_text(node.func.value, caught):
                found.add(node.lineno)
        if isinstance(node, ast.match_case) and any(map(is_sentence, texts(node.pattern))):
            found.add(node.pattern.lineno)
    return sorted(found)


def texts_of_first(call):
    return texts(call.args[0]) if call.args else []


def test_no_code_compares_with_a_sentence():
    found, count = [], 0
    for top in TOPS:
        for path in sorted((ROOT / top).rglob("*.py")):
            name = path.relative_to(ROOT).as_posix()
            if path.name.startswith("test_") or ASIDE & {*path.parts} or name.startswith(OTHERS):
                continue
            count += 1
            found += [f"{name}:{line}" for line in faults(path.read_text("utf-8"))]
    assert count > 350
    assert found == []


@pytest.mark.parametrize(
    "source",
    [
        "if reason.endswith('for a wall that rocks'): pass",
        "if said == 'it does not stand': pass",
        "if 'falls by its own weight' in said: pass",
        "if said in ('met', 'not met in time'): pass",
        "table['claim'].str.startswith('the periods of both')",
        "match said:\n    case 'it does not stand': pass",
        "try: f()\nexcept ValueError as error: g(str(error).replace('a', 'b'))",
        "try: f()\nexcept ValueError as error:\n    if 'x' in str(error): pass",
    ],
)
def test_the_check_finds(source):
    assert faults(source)


@pytest.mark.parametrize(
    "source",
    [
        "if kind == 'not_met': pass",
        "if name.startswith('return wall'): pass",
        "raise ValueError('it does not stand on its base')",
        "said = 'it stands' if stands else 'it does not stand'",
        "try: f()\nexcept ValueError as error: raise Other(str(error)) from None",
    ],
)
def test_the_check_leaves(source):
    assert faults(source) == []
