"""Rules of the house read off the sources, each with traps that its check must find.

What packages may import, what rules depend on, what a script takes of its inputs.
"""

import ast
import re
import sys
from pathlib import Path

import pytest
import yaml
from code_rules import commands
from rocking.configuration import config

from yade_scripts.sources import sources

ROOT = Path(__file__).resolve().parents[2]
NAMES = [path.parent.name for path in ROOT.glob("workflow/studies/*/rules.smk")]
# outside packages that each may import, beside Python's own and what it stands on
MAY = {
    "smdof": {"numpy", "scipy"},
    "yade_scripts": {"numpy"},
    "workflow/studies": {
        *("numpy", "scipy", "pandas", "matplotlib", "yaml", "pytest"),
        *("jinja2", "markupsafe", "meshio", "weasyprint"),
        *("smdof", "yade_scripts", "rocking", "studies"),
    },
    "workflow/rocking": {
        *(
            "numpy",
            "scipy",
            "pandas",
            "numba",
            "llvmlite",
            "yaml",
            "jsonschema",
            "matplotlib",
            "PIL",
        ),
        *("pygments",),
        *("smdof", "yade_scripts", "rocking"),
    },
}
# files that take more, and why
MORE = {
    "yade_scripts/__main__.py": {"studies"},  # commands of studies, see `commands`
    "yade_scripts/commands/check_yade.py": {"yade"},  # whether it is there
    "yade_scripts/commands/view.py": {"yade"},  # its window
    "workflow/rocking/runtime/warm.py": {"snakemake"},  # what it starts
    "workflow/rocking/runtime/made_of.py": {"snakemake"},  # what it tells which files are stale
    "workflow/rocking/start.py": {"snakemake"},  # what it starts
    "workflow/rocking/compile_ahead.py": {"snakemake"},  # loaded once, to be compiled
}


def imported(text):
    """Outermost packages that a source imports, also late, relative ones and texts left out."""
    found = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            found |= {alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and not node.level:
            found.add(node.module.partition(".")[0])
        elif isinstance(node, ast.Call) and ast.unparse(node.func).endswith("import_module"):
            found |= {w.value.partition(".")[0] for w in ast.walk(node) if type_of(w) is str}
    return {name for name in found if name not in {"__main__", "", *sys.stdlib_module_names}}


def type_of(node):
    return type(getattr(node, "value", None)) if isinstance(node, ast.Constant) else None


@pytest.mark.parametrize("package", MAY)
def test_a_package_imports_what_it_may_and_no_more(package):
    """The chain's library knows no project, what runs in YADE only numpy; the engine has YADE."""
    seen = set()
    for path in sorted((ROOT / package).rglob("*.py")):
        if path.name.startswith("test_") or {"tests", "trials"} & {*path.parts}:
            continue
        name = path.relative_to(ROOT).as_posix()
        more = MORE.get(name, set()) | ({"yade"} if "yade_scripts/engine/" in name else set())
        taken = imported(path.read_text("utf-8")) - {package}
        assert taken <= MAY[package] | more, f"{name}: {taken - MAY[package] - more}"
        assert MORE.get(name, set()) <= taken, f"{name}: no more taken"
        seen |= taken
    assert seen & MAY[package] or package == "workflow/studies"  # of which there may be none


def test_what_a_study_runs_in_yade_stands_on_numpy_and_yade_scripts_alone():
    paths = sorted(ROOT.glob("workflow/studies/*/yade/*.py"))
    assert len(paths) > 4 or not NAMES
    for path in paths:
        assert imported(path.read_text("utf-8")) <= {"numpy", "yade_scripts", "studies"}, path
        own = path.parent.parent
        found = [one for one in sources(path) if ROOT / "yade_scripts" not in one.parents]
        empty = {own / "__init__.py", own.parent / "__init__.py"}
        assert {one.parent for one in {*found} - empty} == {path.parent}, path
        assert not any(imported(one.read_text("utf-8")) for one in empty), path


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("import yade.wrapper as w", {"yade"}),
        ("def late():\n    from rocking.records import load", {"rocking"}),
        ("import importlib\nimportlib.import_module('rocking.risk')", {"rocking"}),
        ("from importlib import import_module as i\nfrom . import own\nimport os.path", set()),
        ("import numpy as np, scipy.linalg", {"numpy", "scipy"}),
    ],
)
def test_the_check_of_imports_finds(text, names):
    assert imported(text) == names


