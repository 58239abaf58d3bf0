"""Targets and their tables in docs/targets.md: read off the rules, as Snakemake reads them."""

import re
import shutil

import pytest
from forked import snakemake
from rocking.configuration.targets import PAGE, ROOT, Target, render, targets

from docs import write_keys as docs

MARKS = "<!-- targets: {}; written -->\n<!-- end of targets -->\n"


@pytest.mark.slow
def test_the_targets_are_those_of_snakemake(tmp_path):
    """It lists them; where it knows none of a name, the first of them in one line."""
    shutil.copytree(ROOT / "config", tmp_path / "config")
    there = set(re.findall(r"^(\w+)", snakemake(tmp_path, "--list-target-rules").stdout, re.M))
    assert set(targets()) <= there
    done = snakemake(tmp_path, "--dry-run", "--", "q")
    told = done.stdout + done.stderr
    said = re.search(r"No rule to produce q: targets: ([\w, ]+) and (\d+) more", told)
    assert set(said[1].split(", ")) <= there
    assert len(said[1].split(", ")) + int(said[2]) == len(targets())


def test_every_target_is_on_the_page_with_what_its_docstring_says():
    page = PAGE.read_text("utf-8")
    assert render(page) == page, "run python -m docs.write_keys"
    for path, text in docs.studies().items():
        for name, target in targets(study=path.parent.name).items():
            assert f"| `{name}` | {target.makes} | {target.costs} |" in text
    for name, target in targets(study=None).items():
        rows = re.findall(rf"^\| `{name}` \| (.+) \| (.+) \|$", page, re.M)
        assert rows == [(rows[0][0], target.costs)]
        assert rows[0][0].startswith(target.makes)


@pytest.fixture
def tree(tmp_path):
    """A checkout of a study, a target of the core, a main job under two names, a rule of a file."""
    for folder in ("rules", "studies/friction"):
        (tmp_path / "workflow" / folder).mkdir(parents=True)
    (tmp_path / "docs").mkdir()
    (tmp_path / "workflow" / "Snakefile").write_text(
        'rule all:\n    """The main job. Costs: minutes."""\n    input:\n        "a.csv",\n\n\n'
        "rule main:\n    default_target: True\n    input:\n        rules.all.input,\n"
    )
    text = (
        'rule table:\n    input:\n        "b",\n    output:\n        "a.csv",\n\n\n'
        'rule friction:\n    """\n    What friction\n    changes.\n'
        '    Costs: seconds; by records.\n    """\n    input:\n        "a.csv",\n'
    )
    (tmp_path / "workflow" / "rules" / "friction.smk").write_text(text)
    (tmp_path / "workflow" / "studies" / "friction" / "rules.smk").write_text(
        text.replace("rule friction", "rule gap").replace("rule table", "rule gaps")
    )
    return tmp_path


def test_a_new_target_needs_no_line_on_the_page(tree):
    what = Target("What friction changes", "seconds; by records")
    core = {"all": Target("The main job", "minutes"), "friction": what}
    assert targets(tree) == {**core, "gap": what}
    assert targets(tree, None) == core
    assert targets(tree, "friction") == {"gap": what}
    page = MARKS.format("all") + MARKS.format("the others")
    row = "| `friction` | What friction changes | seconds; by records |"
    written = render(page, tree)
    assert row in written
    assert "gap" not in written
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
    rule = tree / "workflow" / "rules" / "friction.smk"
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
