"""What a report cites stays as it was, whatever runs later under the same name."""

import subprocess

import pytest
from rocking.assessment import evidence
from rocking.configuration import config as configuration


def files(tmp_path, text):
    for folder in ("one", "two"):
        (tmp_path / folder).mkdir(exist_ok=True)
        (tmp_path / folder / "table.csv").write_text(f"{folder} {text}\n")
    paths = [tmp_path / folder / "table.csv" for folder in ("one", "two")]
    return evidence.gathered(paths, {"config.yaml": f"height: {text}\n"})


def reported(tmp_path, text):
    path = tmp_path / "report.html"
    path.write_text(text)
    return [path]


def test_files_of_one_name_are_numbered(tmp_path):
    assert list(files(tmp_path, "9")) == ["config.yaml", "table.csv", "table_2.csv"]


def test_evidence_is_whole_checks_itself_and_is_named_by_its_digest(tmp_path):
    own = files(tmp_path, "9")
    place = evidence.keep(tmp_path / "evidence", own, reported(tmp_path, "signed"))
    assert place.name == evidence.digest_of(own)[: evidence.DIGITS]
    words = ["sha256sum", "--check", "--quiet", evidence.SUMS]
    subprocess.run(words, cwd=place, check=True, timeout=60)
    listed = subprocess.run(
        ["sha256sum", evidence.SUMS], cwd=place, capture_output=True, text=True, timeout=60
    )
    assert listed.stdout.split()[0] == evidence.digest_of(own)
    assert (place / "report.html").read_text() == "signed"
    assert not list((tmp_path / "evidence").glob(".*"))


def test_another_report_leaves_the_first_as_it_was(tmp_path):
    parent = tmp_path / "evidence"
    first = evidence.keep(parent, files(tmp_path, "9"), reported(tmp_path, "signed"))
    before = {path.name: path.read_bytes() for path in first.iterdir()}
    again = evidence.keep(parent, files(tmp_path, "9"), reported(tmp_path, "made again"))
    other = evidence.keep(parent, files(tmp_path, "10"), reported(tmp_path, "other"))
    assert again == first
    assert other != first
    assert {path.name: path.read_bytes() for path in first.iterdir()} == before
    assert all(not path.stat().st_mode & 0o222 for path in first.iterdir())


def test_evidence_that_breaks_off_leaves_nothing(tmp_path):
    with pytest.raises(FileNotFoundError):
        evidence.keep(tmp_path / "evidence", files(tmp_path, "9"), [tmp_path / "missing.pdf"])
    assert list((tmp_path / "evidence").iterdir()) == []


def test_a_name_that_gets_other_settings_is_told_in_one_line(tmp_path):
    path = tmp_path / "config.yaml"
    one = configuration.resolve({"run": "house", "facade": {"height_m": 6.0}})
    assert configuration.changed(one, path) == ""
    configuration.write_resolved(one, path, ["By somebody."])
    assert configuration.changed(one, path) == ""
    two = configuration.resolve({"run": "house", "facade": {"height_m": 7.5}, "seed": 9})
    said = configuration.changed(two, path)
    assert "run house gets other settings than its results have" in said
    assert "facade.height_m 6.0 → 7.5" in said
    assert "\n" not in said
    path.write_text("not: [yaml")
    assert configuration.changed(two, path) == ""
