"""How the house is built: sizes of functions, the way from a case to a scene, keys and rules."""

import ast
import re
import sys
from collections import defaultdict
from pathlib import Path

import pytest
from code_rules import TOPS
from rocking.collapse.case import Case
from rocking.configuration import schema
from rocking.configuration.config import resolve

from yade_scripts.model import models, registry, shape
from yade_scripts.model.facades import Facade
from yade_scripts.sources import PACKAGES

ROOT = Path(__file__).resolve().parents[2]
LONGEST, MOST = 60, 8  # lines of a function, its arguments
COMPILED = {"compiled", "inlined"}  # loops in which numba takes no objects
KEYS, RULES = 170, 90
CORE_LINES, FILE_LINES = 32_000, 400
ASIDE = {"record_files", "reference_solver", "studies"}  # rooms that a reader of the core passes
STOPS, CLIMBS = 12, 3
APART = {"tests", "trials", "__pycache__"}


def sources():
    """Files of the project that are no tests."""
    for top in (*TOPS, "docs"):
        for path in sorted((ROOT / top).rglob("*.py")):
            if not APART & {*path.parts} and not path.name.startswith("test_"):
                yield path


def is_compiled(node):
    names = {word for one in node.decorator_list for word in re.findall(r"\w+", ast.unparse(one))}
    return bool(COMPILED & names)


def faults(text):
    """Names of the functions that are too long or take too much; compiled loops left out."""
    for node in ast.walk(ast.parse(text)):
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) or is_compiled(node):
            continue
        given = node.args
        names = [one.arg for one in (*given.posonlyargs, *given.args, *given.kwonlyargs)]
        count = len(names) - (names[:1] in (["self"], ["cls"]))
        if node.end_lineno - node.lineno + 1 > LONGEST or count > MOST:
            yield node.name


def test_functions_are_short_and_take_little():
    found = [(path.name, name) for path in sources() for name in faults(path.read_text("utf-8"))]
    assert found == []


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("def long():\n" + "    x = 1\n" * 60, ["long"]),
        ("def fits():\n" + "    x = 1\n" * 59, []),
        ("def many(a, b, c, d, e, f, g, *, h, i): pass", ["many"]),
        ("class A:\n    def fits(self, a, b, c, d, e, f, g, h): pass", []),
        ("@compiled\ndef loop(a, b, c, d, e, f, g, h, i): pass", []),
    ],
)
def test_the_check_of_functions_finds(text, found):
    assert [*faults(text)] == found


def lines_of(paths):
    return {path: len(path.read_text("utf-8").splitlines()) for path in paths}


def test_the_core_is_short_enough_to_be_read():
    """What the main job and every study stand on, rules too, without the rooms beside it."""
    rules = [*ROOT.glob("workflow/rules/*.smk"), ROOT / "workflow/Snakefile", ROOT / "Snakefile"]
    core = [path for path in sources() if not ASIDE & {*path.relative_to(ROOT).parts[:2]}]
    core = [path for path in core if path.relative_to(ROOT).parts[0] != "docs"]
    total = sum(lines_of([*core, *rules, ROOT / "setup.py"]).values())
    assert 25_000 < total <= CORE_LINES


def test_no_file_is_long():
    tests = [*(ROOT / "tests").rglob("*.py"), *ROOT.glob("workflow/studies/**/*.py")]
    lengths = lines_of([*sources(), *ROOT.glob("workflow/**/*.smk"), *tests])
    assert {path.name: n for path, n in lengths.items() if n > FILE_LINES} == {}


def test_no_two_classes_have_one_name():
    places = defaultdict(list)
    for path in sources():
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.ClassDef):
                places[node.name].append(path.name)
    assert {name: where for name, where in places.items() if len(where) > 1} == {}


def carries(value):
    """Whether a value is a configuration, a case or a façade."""
    sections = isinstance(value, dict) and {"facade", "return_wall"} <= {*value}
    return sections or isinstance(value, Facade | Case)


def way(function):
    """What a function returns, the modules that it hands a configuration to, and its climbs.

    A climb is a call into a module that is at work already, from another one.
    """
    stops, climbs = [], []

    def follow(frame, event, _):
        module = frame.f_globals.get("__name__", "")
        if event != "call" or module.partition(".")[0] not in PACKAGES:
            return
        code = frame.f_code
        names = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
        names = names[1:] if names[:1] == ("self",) else names
        if not any(carries(frame.f_locals.get(name)) for name in names):
            return
        above, at = [], frame.f_back
        while at is not None:
            above.append(at.f_globals.get("__name__", ""))
            at = at.f_back
        stops.append(module)
        if module in above and above[0] != module:
            climbs.append((above[0], module))

    before = sys.getprofile()
    sys.setprofile(follow)
    try:
        return function(), list(dict.fromkeys(stops)), climbs
    finally:
        sys.setprofile(before)


@pytest.mark.filterwarnings("ignore:damping.law")
@pytest.mark.parametrize("model", registry.WITH_WALLS)
def test_a_configuration_comes_to_a_scene_by_few_modules_without_climbing(model):
    """From the resolved configuration to what YADE's bodies are made of, nothing known before."""
    shape._shape.cache_clear()
    resolved = resolve({"return_wall": {"building_mass_kg": 66000.0}})
    case, first, up = way(lambda: Case.chosen(resolved, model))
    scene, then, up_again = way(lambda: models.build_scene(case.sections))
    assert scene.blocks
    stops = list(dict.fromkeys(first + then))
    assert 5 < len(stops) <= STOPS, stops
    assert len(up + up_again) <= CLIMBS, up + up_again


def test_the_check_of_the_way_sees_a_climb():
    """`Case.varied` checks its façade by the configuration, which asks the model's shape."""
    case = Case.configured("W1")
    _, stops, _ = way(lambda: case.varied({"facade.height_m": 5.0}))
    assert "rocking.configuration.facade" in stops


def test_keys_and_rules_of_the_core_are_few():
    keys = [
        path
        for _, file in schema.files()
        if file.parent == schema.FOLDER
        for path, _ in schema.leaves(schema.read(file))
    ]
    assert 100 < len(keys) <= KEYS
    files = [ROOT / "Snakefile", ROOT / "workflow/Snakefile", *ROOT.glob("workflow/rules/*.smk")]
    text = "\n".join(path.read_text("utf-8") for path in files)
    rules = re.findall(r"(?m)^ *(?:rule \w+:|checkpoint \w+:|use rule )", text)
    assert 20 < len(rules) <= RULES
