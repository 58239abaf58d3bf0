"""Rules of the house read off the sources, each with traps that its check must find.

What packages may import, what rules depend on, what a script takes of its inputs.
"""

import ast
import re
import sys
from pathlib import Path

import pytest
from code_rules import commands, imports

from yade_scripts.sources import sources

ROOT = Path(__file__).resolve().parents[2]
NAMES = [path.parent.name for path in ROOT.glob("workflow/studies/*/rules.smk")]
# outside packages that each may import, beside Python's own and what it stands on
MAY = {
    "smdof": {"numpy", "scipy"},
    "workflow/record_files": {"numpy"},
    "workflow/reference_solver": {"numpy", "scipy", "yade_scripts", "rocking"},
    "yade_scripts": {"numpy"},
    "workflow/studies": {
        *("numpy", "scipy", "pandas", "matplotlib", "yaml", "pytest"),
        *("jinja2", "markupsafe", "meshio", "weasyprint"),
        *("smdof", "record_files", "reference_solver", "yade_scripts", "rocking", "studies"),
    },
    "workflow/scripts": {
        *("numpy", "scipy", "pandas", "matplotlib"),
        *("smdof", "record_files", "yade_scripts", "rocking"),
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
        *("smdof", "record_files", "yade_scripts", "rocking"),
    },
}
# files that take more, and why
MORE = {
    "yade_scripts/__main__.py": {"studies"},  # commands of studies, see `commands`
    "yade_scripts/commands/check_yade.py": {"yade"},  # whether it is there
    "yade_scripts/commands/view.py": {"yade"},  # its window
    "workflow/scripts/studies/collapse.py": {"studies"},  # the module that its rule names
    "workflow/scripts/studies/table.py": {"studies"},
    "workflow/scripts/studies/figure.py": {"studies"},
    "workflow/rocking/runtime/warm.py": {"snakemake"},  # what it starts
    "workflow/rocking/runtime/made_of.py": {"snakemake"},  # what it tells which files are stale
    "workflow/rocking/start.py": {"snakemake"},  # what it starts
    "workflow/rocking/compile_ahead.py": {"snakemake", "reference_solver"},  # to be compiled
}


def imported(text):
    """Outermost packages that a source imports, also late, relative ones and texts left out."""
    found = {name.partition(".")[0] for name in imports(text)}
    return found - {"__main__", "", *sys.stdlib_module_names}


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
        taken = imported(path.read_text("utf-8")) - {Path(package).name}
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
        empty = {place / "__init__.py" for place in (own, own.parent, own.parent / "shared")}
        places = {one.parent for one in {*found} - empty} - {own.parent / "shared" / "yade"}
        assert places <= {path.parent}, path
        assert not any(imported(one.read_text("utf-8")) for one in empty), path


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("import yade.wrapper as w", {"yade"}),
        ("def late():\n    from rocking.records import load", {"rocking"}),
        ("import importlib\nimportlib.import_module('rocking.runs')", {"rocking"}),
        ("from importlib import import_module as i\nfrom . import own\nimport os.path", set()),
        ("from importlib import import_module as i\ni('rocking.runs')", {"rocking"}),
        ("import importlib as i\ni.import_module(name='rocking.runs')", {"rocking"}),
        ("__import__('rocking.runs')", {"rocking"}),
        ("import numpy as np, scipy.linalg", {"numpy", "scipy"}),
    ],
)
def test_the_check_of_imports_finds(text, names):
    assert imported(text) == names


FILES = {"os", "io", "pathlib", "shutil", "tempfile", "glob", "json", "csv", "yaml", "subprocess"}
OPENS = re.compile(
    r"open|load|loadtxt|genfromtxt|fromfile|memmap|save\w*|tofile|(read|write)_(text|bytes)"
)


def touches_files(text):
    """What a source does that reads or writes a file: modules, and calls by the names they have."""
    tree, found = ast.parse(text), set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found |= {one.name for one in node.names if one.name.partition(".")[0] in FILES}
        elif isinstance(node, ast.ImportFrom) and (node.module or "").partition(".")[0] in FILES:
            found.add(node.module)
        elif isinstance(node, ast.Call):
            name = ast.unparse(node.func).rpartition(".")[2]
            found |= {name} if OPENS.fullmatch(name) else set()
    return found


def test_the_chain_s_library_knows_no_files():
    paths = sorted((ROOT / "smdof").rglob("*.py"))
    assert len(paths) > 3
    assert {path.name: found for path in paths if (found := touches_files(path.read_text()))} == {}


@pytest.mark.parametrize(
    "text",
    [
        *("def f(p): return open(p)", "from pathlib import Path", "import os.path as p"),
        *("import numpy as np\nnp.savetxt('a', x)", "def f(p): return p.read_text()"),
    ],
)
def test_the_check_of_files_finds(text):
    assert touches_files(text)


def bare(text):
    """Rules without their comments."""
    return re.sub(r"(?m)(^|(?<=\s))#.*$", "", text)


def rules(text):
    """Rules of a file as {name: (the one inherited from, text without comments)}, also nested."""
    found = {}
    for block in re.split(r"(?m)^(?=[ ]*(?:rule|checkpoint|use rule)\b)", bare(text)):
        head = re.match(r"[ ]*(?:rule|checkpoint|use rule)\b *(\w*)(?: as (\w+))?", block)
        if head:
            inherited = head[1] if head[2] else None
            found[head[2] or head[1] or f"without a name, {len(found)}"] = inherited, block
    return found


def started(block):
    """Commands of `yade_scripts` that a rule starts."""
    found = set()
    for command in commands(block):
        found |= set(re.findall(r"\{params\.yade\}\s+(\S+)", command or ""))
        found |= set(re.findall(r"yade_scripts\.commands\.(\w+)", command or ""))
        found |= set(re.findall(r"yade_scripts(?!\.commands)\S*\s+(\S+)", command or ""))
    return found


