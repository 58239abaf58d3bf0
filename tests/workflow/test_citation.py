"""What archives and journals read: one version, people as marked blanks, a paper that builds."""

import json
import re
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).resolve().parents[2]
BLANK = "[TO FILL IN"
PAPER = ROOT / "docs/paper/paper.md"


def text(name):
    return (ROOT / name).read_text("utf-8")


def versions():
    """Version by the file that states it."""
    return {
        "pyproject.toml": re.search(r'(?m)^version = "(.+)"$', text("pyproject.toml"))[1],
        "CITATION.cff": yaml.safe_load(text("CITATION.cff"))["version"],
        ".zenodo.json": json.loads(text(".zenodo.json"))["version"],
        "codemeta.json": json.loads(text("codemeta.json"))["version"],
    }


def test_every_file_states_the_same_version():
    assert len(set(versions().values())) == 1, versions()


def test_every_file_states_the_same_title_and_licence():
    cff, zenodo = yaml.safe_load(text("CITATION.cff")), json.loads(text(".zenodo.json"))
    codemeta = json.loads(text("codemeta.json"))
    assert cff["title"] == zenodo["title"]
    named = re.search(r'(?m)^license = \{text = "(.+)"\}$', text("pyproject.toml"))[1]
    assert {cff["license"], zenodo["license"]} == {named}
    assert codemeta["license"] == f"https://spdx.org/licenses/{named}"
    assert text("LICENSE").startswith(f"{named} License\n")
    licence = " ".join(text("LICENSE").split())
    assert "to deal in the Software without restriction" in licence
    assert {"cff-version", "message", "title", "authors"} <= set(cff)  # required by CFF 1.2


@pytest.mark.parametrize(
    ("name", "key"), [(".zenodo.json", "creators"), ("codemeta.json", "author")]
)
def test_people_are_blanks_that_are_marked(name, key):
    people = json.loads(text(name))[key]
    assert people
    for person in people:
        said = {key: value for key, value in person.items() if not key.startswith("@")}
        said |= {"affiliation": name} if (name := said.get("affiliation", {})) else {}
        texts = [one["name"] if isinstance(one, dict) else one for one in said.values()]
        assert texts
        assert [one for one in texts if not one.startswith(BLANK)] == []


def test_no_other_file_names_people_either():
    """A contributor's name comes from whoever fills the blanks in."""
    authors = yaml.safe_load(text("CITATION.cff"))["authors"]
    assert authors == [{"name": "The project's contributors"}]
    fields = yaml.safe_load(PAPER.read_text("utf-8").split("---\n", 2)[1])
    for key in ("authors", "affiliations"):
        assert {one["name"].startswith(BLANK) for one in fields[key]} == {True}
    assert json.loads(text("codemeta.json"))["codeRepository"].startswith(BLANK)


def test_the_paper_has_what_the_journal_asks():
    header, body = PAPER.read_text("utf-8").split("---\n", 2)[1:]
    fields = yaml.safe_load(header)
    assert {"title", "tags", "authors", "affiliations", "date", "bibliography"} <= fields.keys()
    parts = re.findall(r"(?m)^# (.+)$", body)
    for wanted in ("Summary", "Statement of need", "State of the field", "Software design"):
        assert wanted in parts
    assert parts[-1] == "References"
    assert 250 <= len(body.split()) <= 1000
    for picture in re.findall(r"!\[[^\]]*\]\(([^)]+)\)", body):
        assert (PAPER.parent / picture).is_file(), picture


def test_every_source_of_the_paper_is_cited_and_has_its_doi():
    entries = re.findall(r"@\w+\{(\w+),(.*?)\n\}", text("docs/paper/paper.bib"), re.S)
    cited = set(re.findall(r"@(\w+)", PAPER.read_text("utf-8")))
    assert {key for key, _ in entries} == cited
    for key, entry in entries:
        assert re.search(r"doi = \{10\.\d{4,}/\S+\}", entry), key


def test_conda_gets_what_runs_need():
    """Every package of a wheel's workflow, by the names that conda has for two of them.

    With the same bounds; pip adds this project and nothing else.
    """
    whole = yaml.safe_load(text("environment.yaml"))
    assert whole["channels"] == ["conda-forge", "bioconda"]
    (by_pip,) = [one for one in whole["dependencies"] if not isinstance(one, str)]
    assert by_pip == {"pip": ["--editable ."]}
    dependencies = [one for one in whole["dependencies"] if isinstance(one, str)]
    listed = [one.split()[0] for one in dependencies]
    names = {"matplotlib-base": "matplotlib", "snakemake-minimal": "snakemake"}
    have = {names.get(one, one) for one in listed}
    project = text("pyproject.toml")
    asked = re.findall(r'"([\w-]+)', re.search(r"(?m)^dependencies = \[(.*)\]", project)[1])
    asked += re.findall(r'"([\w-]+)', re.search(r"(?m)^report = \[(.*)\]", project)[1])
    assert len(asked) > 8
    assert set(asked) <= have
    bounds = dict(re.findall(r'"([\w-]+)([<>=][\d.,<>=]+)"', project))
    bounds["python"] = re.search(r'(?m)^requires-python = "(.+)"$', project)[1]
    assert bounds.keys() >= {"pandas", "snakemake", "python"}
    stated = {
        names.get(name, name): bound for name, _, bound in (d.partition(" ") for d in dependencies)
    }
    for name, bound in bounds.items():
        assert name not in have | {"python"} or stated[name].startswith(bound), name
