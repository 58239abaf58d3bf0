"""Dependencies read from imports: they are what Python really loads, and every rule has them."""

import ast
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import forked
import pytest
from rocking.runtime import stamps

from yade_scripts import sources

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "workflow" / "scripts"
LOADED = """
import sys, types
sys.argv = ["x"]
import rocking.runtime.script as script
script.run = lambda main, namespace: None
before = set(sys.modules)
exec(compile(open({path!r}).read(), {path!r}, "exec"), {{"__name__": "script"}})
for name, module in sorted(sys.modules.items()):
    file = getattr(module, "__file__", None)
    if file and name.split(".")[0] in ("rocking", "smdof", "yade_scripts"):
        print(file)
"""
SCRIPTS_OF_RULES = f"""
import json
include: "{ROOT}/workflow/Snakefile"
for one in workflow.rules:
    if one.script:
        about = one.params.get("study"), one.input.modules({{}}), list(one.log)
        print(json.dumps([one.name, one.script, *about]))
"""


@pytest.mark.parametrize(
    "name", ["facade_case", "fig09_ida", "table_wme", "calibrate_law", "record"]
)
def test_sources_are_what_python_loads(name):
    """Two routes: the parsed imports, and the modules in memory after running the script."""
    (path,) = SCRIPTS.glob(f"*/{name}.py")
    done = subprocess.run(
        [sys.executable, "-c", LOADED.format(path=str(path))],
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    loaded = {Path(line) for line in done.stdout.split()}
    found = set(sources.sources(path))
    assert loaded <= found | set(sources.sources(ROOT / "workflow/rocking/runtime/script.py"))
    # imports inside functions are named too, though they may not have been loaded
    assert {p for p in found if p.suffix == ".py"} - loaded <= {path} | late(found)


def late(files):
    """Files that are imported inside functions only, and what those import."""
    out = set()
    for file in files:
        if file.suffix == ".py" and re.search(r"^    +(from|import) ", file.read_text(), re.M):
            for other in sources.imports(file):
                out.update(sources.sources(other))
    return out


@pytest.mark.slow
def test_every_rule_depends_on_the_script_it_runs(tmp_path):
    """The input `modules` stands for the script and the module it calls; there is a log."""
    shutil.copytree(ROOT / "config", tmp_path / "config")
    (tmp_path / "Snakefile").write_text(SCRIPTS_OF_RULES)
    done = forked.snakemake(tmp_path, "--list-rules", snakefile=None)
    assert done.returncode == 0, done.stderr
    told = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("[")]
    assert len(told) > 120
    for name, script, study, modules, log in told:
        called = [("studies", study)] if study else []
        wanted = [f"{folder}-{stem}" for folder, stem in [Path(script).parts[-2:], *called]]
        stamped = [Path(path).parent.name.removesuffix("-drawn") for path in modules]
        assert stamped == [word.removesuffix(".py") for word in wanted], name
        assert len(log) == 1, name


def test_every_script_lies_where_its_rule_looks_for_it():
    """Snakemake looks from the file of the rule; of one that inherits, from that file."""
    scripts, inherited = {}, []
    for path in sorted((ROOT / "workflow" / "rules").rglob("*.smk")):
        text = path.read_text("utf-8")
        for name, block in re.findall(r"(?ms)^rule (\w+):\n(.+?)(?=^\S|\Z)", text):
            if script := re.search(r'script:\n        "([^"{]+)"', block):
                scripts[name] = script[1]
                inherited.append((path, name, name))
        for script in re.findall(r'(?m)^figure_by\(\n    "(.+)"', text):
            assert (SCRIPTS / f"{script}.py").is_file(), f"{path.name}: {script}"
        inherited += [(path, *pair) for pair in re.findall(r"(?m)^use rule (\w+) as (\w+)", text)]
    assert len(scripts) > 80
    for path, base, name in inherited:
        if base in scripts:
            assert (path.parent / scripts[base]).is_file(), f"{path.name}: {name}"


def test_no_declared_rule_hides_the_function_that_its_job_calls():
    """A job runs inside the function that declares its rule, and calls `script` there."""
    text = (ROOT / "workflow/rules/declared.smk").read_text("utf-8")
    heads = re.findall(r"(?m)^def \w+\((.+)\):$", text)
    names = {re.match(r"\W*(\w+)", part)[1] for head in heads for part in head.split(", ")}
    assert "source" in names
    assert not names & {"script", "shell", "notebook", "wrapper"}


def test_a_reader_does_not_touch_the_runs_in_yade():
    """What inside YADE runs knows nothing of records, and a figure nothing of the engine."""
    ida = {p.name for p in sources.sources(ROOT / "yade_scripts/commands/ida.py")}
    assert "reader.py" not in ida
    assert {"adapter.py", "bonds.py", "stiffness.py", "registry.py"} <= ida
    assert "adapter.py" not in {
        p.name for p in sources.sources(SCRIPTS / "records/table_records.py")
    }