def bare(text):
    """Rules without their comments."""
    return re.sub(r"(?m)(^|(?<=\s))#.*$", "", text)


def rules(text):
    """Rules of a file as (name, text without comments), also nested, inherited and checkpoints."""
    blocks = re.split(r"(?m)^(?=[ ]*(?:rule|checkpoint|use rule)\b)", bare(text))
    for block in blocks:
        head = re.match(r"[ ]*(?:rule|checkpoint|use rule)\s*(\w*)", block)
        if head:
            yield head[1], block


def not_depended_on(block):
    """Commands of `yade_scripts` that a rule starts, and those whose code is no input of it."""
    block = bare(block)
    inputs = re.search(r"(?ms)^ *input:\n(.*?)^ *(?:output|log|params|shell|run|script):", block)
    stamped = set(re.findall(r'command_code\("(\w+)"\)', inputs[1] if inputs else ""))
    started = set()
    for command in commands(block):
        started |= set(re.findall(r"\{params\.yade\}\s+(\w+)", command or ""))
        started |= set(re.findall(r"yade_scripts\S*\s+(\w+)", command or ""))
    return started, started - stamped


def test_every_rule_depends_on_every_command_that_it_starts():
    count = 0
    for path in [*ROOT.glob("workflow/rules/*.smk"), *ROOT.glob("workflow/studies/*/*.smk")]:
        for name, block in rules(path.read_text("utf-8")):
            if "use rule" in block.split("\n")[0]:
                continue
            started, missing = not_depended_on(block)
            assert not missing, f"{path.name}: rule {name} starts {missing}"
            count += len(started)
    assert count > 5


STARTS = """rule a:
    input:
        case="c",
        modules=command_code("ida"),
    output:
        "o",
    shell:
        "{params.yade} ida {input.case:q}"
"""
AMONG_OUTPUTS = 'd="d",\n    output:\n        command_code("ida"),'


@pytest.mark.parametrize(
    ("old", "new", "missing"),
    [
        ("a", "a", set()),
        ('        modules=command_code("ida"),\n', "", {"ida"}),
        ("        modules=", "        # modules=", {"ida"}),
        ('modules=command_code("ida"),\n    output:\n        "o",', AMONG_OUTPUTS, {"ida"}),
        ("{input.case:q}", "{input.case:q} && {params.yade} pushover", {"pushover"}),
        ("{params.yade} ida", "/usr/bin/python3 -m yade_scripts walls", {"walls"}),
    ],
)
def test_the_check_of_commands_finds_what_no_input_stands_for(old, new, missing):
    assert old in STARTS
    assert not_depended_on(STARTS.replace(old, new))[1] == missing


WHOLE = ("items", "values", "keys", "_allitems")
FILTERED = {"figure.py"}  # of studies: by name, without those that are not drawn


def takes_all(text):
    """Whether a script takes its inputs whole: beside its data every rule has its code there."""
    tree = ast.parse(text)
    held = {child: node for node in ast.walk(tree) for child in ast.iter_child_nodes(node)}
    every = [n for n in ast.walk(tree) if isinstance(n, ast.Attribute) and n.attr == "input"]
    return any(whole(node, tree, held) for node in every)


def whole(node, tree, held):
    """Whether what a node stands for is taken whole, and not one by its name."""
    above = held[node]
    if isinstance(above, ast.Attribute):
        return above.attr in WHOLE
    if isinstance(above, ast.Subscript) and above.value is node:
        return not isinstance(above.slice, ast.Name) and type_of(above.slice) is not str
    if isinstance(above, ast.Call) and ast.unparse(above.func) == "getattr":
        return False
    target = None
    if isinstance(above, ast.Assign):
        target = above.targets[0]
    elif isinstance(above, ast.Tuple) and isinstance(held[above], ast.Assign):
        target = held[above].targets[0]
        if isinstance(target, ast.Tuple):
            target = target.elts[above.elts.index(node)]
    if not isinstance(target, ast.Name):
        return True
    names = [n for n in ast.walk(tree) if isinstance(n, ast.Name) and n.id == target.id]
    return any(whole(n, tree, held) for n in names if isinstance(n.ctx, ast.Load))


