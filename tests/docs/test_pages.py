"""The first page is short and true to its files, and a number of the 3DEC study has one place."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text("utf-8")
PAGES = [
    path
    for path in [
        ROOT / "README.md",
        *ROOT.glob("docs/*.md"),
        *ROOT.glob("workflow/studies/*/page.md"),
    ]
    if path.name != "study.md"
]


def words(text):
    """Words of a page: what has a letter or a digit."""
    return [word for word in text.split() if re.search(r"\w", word)]


def numbers_of_the_study():
    """Medians and rates of the rigid block over the suite, off the page of the 3DEC study."""
    text = (ROOT / "docs/study.md").read_text("utf-8")
    section = text.split("## Its façade over the suite")[1].split("\n## ")[0]
    rows = [line.strip("| ").split(" | ") for line in section.splitlines() if line[:3] == "| W"]
    return [cell.split(" ")[0] for row in rows for cell in (row[1], row[6])]


def test_the_first_page_is_short_and_leads_on_late():
    assert len(README.split()) <= 800
    first = "\n".join(README.splitlines()[:40])
    assert len(re.findall(r"\]\(", first)) <= 15
    assert "```sh\n" in "\n".join(README.splitlines()[:25])


def test_the_pages_can_be_read_in_a_day():
    """All but the reference: keys, targets, changes, the record and public functions."""
    reference = {"README.md", "targets.md", "record.md", "api.md"}
    pages = [path for path in PAGES if path.name not in reference] + [ROOT / "docs/study.md"]
    assert sum(len(words(path.read_text("utf-8"))) for path in pages) <= 35_000


def test_the_file_for_an_own_facade_is_what_the_first_page_shows():
    (shown,) = re.findall(r"```yaml\n(.*?)```", README, re.S)
    stated = (ROOT / "config/scenarios/own_facade.yaml").read_text("utf-8")
    assert shown == "".join(line for line in stated.splitlines(True) if not line.startswith("#"))
    assert len(shown.splitlines()) <= 12


def test_numbers_of_the_rigid_block_over_the_suite_have_one_place():
    """One of them may be another quantity's; two are a repetition."""
    numbers = numbers_of_the_study()
    assert len(numbers) == 6
    for path in PAGES:
        text = path.read_text("utf-8")
        found = [n for n in numbers if re.search(rf"(?<![\d.]){re.escape(n)}(?!\d)", text)]
        assert len(found) < 2, f"{path.name}: {found}"


def test_every_page_of_caveats_is_linked():
    """docs/trust.md leads to what each row rests on, and every page with a number leads to it."""
    trust = (ROOT / "docs/trust.md").read_text("utf-8")
    for target in re.findall(r"\]\(([^)#]+)", trust):
        path = ROOT / "docs" / target
        assert path.is_file() or not path.parent.is_dir(), target  # a study may be deleted
    named = ("models", "collapse", "motions", "risk", "ties", "assessment", "accuracy", "building")
    for name in named:
        assert "(trust.md)" in (ROOT / f"docs/{name}.md").read_text("utf-8"), name
