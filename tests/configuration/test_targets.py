"""Targets and their tables in docs/targets.md: read off the rules, as Snakemake reads them."""

import re
import shutil

import pytest
from forked import snakemake
from rocking.configuration import docs
from rocking.configuration.targets import PAGE, ROOT, Target, render, targets

MARKS = "<!-- targets: {}; written -->\n<!-- end of targets -->\n"


@pytest.mark.slow
def test_the_targets_are_those_of_snakemake(tmp_path):
    """It names them where it knows none of a name."""
    shutil.copytree(ROOT / "config", tmp_path / "config")
    done = snakemake(tmp_path, "--dry-run", "--", "q")
    listed = re.search(r"No rule to produce q: targets: ([\w, ]+)", done.stdout + done.stderr)
    assert set(listed[1].split(", ")) == set(targets())


def test_every_target_is_on_the_page_with_what_its_docstring_says():
    page = PAGE.read_text("utf-8")
    assert render(page) == page, "run python -m rocking.configuration.docs"
    for name, target in targets().items():
        rows = re.findall(rf"^\| `{name}` \| (.+) \| (.+) \|$", page, re.M)
        assert rows == [(rows[0][0], target.costs)]
        assert rows[0][0].startswith(target.makes)


@pytest.fixture
def tree(tmp_path):
    """A checkout of two studies, a main job under two names and a rule that makes a file."""
    rules = tmp_path / "workflow" / "rules" / "studies"
    rules.mkdir(parents=True)
    (tmp_path / "docs" / "studies").mkdir(parents=True)
    (tmp_path / "workflow" / "Snakefile").write_text(
        'rule all:\n    """The main job. Costs: minutes."""\n    input:\n        "a.csv",\n\n\n'
        "rule main:\n    default_target: True\n    input:\n        rules.all.input,\n"
    )
    (rules / "friction.smk").write_text(
        'rule table:\n    input:\n        "b",\n    output:\n        "a.csv",\n\n\n'
        'rule friction:\n    """\n    What friction\n    changes.\n'
        '    Costs: seconds; by records.\n    """\n    input:\n        "a.csv",\n'
    )
    return tmp_path


def test_a_new_target_needs_no_line_on_the_page(tree):
    assert targets(tree) == {
        "all": Target("The main job", "minutes"),
        "friction": Target("What friction changes", "seconds; by records"),
    }
    page = MARKS.format("all") + MARKS.format("the others")
    assert "| `friction` | What friction changes | seconds; by records |" in render(page, tree)
    (tree / "docs" / "studies" / "friction.md").touch()
    row = "| `friction` | What friction changes ([page](studies/friction.md)) |"
    written = render(page, tree)
    assert row in written
    assert render(written, tree) == written
    assert row not in written.partition("the others")[0]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("Costs", "Takes", "rule friction: expected a docstring: what it makes. Costs"),
        ("records.", "records.\n    Page: docs/b.md", "rule friction: docs/b.md: expected a page"),
        (
            "rule friction",
            "rule cohesion",
            "docs/targets.md: friction: expected a target of all, c",
        ),
    ],
)
def test_faults_of_a_docstring_are_named(tree, old, new, message):
    rule = tree / "workflow" / "rules" / "studies" / "friction.smk"
    rule.write_text(rule.read_text().replace(old, new))
    with pytest.raises(ValueError, match=re.escape(message)):
        render(MARKS.format("friction") + MARKS.format("the others"), tree)


def test_the_command_writes_both_pages_or_says_which_is_stale(tmp_path, monkeypatch, capsys):
    stale = tmp_path / "docs" / "targets.md"
    stale.parent.mkdir()
    stale.write_text(PAGE.read_text("utf-8").replace("| seconds |", "| hours |"), "utf-8")
    monkeypatch.setattr(docs.targets, "PAGE", stale)
    assert docs.main(["--check"]) == 1
    assert capsys.readouterr().out.startswith("docs/targets.md is out of date")
    assert docs.main([]) == 0
    assert stale.read_text("utf-8") == PAGE.read_text("utf-8")
    stale.write_text("no table", "utf-8")
    assert docs.main(["--check"]) == 1
    assert "expected one marker" in capsys.readouterr().err