def test_what_draws_belongs_to_a_study_only_where_it_is_drawn():
    for name in ("rocking/studies/sequence", "rocking/studies/additions"):
        path = ROOT / f"workflow/{name}.py"
        whole, computed = (set(sources.sources(path, drawn)) for drawn in (True, False))
        assert path in computed
        assert {"style.py", "panels.py", "paper.mplstyle"} <= {p.name for p in whole - computed}
        assert {file.parent.name for file in whole - computed} == {"figures"}
        assert sources.digest(path) != sources.digest(path, drawn=False)
    figure = SCRIPTS / "studies/figure.py"
    assert "style.py" in {p.name for p in sources.sources(figure, drawn=False)}


@pytest.mark.parametrize("path", sorted((ROOT / "workflow/rocking/studies").glob("*.py")))
def test_a_study_computes_without_its_functions_that_draw(path):
    """What is left of it imports no figure, names none of them, and has all that computes."""
    whole, left = (ast.parse(t) for t in (path.read_text(), sources.computing(path.read_text())))
    names, kept = ({n.name for n in tree.body if hasattr(n, "name")} for tree in (whole, left))
    marked = {n.name for n in whole.body if "drawing" in map(ast.unparse, marks(n))}
    assert names - kept == marked
    imported = {a.name for n in ast.walk(left) if isinstance(n, ast.Import) for a in n.names}
    imported |= {n.module for n in ast.walk(left) if isinstance(n, ast.ImportFrom)}
    assert not [m for m in imported if m.startswith(("rocking.figures", "matplotlib"))]
    words = [n for n in ast.walk(left) if isinstance(n, ast.Name)]
    own = {n.id for n in words if isinstance(n.ctx, ast.Store)}  # such as a draw of many
    assert not ({n.id for n in words} - own) & (names - kept)


def marks(node):
    return getattr(node, "decorator_list", ())


@pytest.fixture
def digest(tmp_path, monkeypatch):
    """Digest of a study with some text, with what it draws or without."""
    (folder := tmp_path / "studies").mkdir()
    monkeypatch.setitem(sources.PACKAGES, "rocking", tmp_path)
    monkeypatch.setattr(sources, "ROOT", tmp_path)

    def of(text, drawn=False):
        sources.sources.cache_clear()
        sources.imports.cache_clear()
        (folder / "one.py").write_text(text)
        return sources.digest(folder / "one.py", drawn)

    yield of
    sources.sources.cache_clear()
    sources.imports.cache_clear()


MARK = "from rocking.runtime.drawing import drawing\n"
DRAWS = MARK + "A = 1\n@drawing\ndef look(table):\n    from rocking.figures import style\n"


def test_another_way_to_draw_computes_no_study_anew(digest):
    other = DRAWS.replace("style", "table")
    assert digest(DRAWS, True) != digest(other, True)
    assert digest(DRAWS) == digest(other)
    assert digest(DRAWS) != digest(DRAWS.replace("A = 1", "A = 2"))


COLLAPSE = "def collapse(case):\n    return {}\n"
TRAPS = {
    "called": "def draws(n, seed):\n    return 1 * n\n" + COLLAPSE.format("draws(2, 0)"),
    "helper": "def _draw(n):\n    return 1 * n\n" + COLLAPSE.format("_draw(2)"),
    "alias": "def draw(n):\n    return 1 * n\nsampled = draw\n" + COLLAPSE.format("sampled(2)"),
    "table": "def draw(n):\n    return 1 * n\nBY = {'a': draw}\n" + COLLAPSE.format("BY['a'](2)"),
    "by name": "def draw(n):\n    return 1 * n\n" + COLLAPSE.format("globals()['dr' + 'aw'](2)"),
    "method": "class Sample:\n    def draw(self):\n        return 1 * 2\n"
    + COLLAPSE.format("Sample().draw()"),
    "nested": COLLAPSE.format("0").replace("return 0", "def draw():\n        return 1 * 2")
    + "    return draw()\n",
    "through another": "def drawn(n):\n    return draws(n)\ndef draws(n):\n    return 1 * n\n"
    + COLLAPSE.format("drawn(2)"),
    "another mark": "drawing = lambda f: f\n@drawing\ndef draw(n):\n    return 1 * n\n",
    "mark bound anew": MARK + "drawing = lambda f: f\n@drawing\ndef draw(n):\n    return 1 * n\n",
    "mark of another": "from a import drawing\n@drawing\ndef draw(n):\n    return 1 * n\n",
    "more than one mark": MARK + "@kept\n@drawing\ndef draw(n):\n    return 1 * n\n",
    "called by its head": MARK + "@drawing\ndef draw(n=made(1 * 2)):\n    return n\n",
    "a class": MARK + "@drawing\nclass Draw:\n    n = 1 * 2\n",
}