def depended_on(block):
    """Commands whose code is an input of a rule; None where it has no inputs of its own."""
    after = r"^ *(?:output|log|params|shell|run|script):|\Z"
    inputs = re.search(rf"(?ms)^ *input:\n(.*?)(?:{after})", block)
    return set(re.findall(r'command_code\("(\w+)"\)', inputs[1])) if inputs else None


def not_depended_on(text):
    """Commands that rules start and whose code is no input of theirs, by rule; how many start one.

    A rule that inherits from another starts what that one does, and what it has for inputs of its
    own takes the place of all that it would inherit.
    """
    every, found, count = rules(text), {}, 0
    for name, (above, block) in every.items():
        starts, stamped = started(block), depended_on(block)
        while above in every:
            above, block = every[above]
            starts |= started(block)
            stamped = depended_on(block) if stamped is None else stamped
        if missing := starts - (stamped or set()):
            found[name] = missing
        count += bool(starts)
    return found, count


def test_every_rule_depends_on_every_command_that_it_starts():
    paths = [*ROOT.glob("workflow/rules/*.smk"), *ROOT.glob("workflow/studies/*/*.smk")]
    found, count = not_depended_on("\n".join(path.read_text("utf-8") for path in paths))
    assert found == {}
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
        ("{params.yade} ida", "python3 -m yade_scripts.commands.walls", {"walls"}),
        ("{params.yade} ida", "{params.yade} {wildcards.command:q}", {"{wildcards.command:q}"}),
    ],
)
def test_the_check_of_commands_finds_what_no_input_stands_for(old, new, missing):
    assert old in STARTS
    assert not_depended_on(STARTS.replace(old, new))[0].get("a", set()) == missing


@pytest.mark.parametrize(
    ("inputs", "missing"),
    [
        ("", set()),
        ('    input:\n        modules=command_code("ida"),\n', set()),
        ('    input:\n        case="d",\n', {"ida"}),
    ],
)
def test_inputs_of_an_inherited_rule_stand_for_what_the_other_starts(inputs, missing):
    inherits = f'use rule a as b with:\n{inputs}    output:\n        "p",\n'
    again = inherits.replace("rule a as b", "rule b as c").replace(inputs, "")
    found, count = not_depended_on(f"{again}\n\n{inherits}\n\n{STARTS}")
    assert (found, count) == ({name: missing for name in "cb" if missing}, 3)


WHOLE = ("items", "values", "keys", "_allitems")
FILTERED = {"figure.py"}  # of studies: by name, without those that are not drawn


def takes_all(text):
    """Whether a script takes its inputs whole: beside its data every rule has its code there."""
    tree = ast.parse(text)
    held = {child: node for node in ast.walk(tree) for child in ast.iter_child_nodes(node)}
    every = [n for n in ast.walk(tree) if isinstance(n, ast.Attribute) and n.attr == "input"]
    every += [n for n in ast.walk(tree) if isinstance(n, ast.Call) and "input" in looked_up(n)]
    return any(whole(node, tree, held) for node in every)


def looked_up(call):
    """Name that `getattr` looks up, as a list."""
    if ast.unparse(call.func) != "getattr":
        return []
    return [one.value for one in call.args[1:2] if type_of(one) is str]


def whole(node, tree, held):
    """Whether what a node stands for is taken whole, and not one by its name."""
    above = held[node]
    if isinstance(above, ast.Attribute):
        return above.attr in WHOLE
    if isinstance(above, ast.Subscript) and above.value is node:
        if isinstance(above.slice, ast.Name):
            return above.slice.id in counted(tree)
        return type_of(above.slice) is not str
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


def counted(tree):
    """Names that a loop counts with: those of a `for` over `range` or `enumerate`."""
    loops = [n for n in ast.walk(tree) if isinstance(n, ast.For | ast.comprehension)]
    over = ("range", "enumerate")
    loops = [n for n in loops if isinstance(n.iter, ast.Call) and ast.unparse(n.iter.func) in over]
    first = [n.target.elts[0] if isinstance(n.target, ast.Tuple) else n.target for n in loops]
    return {ast.unparse(one) for one in first}


def test_no_script_takes_all_inputs_for_data():
    folders = [ROOT / "workflow/scripts", *ROOT.glob("workflow/studies/*/scripts")]
    scripts = sorted(path for folder in folders for path in folder.rglob("*.py"))
    assert len(scripts) > 15
    found = {path.name for path in scripts if takes_all(path.read_text("utf-8"))}
    assert found == FILTERED


@pytest.mark.parametrize(
    "line",
    [
        *("given = list(job.input)", "given = dict(job.input.items())", "given = {**job.input}"),
        *("first, *_ = job.input", "given = ' '.join(job.input)", "given = [*map(str, job.input)]"),
        *("for path in job.input:\n    print(path)", "given = job.input\nlist(given)"),
        *("given, p = job.input, job.params\nprint(*given)", "first = job.input[0]"),
        "p, given = job.params, job.input\nprint(*given)",
        "x = [p for p in snakemake.input.values()]",
        "given = list(getattr(job, 'input'))",
        "for i in range(3):\n    print(job.input[i])",
        "given = [job.input[i] for i, _ in enumerate(names)]",
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


def test_commands_of_make_that_the_page_names_inline_are_targets():
    text = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    targets = set(re.findall(r"(?m)^([\w-]+):", (ROOT / "Makefile").read_text("utf-8")))
    named = set(re.findall(r"(?:`|^)make ([a-z]\w*)", text, re.M))
    assert len(named) > 4
    assert named <= targets
