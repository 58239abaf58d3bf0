"""Code compares keys, never sentences: one edited sentence must not change what is computed."""

import ast
import re
from pathlib import Path

import pytest
from code_rules import TOPS, as_python

ROOT = Path(__file__).resolve().parents[2]
ASIDE = {"tests", "trials"}
LEAST = 4  # words that make a sentence; a value of a table's column has three at most
OF_TEXT = {"startswith", "endswith", "removeprefix", "removesuffix", "partition", "rpartition"}
OF_TEXT |= {"split", "replace", "contains", "find", "index", "match", "fullmatch", "search"}
OF_TEXT |= {"rsplit", "rfind", "rindex", "count", "sub", "findall", "finditer", "compile"}
OF_TEXT |= {"isin", "eq", "ne", "get"}
EDITED = {"startswith", "endswith", "replace", "find", "index"}  # not of a caught error's text
# what others write: readers of records, Snakemake's messages
OTHERS = (
    "workflow/record_files/",
    "workflow/rocking/runtime/terminal.py",
    "tools/lint_workflow.py",
)


def texts(node):
    """Texts that stand in a node, also in a tuple, a list, a formatted text or a pattern."""
    return [one.value for one in ast.walk(node) if isinstance(getattr(one, "value", None), str)]


def is_sentence(text, least=LEAST):
    return sum(any(c.isalpha() for c in word) for word in text.split()) >= least


def begins_a_sentence(text):
    """Whether a text is part of one: looked for in others, it may be a word shorter."""
    return is_sentence(text, LEAST - 1)


def in_words(pattern):
    """Whether a pattern spells a sentence out."""
    return sum(bool(re.fullmatch(r"[A-Za-z,.'-]+", word)) for word in pattern.split()) >= LEAST


def caught_text(node, caught, said=frozenset()):
    """Whether a node is the text of a caught error, `str(error)`, or a name in `said` for one."""
    if isinstance(node, ast.JoinedStr):
        parts = [one.value for one in node.values if isinstance(one, ast.FormattedValue)]
        return len(node.values) == len(parts) == 1 and getattr(parts[0], "id", "") in caught
    if isinstance(node, ast.Subscript | ast.Attribute):
        inner = node.value
        return (
            getattr(node, "attr", "") == "args" and getattr(inner, "id", "") in caught
        ) or caught_text(inner, caught)
    if isinstance(node, ast.Name):
        return node.id in said
    return (
        isinstance(node, ast.Call)
        and isinstance(node.func, ast.Name)
        and node.func.id in ("str", "repr")
        and len(node.args) == 1
        and isinstance(node.args[0], ast.Name)
        and node.args[0].id in caught
    )


WRITTEN = ast.Constant | ast.Tuple | ast.List | ast.Set | ast.JoinedStr


def named(tree):
    """Names that a module gives to what has a sentence in it."""
    found = set()
    for node in tree.body:
        given = isinstance(node, ast.Assign) and isinstance(node.value, WRITTEN)
        if given and any(map(is_sentence, texts(node.value))):
            found |= {one.id for one in node.targets if isinstance(one, ast.Name)}
    return found


def faults(source):
    """Lines on which a sentence is compared with, or the text of an error is looked into."""
    tree = ast.parse(source)
    handlers = [node for node in ast.walk(tree) if isinstance(node, ast.ExceptHandler)]
    caught = {handler.name for handler in handlers if handler.name}
    constants = named(tree)
    said = {
        node.targets[0].id
        for node in ast.walk(tree)
        if isinstance(node, ast.Assign)
        and isinstance(node.targets[0], ast.Name)
        and caught_text(node.value, caught)
    }
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare):
            sides = [node.left, *node.comparators]
            alike = [side for side in sides if isinstance(side, WRITTEN)]
            if any(is_sentence(text) for side in alike for text in texts(side)):
                found.add(node.lineno)
            if any(isinstance(side, ast.Name) and side.id in constants for side in sides):
                found.add(node.lineno)
            if any(caught_text(side, caught, said) for side in sides):
                found.add(node.lineno)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            judged = in_words if node.func.attr == "compile" else is_sentence
            judged = begins_a_sentence if node.func.attr in EDITED else judged
            if node.func.attr in OF_TEXT and any(map(judged, texts_of_first(node))):
                found.add(node.lineno)
            if node.func.attr in EDITED and caught_text(node.func.value, caught, said):
                found.add(node.lineno)
        of = node.value if isinstance(node, ast.Subscript | ast.Attribute) else None
        keys = of.keys if isinstance(of, ast.Dict) else []
        if any(is_sentence(text) for key in keys if key for text in texts(key)):
            found.add(node.lineno)
        if isinstance(node, ast.match_case) and any(map(is_sentence, texts(node.pattern))):
            found.add(node.pattern.lineno)
    return sorted(found)