@pytest.mark.parametrize("name", TRAPS)
def test_no_name_takes_what_computes_out_of_the_stamp(digest, name):
    """A study whose results would stay stale if the name of a function decided."""
    text = TRAPS[name]
    ast.parse(text)
    assert text.count("1 * ") == 1
    assert digest(text) != digest(text.replace("1 * ", "3 * "))


REACHED = """
from rocking.runtime.drawing import drawing
from rocking.runtime.script import run
@drawing
def look(n):
    return n
ways = {"called": lambda: look(1), "alias": lambda: alias(1), "by name": lambda: by("lo" + "ok")}
alias = look
def by(name):
    return globals()[name](1)
def pool():
    from concurrent.futures import ProcessPoolExecutor
    with ProcessPoolExecutor(1) as workers:
        workers.submit(look, 1).result()
ways["another process"] = pool
if __name__ == "__main__":
    run(lambda job: ways[job.params.way](), globals(), draws=job_draws)
"""


@pytest.mark.parametrize("way", ["called", "alias", "by name", "another process"])
@pytest.mark.parametrize("draws", [False, True])
def test_what_is_left_out_of_the_stamp_cannot_be_reached_by_what_computes(tmp_path, way, draws):
    script = tmp_path / "job.py"
    script.write_text(REACHED.replace("job_draws", str(draws)))
    done = subprocess.run(
        [sys.executable, str(script), "--params", f"way={way}"],
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert (done.returncode == 0) is draws, done.stderr
    assert ("__main__.look is marked @drawing" in done.stderr) is not draws


def test_one_script_draws_for_the_studies_and_its_stamp_has_what_they_draw():
    texts = {path: path.read_text("utf-8") for path in SCRIPTS.rglob("*.py")}
    assert [p.relative_to(SCRIPTS) for p in texts if "draws=" in texts[p]] == [
        Path("studies/figure.py")
    ]
    common = (ROOT / "workflow/rules/common.smk").read_text("utf-8")
    assert 'drawn = script == "studies/figure"' in common


def package_of_four(tmp_path, monkeypatch):
    """A package in which a imports b, b imports c, and nobody d."""
    package = tmp_path / "yade_scripts"
    package.mkdir()
    for name, text in {
        "__init__": "",
        "a": "from yade_scripts import b\n",
        "b": "from . import c\n",
        "c": "X = 1\n",
        "d": "",
    }.items():
        (package / f"{name}.py").write_text(text)
    monkeypatch.setattr(sources, "ROOT", tmp_path)
    monkeypatch.setitem(sources.PACKAGES, "yade_scripts", package)
    return package


def as_at_a_start():
    for function in (sources.sources, sources.imports, stamps.stamp):
        function.cache_clear()


def test_a_change_of_any_imported_module_changes_the_digest(tmp_path, monkeypatch):
    """Journals are keyed by it."""
    package = package_of_four(tmp_path, monkeypatch)
    before = sources.digest(package / "a.py")
    for name, differs in (("c", True), ("d", False)):
        (package / f"{name}.py").write_text("X = 2\n")
        as_at_a_start()
        assert (sources.digest(package / "a.py") != before) is differs
        (package / f"{name}.py").write_text("X = 1\n" if name == "c" else "")
    as_at_a_start()


def test_a_stamp_is_as_old_as_the_code_and_new_when_it_changes(tmp_path, monkeypatch):
    """Its date decides what Snakemake runs again: not for a touched file or a stamp deleted."""
    package = package_of_four(tmp_path, monkeypatch)
    for path in package.iterdir():
        os.utime(path, (1e9, 1e9))
    os.utime(package / "c.py", (1.1e9, 1.1e9))

    def made():
        as_at_a_start()
        path = stamps.stamp(package / "a.py", tmp_path / "stamps")
        assert [file.name for file in stamps.files([path])] == [
            *("__init__.py", "a.py", "b.py", "c.py")
        ]
        return path.stat().st_mtime

    assert made() == 1.1e9
    os.utime(package / "b.py", (1.2e9, 1.2e9))
    (package / "d.py").write_text("X = 2\n")
    assert made() == 1.1e9
    (package / "c.py").write_text("X = 2\n")
    os.utime(package / "c.py", (1.1e9, 1.1e9))
    assert made() > 1.2e9
    (tmp_path / "stamps/yade_scripts-a/stamp").unlink()
    assert made() == 1.2e9
    as_at_a_start()