def test_no_script_takes_all_inputs_for_data():
    folders = [ROOT / "workflow/scripts", *ROOT.glob("workflow/studies/*/scripts")]
    scripts = sorted(path for folder in folders for path in folder.rglob("*.py"))
    assert len(scripts) > 30
    found = {path.name for path in scripts if takes_all(path.read_text("utf-8"))}
    assert found == FILTERED


@pytest.mark.parametrize(
    "line",
    [
        *("given = list(job.input)", "given = dict(job.input.items())", "given = {**job.input}"),
        *("first, *_ = job.input", "given = ' '.join(job.input)", "given = [*map(str, job.input)]"),
        *("for path in job.input:\n    print(path)", "given = job.input\nlist(given)"),
        *("given, p = job.input, job.params\nprint(*given)", "first = job.input[0]"),
        "x = [p for p in snakemake.input.values()]",
    ],
)
def test_the_check_of_inputs_finds(line):
    assert takes_all(line)


@pytest.mark.parametrize(
    "line",
    ["a = job.input.table", "a = getattr(job.input, 'b', None)", "g, p = job.input, 1\ng.table"],
)
def test_the_check_of_inputs_leaves(line):
    assert not takes_all(line)


def installed(text):
    """Installations of a shell script: the words of each, comments left out."""
    text = re.sub(r"(?m)(^|\s)#.*$", "", text)
    named = dict(re.findall(r'(?m)^ *(\w+)="([^"]*pip install[^"]*)"', text))
    for name, value in named.items():
        text = text.replace(f"${name} ", f"{value} ")
    return [
        line
        for line in text.splitlines()
        if re.search(r"\bpip3? install\b", line) and '="' not in line
    ]


def test_setup_installs_by_hash_or_nothing_from_elsewhere():
    text = (ROOT / "tools/setup.sh").read_text("utf-8")
    locks = re.findall(r"\block=(\S+)", text)
    assert locks == ["requirements.lock", "requirements-all.lock"]
    found = installed(text)
    assert len(found) == 3
    for line in found:
        own = "--no-deps" in line and line.rstrip().endswith("--editable .")
        held = "--require-hashes " in line and line.rstrip().endswith((".lock", " $lock"))
        assert own or held, line


def test_everything_that_ci_uses_is_named_by_its_commit():
    """Read as YAML, at any depth and however it is quoted."""

    def used(node):
        if isinstance(node, dict):
            for key, value in node.items():
                if key == "uses":
                    yield value
                else:
                    yield from used(value)
        elif isinstance(node, list):
            for value in node:
                yield from used(value)

    files = sorted((ROOT / ".github").rglob("*.y*ml"))
    found = [one for path in files for one in used(yaml.safe_load(path.read_text("utf-8")))]
    assert found
    assert [one for one in found if not re.fullmatch(r"[\w/.-]+@[0-9a-f]{40}", one)] == []


def test_commands_of_make_that_the_page_names_inline_are_targets():
    text = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    targets = set(re.findall(r"(?m)^([\w-]+):", (ROOT / "Makefile").read_text("utf-8")))
    named = set(re.findall(r"(?:`|^)make ([a-z]\w*)", text, re.M))
    assert len(named) > 4
    assert named <= targets


@pytest.mark.parametrize("name", ["../up", "a/b", "", ".hidden", "-rf", "a b", "$(x)", "..", "a\n"])
@pytest.mark.parametrize(
    "given",
    [
        lambda name: {"compare": [name]},
        lambda name: {"building": {"wme_records": [name]}},
        lambda name: {"building": {"explicit_records": [name]}},
        lambda name: {"complete": {"check_record": name}},
    ],
)
def test_a_name_that_becomes_part_of_a_path_is_refused(given, name):
    with pytest.raises(config.ConfigError) as caught:
        config.expand_scenarios(given(name))
    assert str(caught.value).isprintable()
