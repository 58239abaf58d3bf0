"""Dependencies read from imports: they are what Python really loads, and every rule has them."""

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
STUDIES = ROOT / "workflow" / "studies"
PACKAGE = ROOT / "workflow/rocking"
OF_STUDIES = ("table_wme", "calibrate_law")  # scripts
LOADED = """
import sys, types
sys.argv = ["x"]
import rocking.runtime.script as script
script.run = lambda main, namespace: None
before = set(sys.modules)
exec(compile(open({path!r}).read(), {path!r}, "exec"), {{"__name__": "script"}})
for name, module in sorted(sys.modules.items()):
    file = getattr(module, "__file__", None)
    if file and name.split(".")[0] in {packages!r}:
        print(file)
"""
RULE_FILES = sorted([*ROOT.glob("workflow/rules/**/*.smk"), *STUDIES.glob("*/*.smk")])
SCRIPTS_OF_RULES = f"""
import json
include: "{ROOT}/workflow/Snakefile"
for one in workflow.rules:
    if one.script:
        about = one.params.get("study"), one.input.modules({{}}), list(one.log)
        print(json.dumps([one.name, one.script, *about]))
"""


@pytest.mark.parametrize("name", ["facade_case", "fig09_ida", "record", *OF_STUDIES])
def test_sources_are_what_python_loads(name):
    """Two routes: the parsed imports, and the modules in memory after running the script."""
    if name in OF_STUDIES and not any(STUDIES.glob("*/rules.smk")):
        pytest.skip("studies are deleted")
    (path,) = [*SCRIPTS.glob(f"*/{name}.py"), *STUDIES.glob(f"*/scripts/{name}.py")]
    done = subprocess.run(
        [sys.executable, "-c", LOADED.format(path=str(path), packages=[*sources.PACKAGES])],
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


def test_imports_are_found_at_any_depth(tmp_path):
    """In a function, a branch, a handler of errors, a case: each changes what a script computes."""
    modules = [path.stem for path in sorted(PACKAGE.glob("*.py")) if path.stem != "__init__"][:5]
    first, second, third, fourth, fifth = (f"from rocking import {name}" for name in modules)
    text = f"def f(x):\n    {first}\n    if x:\n        pass\n    else:\n        {second}\n"
    text += f"    try:\n        pass\n    except OSError:\n        {third}\n"
    text += f"    finally:\n        {fourth}\n    match x:\n        case 1:\n            {fifth}\n"
    path = tmp_path / "script.py"
    path.write_text(text)
    found = {file.stem for file in sources.imports(path)}
    assert found == {"__init__", *modules}


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
        module = "figure" if Path(script).stem == "figure" else "study"
        called = [STUDIES / study / module] if study else []
        wanted = [Path(script).with_suffix(""), *called]
        stamped = [Path(path).parent.name for path in modules]
        assert len(stamped) == len(wanted), name
        for one, path in zip(stamped, wanted, strict=True):
            assert one.endswith("-".join(path.parts[-2:])), name
        assert len(log) == 1, name


def test_every_script_lies_where_its_rule_looks_for_it():
    """Snakemake looks from the file of the rule; of one that inherits, from that file."""
    scripts, inherited = {}, []
    for path in RULE_FILES:
        text = path.read_text("utf-8")
        for name, block in re.findall(r"(?ms)^rule (\w+):\n(.+?)(?=^\S|\Z)", text):
            if script := re.search(r'script:\n        "([^"{]+)"', block):
                scripts[name] = script[1]
                inherited.append((path, name, name))
        for script in re.findall(r'(?m)^figure_by\(\n    "(.+)"', text):
            folder = SCRIPTS.parent if script.startswith("studies/") else SCRIPTS
            assert (folder / f"{script}.py").is_file(), f"{path}: {script}"
        inherited += [(path, *pair) for pair in re.findall(r"(?m)^use rule (\w+) as (\w+)", text)]
    assert len(scripts) > 10
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


@pytest.mark.parametrize("path", sorted(STUDIES.glob("*/study.py")), ids=lambda p: p.parent.name)
def test_what_a_study_computes_imports_nothing_that_draws(path):
    """Another colour computes nothing anew: the stamp of study.py has no figure in it."""
    found = sources.sources(path)
    assert not [p for p in found if p.name == "figure.py" or "figures" in p.parts]
    assert "matplotlib" not in "".join(p.read_text("utf-8") for p in found if p.suffix == ".py")


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
    (tmp_path / "stamps" / f"{tmp_path.name}-yade_scripts-a" / "stamp").unlink()
    assert made() == 1.2e9
    as_at_a_start()


def test_what_stands_in_a_stamp_s_way_is_named(tmp_path, monkeypatch):
    """A file in the place of its folder, or of the folder of all; a folder in its own; links."""
    package = package_of_four(tmp_path, monkeypatch)
    folder = tmp_path / "stamps"
    own = folder / f"{tmp_path.name}-yade_scripts-a"
    theirs = tmp_path / "theirs"
    theirs.mkdir()
    for make in (
        lambda: folder.write_text(""),
        lambda: (folder.mkdir(), own.write_text("")),
        lambda: (own / "stamp" / "x").mkdir(parents=True),
        lambda: (folder.mkdir(), own.symlink_to(theirs)),
        lambda: folder.symlink_to(theirs),
    ):
        make()
        as_at_a_start()
        with pytest.raises(OSError, match="Errno") as caught:
            stamps.stamp(package / "a.py", folder)
        assert caught.value.filename == str(own / "stamp")
        real = folder.is_dir() and not folder.is_symlink()
        shutil.rmtree(folder) if real else folder.unlink()
    assert not [*theirs.iterdir()]
    as_at_a_start()


def test_a_script_is_no_module_that_a_server_may_import():
    """To import it would run it: not one of all scripts of rules has a dotted name."""
    scripts = [*SCRIPTS.rglob("*.py"), *STUDIES.glob("*/scripts/*.py")]
    assert len(scripts) > 15
    assert sources.names(scripts) == []
    beside = STUDIES / "shared" / "hazard.py"
    assert sources.names([beside, *scripts]) == ["studies.shared.hazard"]


@pytest.mark.parametrize(
    "text",
    [
        *("import rocking.tables", "import os, rocking.tables as t", "from rocking import tables"),
        "from rocking.tables import as_text",
        "def f():\n    try:\n        pass\n    except OSError:\n        import rocking.tables",
    ],
)
def test_an_import_of_any_form_counts(tmp_path, text):
    path = tmp_path / "script.py"
    path.write_text(text)
    packages = {ROOT / "workflow/rocking/__init__.py", ROOT / "workflow/rocking/tables.py"}
    assert sources.imports(path) == packages
