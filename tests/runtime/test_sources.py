"""Dependencies read from imports: they are what Python really loads, and every rule has them."""

import ast
import os
import re
import subprocess
import sys
from pathlib import Path

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


@pytest.mark.parametrize("name", ["scene", "fig09_ida", "table_wme", "calibrate_law", "record"])
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


def rules():
    """Yield (name, text) of every rule with a script or a study of its own."""
    for path in sorted((ROOT / "workflow" / "rules").rglob("*.smk")):
        for block in re.split(r"(?m)^(?=(?:use )?rule )", path.read_text("utf-8")):
            if re.search(r"^    script:|{params.yade}", block, re.M):
                yield re.match(r"(?:use )?rule (\w+)", block)[1], block


@pytest.mark.parametrize(("name", "block"), list(rules()))
def test_every_rule_depends_on_the_code_it_runs(name, block):
    """The input `modules` names the script, the module it calls, or the study in YADE."""
    if script := re.search(r'script:\n        "(?:\.\./)+scripts/(.+?)\.py"', block):
        called = re.search(r'^        (study="\w+"),$', block, re.M)
        names = [f'"{script[1].replace("wildcards.", "")}"', *(called.groups() if called else ())]
        wanted = f"code({', '.join(names)})"
    else:
        started = re.search(r"{params\.yade} ([a-z_0-9]+)", block)
        wanted = f'study_code("{started[1]}")'
    assert f"modules={wanted}" in block


def test_every_script_lies_where_its_rule_looks_for_it():
    """Snakemake looks from the file of the rule; of one that inherits, from that file."""
    scripts, inherited = {}, []
    for path in sorted((ROOT / "workflow" / "rules").rglob("*.smk")):
        text = path.read_text("utf-8")
        for name, block in re.findall(r"(?ms)^rule (\w+):\n(.+?)(?=^\S|\Z)", text):
            if script := re.search(r'script:\n        "([^"{]+)"', block):
                scripts[name] = script[1]
                inherited.append((path, name, name))
        inherited += [(path, *pair) for pair in re.findall(r"(?m)^use rule (\w+) as (\w+)", text)]
    assert len(scripts) > 80
    for path, base, name in inherited:
        if base in scripts:
            assert (path.parent / scripts[base]).is_file(), f"{path.name}: {name}"


def test_a_reader_does_not_touch_the_runs_in_yade():
    """What inside YADE runs knows nothing of records, and a figure nothing of the engine."""
    ida = {p.name for p in sources.sources(ROOT / "yade_scripts/studies/ida.py")}
    assert "reader.py" not in ida
    assert {"adapter.py", "bonds.py", "stiffness.py", "registry.py"} <= ida
    assert "adapter.py" not in {
        p.name for p in sources.sources(SCRIPTS / "records/table_records.py")
    }


def test_what_draws_belongs_to_a_study_only_where_it_is_drawn():
    for name in ("rocking/studies/sequence", "scripts/two_components/two_components_runs"):
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
    assert {name.lstrip("_")[:4] for name in names - kept} <= {"draw"}
    imported = {a.name for n in ast.walk(left) if isinstance(n, ast.Import) for a in n.names}
    imported |= {n.module for n in ast.walk(left) if isinstance(n, ast.ImportFrom)}
    assert not [m for m in imported if m.startswith(("rocking.figures", "matplotlib"))]
    words = [n for n in ast.walk(left) if isinstance(n, ast.Name)]
    own = {n.id for n in words if isinstance(n.ctx, ast.Store)}  # such as a draw of many
    assert not ({n.id for n in words} - own) & (names - kept)


def test_another_way_to_draw_computes_no_study_anew(tmp_path, monkeypatch):
    text = "A = 1\ndef draw(table):\n    from rocking.figures import style\n    return {}\n"
    folder = tmp_path / "studies"
    folder.mkdir()
    monkeypatch.setitem(sources.PACKAGES, "rocking", tmp_path)
    monkeypatch.setattr(sources, "ROOT", tmp_path)
    digests = {}
    for drawn in (True, False):
        for what in ("style", "table"):
            sources.sources.cache_clear()
            sources.imports.cache_clear()
            (folder / "one.py").write_text(text.format(what))
            digests[drawn, what] = sources.digest(folder / "one.py", drawn)
    assert digests[True, "style"] != digests[True, "table"]
    assert digests[False, "style"] == digests[False, "table"]
    (folder / "one.py").write_text(text.format("style").replace("A = 1", "A = 2"))
    assert sources.digest(folder / "one.py", drawn=False) != digests[False, "style"]
    sources.sources.cache_clear()
    sources.imports.cache_clear()


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