def texts_of_first(call):
    """Texts of the first argument; of functions of `operator` those of both."""
    of_both = isinstance(call.func.value, ast.Name) and call.func.value.id == "operator"
    return [text for one in call.args[: 2 if of_both else 1] for text in texts(one)]


def in_tags(template):
    """Sentences within the tags of a template, and in conditions of what it prints."""
    tags = re.findall(r"(?s)\{%(.*?)%\}", template)
    for printed in re.findall(r"(?s)\{\{(.*?)\}\}", template):
        tags += re.findall(r"(?s)\bif\b(.*?)(?:\belse\b|\Z)", printed)
    return [
        text for tag in tags for _, text in re.findall(r"(['\"])(.*?)\1", tag) if is_sentence(text)
    ]


def test_no_rule_and_no_template_does_either():
    rules = [ROOT / "Snakefile", ROOT / "workflow/Snakefile", *(ROOT / "workflow").rglob("*.smk")]
    assert len(rules) > 15
    found = {path.name: faults(as_python(path.read_text("utf-8"))) for path in rules}
    folder = ROOT / "workflow"
    pages = [path for kind in ("html", "rst", "j2") for path in folder.rglob(f"*.{kind}")]
    assert len(pages) > 5
    found |= {path.name: in_tags(path.read_text("utf-8")) for path in pages}
    assert {name: lines for name, lines in found.items() if lines} == {}
    assert in_tags("{% if said == 'it does not stand' %}")
    assert in_tags("{% if said\n == 'it does not stand' %}")
    assert in_tags("{{ 'a' if said == 'it does not stand' else 'b' }}")
    assert in_tags("{{ 'it does not stand' if a else 'it stands on its base' }}") == []
    assert in_tags("{% if said == 'met' %}it does not stand{% endif %}") == []


def test_no_code_compares_with_a_sentence():
    found, count = [], 0
    for top in TOPS:
        for path in sorted((ROOT / top).rglob("*.py")):
            name = path.relative_to(ROOT).as_posix()
            if path.name.startswith("test_") or ASIDE & {*path.parts} or name.startswith(OTHERS):
                continue
            count += 1
            found += [f"{name}:{line}" for line in faults(path.read_text("utf-8"))]
    assert count > 200
    assert found == []


@pytest.mark.parametrize(
    "source",
    [
        "if reason.endswith('for a wall that rocks'): pass",
        "if said == 'it does not stand': pass",
        "if 'falls by its own weight' in said: pass",
        "if said in ('met', 'not met in time'): pass",
        "table['claim'].str.startswith('the periods of both')",
        "said.startswith('The façade passes')",
        "match said:\n    case 'it does not stand': pass",
        "try: f()\nexcept ValueError as error: g(str(error).replace('a', 'b'))",
        "try: f()\nexcept ValueError as error:\n    if 'x' in str(error): pass",
        "try: f()\nexcept ValueError as error:\n    if 'x' in repr(error): pass",
        "if said in {'met', 'it does not stand'}: pass",
        "if said in ['met', 'it does not stand']: pass",
        "NOT = 'it does not stand'\nif said == NOT: pass",
        "ALL = ('met', 'it does not stand')\nif said not in ALL: pass",
        "if said == f'it does not stand {x}': pass",
        "a = {'it does not stand': 1}.get(said)",
        "a = {'it does not stand': 1}[said]",
        "a = lines.get('it does not stand')",
        "import re\nP = re.compile('it does not stand')",
        "table[table['said'].isin(['it does not stand'])]",
        "import operator\noperator.eq(said, 'it does not stand')",
        "try: f()\nexcept ValueError as error:\n    if 'x' in error.args[0]: pass",
        "try: f()\nexcept ValueError as error:\n    if 'x' in f'{error}': pass",
        "try: f()\nexcept ValueError as error:\n    said = str(error)\n    if 'x' in said: pass",
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
        "try: f()\nexcept ValueError as error: print(f'a: {error}')",
        "SAID = 'it does not stand'\nprint(SAID)",
        "words = {'not_met': 'it does not stand'}",
    ],
)
def test_the_check_leaves(source):
    assert faults(source) == []
