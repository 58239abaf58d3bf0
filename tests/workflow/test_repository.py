"""What the pages about the repository say agrees with the repository."""

import re
import subprocess
import tomllib
from datetime import date
from pathlib import Path

import pytest
import rocking
import yaml
from rocking import version

ROOT = Path(__file__).resolve().parents[2]


def test_the_version_follows_the_changelog():
    """While its top section is not released, the number is that of the next version, `.dev0`."""
    text = (ROOT / "CHANGELOG.md").read_text("utf-8")
    package = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    top, *rest = re.findall(r"(?m)^## (\S+)", text)
    released = [tuple(map(int, name.split("."))) for name in rest]
    assert released == sorted(released, reverse=True)
    dates = re.findall(r"(?m)^## \d\S+ - (\d{4}-\d\d-\d\d)$", text)
    number, dev = re.fullmatch(r"(\d+\.\d+\.\d+)(\.dev0)?", package["version"]).groups()
    assert len(dates) == len(rest) + (not dev)
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    assert citation.get("date-released") == (None if dev else date.fromisoformat(dates[0]))
    assert tuple(map(int, number.split("."))) > released[0]
    assert top == ("Unreleased" if dev else number)


def test_a_version_has_ten_lines_and_a_page_with_all():
    text = (ROOT / "CHANGELOG.md").read_text("utf-8")
    sections = re.split(r"(?m)^## ", text)[1:]
    assert sections
    for section in sections:
        lines = re.findall(r"(?m)^\s*(?:([-*+])|\d+[.)]) ", section)
        assert 0 < len(lines) <= 10, section.splitlines()[0]
        assert set(lines) == {"-"}, section.splitlines()[0]
        ((said, page),) = re.findall(r"\[All of ([\d.]+)\]\(([^)]+)\)", section)
        assert section.startswith((f"{said} ", "Unreleased\n"))
        assert page == f"docs/changes/{said}.md"
        assert (ROOT / page).is_file()


def test_a_version_is_the_tree_s_and_its_commit_is_known_in_a_clone(tmp_path, monkeypatch):
    package = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert rocking.__version__ == package["version"]
    assert version.stated().startswith(f"rocking-facades {package['version']}")
    if (ROOT / ".git").exists():
        assert re.search(r", commit [0-9a-f]{7,}\+?$", version.stated())
    inner = tmp_path / "theirs" / "copy"
    (inner / "workflow" / "rocking").mkdir(parents=True)
    (inner / "pyproject.toml").write_text('[project]\nversion = "99.1.0"\n', "utf-8")
    monkeypatch.setattr(version, "ROOT", inner)
    assert version.version() == "99.1.0"  # and not the installed one
    assert version.commit() == ""
    if (ROOT / ".git").exists():  # nor is a copy within another clone at that one's commit
        own = ("-c", "user.name=a", "-c", "user.email=a@b")
        for words in (["init", "-q"], ["add", "."], [*own, "commit", "-q", "-m", "Theirs"]):
            subprocess.run(["git", *words], cwd=inner.parent, check=True)
        assert version.commit() == ""


def test_contributing_names_places_and_targets_that_exist():
    text = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    places = re.findall(r"^\| `([\w/]+/)` \|", text, re.MULTILINE)
    assert len(places) >= 6
    assert [p for p in places if not (ROOT / p).is_dir()] == []
    folders = "config|docs|tests|tools|workflow|yade_scripts"
    named = set(re.findall(rf"`((?:{folders})/[\w./]+\.\w+)`", text))
    named -= {"workflow/report/name.rst"}  # a newcomer's
    if not any((ROOT / "workflow/studies").glob("*/rules.smk")):  # studies are deleted
        named = {name for name in named if not name.startswith("workflow/studies/")}
    assert len(named) > 20
    tops = ROOT, ROOT / "docs/examples/friction"
    assert [p for p in named if not any((top / p).is_file() for top in tops)] == []
    folders = {one for one in re.findall(rf"`((?:{folders})/[\w/]+/)`", text) if "<" not in one}
    own = {"workflow/studies/friction/"}  # a newcomer's
    assert [one for one in folders - own if not (ROOT / one).is_dir()] == []
    links = {one.partition("#")[0] for one in re.findall(r"\]\((?!http)([^)]+)\)", text)}
    assert links
    assert [one for one in links if one and not (ROOT / one).exists()] == []
    recipe = (ROOT / "Makefile").read_text("utf-8")
    linting = text.split("## Recipes")[0]
    commands = re.findall(r"^\.venv/bin/(?:ruff|snakefmt|mypy).*$", linting, re.MULTILINE)
    assert commands
    assert [c for c in commands if c not in recipe] == []  # said to be what `make test` runs


@pytest.mark.xdist_group("alone")
def test_tests_of_a_group_run_in_one_process(request):
    """pytest-xdist reads a group off a test's id; where it stands not there, all is made twice."""
    if not hasattr(request.config, "workerinput"):
        pytest.skip("all tests run in one process")
    assert request.node.nodeid.endswith("@alone")


def test_results_are_not_committed():
    try:
        done = subprocess.run(
            ["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True
        )
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("not a git clone")
    folders = {"results", ".snakemake", "build", "__pycache__"}
    found = {one for one in done.stdout.splitlines() if folders & {*Path(one).parent.parts}}
    assert found <= {"results/README.md"}
