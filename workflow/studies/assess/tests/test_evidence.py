"""What a report cites stays as it was, whatever runs later under the same name."""

import errno
import os
import re
import shutil
import subprocess

import pytest
from rocking import version
from rocking.configuration import config as configuration
from studies.assess import evidence
from study_cases import study_settings


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


def checked(place):
    """Whether `sha256sum --check` finds every file of a folder as it was."""
    words = ["sha256sum", "--check", "--quiet", "--strict", evidence.SUMS]
    done = subprocess.run(words, cwd=place, timeout=60, stderr=subprocess.DEVNULL, stdout=-1)
    return done.returncode == 0


@pytest.mark.parametrize("name", ["a\nb.csv", "a\\b.csv", "a\\nb.csv", "a\rb.csv", " a.csv"])
def test_a_file_of_any_name_is_checked(tmp_path, name):
    (tmp_path / name).write_text("1\n")
    own = evidence.gathered([tmp_path / name], {"config.yaml": ""})
    place = evidence.keep(tmp_path / "evidence", own, reported(tmp_path, "signed"))
    assert checked(place)
    path = place / name
    path.chmod(0o644)
    path.write_text("2\n")
    assert not checked(place)
    (line,) = evidence.sums_of_paths([tmp_path / name]).splitlines()
    assert line.startswith("\\") == (name != " a.csv")


@pytest.mark.parametrize("name", sorted(evidence.OURS))
def test_a_file_with_a_name_of_ours_is_kept_beside_ours(tmp_path, name):
    """A site's spectrum called report.html would else be listed, and not be there."""
    (tmp_path / "theirs").mkdir()
    (tmp_path / "theirs" / name).write_text("theirs\n")
    own = evidence.gathered([tmp_path / "theirs" / name], {"config.yaml": ""})
    place = evidence.keep(tmp_path / "evidence", own, reported(tmp_path, "signed"))
    assert checked(place)
    assert (place / "report.html").read_text() == "signed"
    assert "theirs\n" in {path.read_text() for path in place.iterdir()}


def test_evidence_is_whole_checks_itself_and_is_named_by_its_digest(tmp_path):
    own = files(tmp_path, "9")
    place = evidence.keep(tmp_path / "evidence", own, reported(tmp_path, "signed"))
    assert place.name == evidence.digest_of(own)[: evidence.DIGITS]
    assert checked(place)
    listed = subprocess.run(
        ["sha256sum", evidence.LIST], cwd=place, capture_output=True, text=True, timeout=60
    )
    assert listed.stdout.split()[0] == evidence.digest_of(own)
    assert (place / "report.html").read_text() == "signed"
    assert not list((tmp_path / "evidence").glob(".*"))


def test_every_change_of_a_file_is_noticed_the_report_s_too(tmp_path):
    own, report = files(tmp_path, "9"), reported(tmp_path, "signed")
    place = evidence.keep(tmp_path / "evidence", own, report)
    names = sorted(path.name for path in place.iterdir())
    assert {"report.html", evidence.LIST, evidence.SUMS, *own} == set(names)
    for name in names:
        path = place / name
        before = path.read_bytes()
        path.chmod(0o644)
        path.write_bytes(before[:-1] + bytes([before[-1] ^ 1]))
        assert not checked(place), name
        with pytest.raises(ValueError, match=rf"{name}: changed, or not of this report; expected"):
            evidence.keep(tmp_path / "evidence", own, report)
        path.write_bytes(before)
    assert evidence.keep(tmp_path / "evidence", own, report) == place


def test_a_forged_folder_is_refused(tmp_path):
    """One whose sums agree with what was put there, one with more, one with less, and a link."""
    own, report = files(tmp_path, "9"), reported(tmp_path, "signed")
    forged = {**own, evidence.LIST: evidence.sums_of(own).encode(), "report.html": b"it stands"}
    place = evidence.keep(tmp_path / "evidence", own, report)
    shutil.rmtree(place)
    place.mkdir()
    for name, data in {**forged, evidence.SUMS: evidence.sums_of(forged).encode()}.items():
        (place / name).write_bytes(data)
    assert checked(place)

    def refused(said):
        with pytest.raises(ValueError, match=said) as caught:
            evidence.keep(tmp_path / "evidence", own, report)
        assert "\n" not in str(caught.value)

    refused("SHA256SUMS: changed, or not of this report")
    shutil.rmtree(place)
    evidence.keep(tmp_path / "evidence", own, report)
    (place / "more.txt").write_text("by the way")
    refused("more.txt: a file that is no part of it")
    (place / "more.txt").unlink()
    (place / "table.csv").unlink()
    refused("table.csv: missing")
    place.rename(tmp_path / "elsewhere")
    place.symlink_to(tmp_path / "elsewhere")
    refused("no folder")


def test_another_report_leaves_the_first_as_it_was(tmp_path):
    parent = tmp_path / "evidence"
    first = evidence.keep(parent, files(tmp_path, "9"), reported(tmp_path, "signed"))
    before = {path.name: path.read_bytes() for path in first.iterdir()}
    again = evidence.keep(parent, files(tmp_path, "9"), reported(tmp_path, "signed"))
    other = evidence.keep(parent, files(tmp_path, "10"), reported(tmp_path, "other"))
    assert again == first
    assert other != first
    assert {path.name: path.read_bytes() for path in first.iterdir()} == before
    assert all(not path.stat().st_mode & 0o222 for path in first.iterdir())


def test_accelerograms_are_listed_where_they_lie(tmp_path):
    (tmp_path / "a.txt").write_text("0.1\n")
    said = evidence.sums_of_paths([tmp_path / "a.txt", tmp_path / "a.txt"])
    assert len(said.splitlines()) == 1
    words = ["sha256sum", "--check", "--strict", "-"]
    done = subprocess.run(words, input=said, text=True, timeout=60, stdout=subprocess.DEVNULL)
    assert done.returncode == 0


@pytest.mark.skipif(os.geteuid() != 0, reason="gives a folder to another user")
def test_a_modified_tree_and_one_of_another_user_are_told(tmp_path, monkeypatch):
    """Git leaves a clone of another user alone unless it is told that it may look."""

    def git(*words):
        own = ["-c", "user.name=n", "-c", "user.email=e@example.org"]
        subprocess.run(["git", "-C", str(tmp_path), *own, *words], check=True, timeout=60)

    git("init", "-q")
    (tmp_path / "workflow").mkdir()
    (tmp_path / "workflow" / "a.py").write_text("a = 1\n")
    git("add", ".")
    git("commit", "-qm", "one")
    monkeypatch.setattr(version, "ROOT", tmp_path)
    clean, first = version.commit(40), version.code()
    assert re.fullmatch("[0-9a-f]{40}", clean)
    monkeypatch.setenv("GIT_DIR", str(tmp_path / "other"))  # as in a hook of another repository
    assert version.commit(40) == clean
    monkeypatch.delenv("GIT_DIR")
    os.chown(tmp_path, 65534, 65534)
    os.chown(tmp_path / ".git", 65534, 65534)
    assert version.commit(40) == clean
    (tmp_path / "workflow" / "a.py").write_text("a = 2\n")
    assert version.commit(40) == f"{clean}+"
    assert version.code() != first


def test_evidence_that_breaks_off_leaves_nothing(tmp_path, monkeypatch):
    with pytest.raises(FileNotFoundError):
        evidence.keep(tmp_path / "evidence", files(tmp_path, "9"), [tmp_path / "missing.pdf"])
    assert not (tmp_path / "evidence").exists()

    def none(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(evidence.os, "replace", none)
    with pytest.raises(OSError, match="No space"):
        evidence.keep(tmp_path / "evidence", files(tmp_path, "9"), reported(tmp_path, "x"))
    assert list((tmp_path / "evidence").iterdir()) == []


def test_a_name_that_gets_other_settings_is_told_in_one_line(tmp_path):
    path = tmp_path / "config.yaml"
    one = study_settings({"run": "house", "facade": {"height_m": 6.0}})
    assert configuration.changed(one, path) == ""
    configuration.write_resolved(one, path, ["By somebody."])
    assert configuration.changed(one, path) == ""
    two = study_settings({"run": "house", "facade": {"height_m": 7.5}, "seed": 9})
    said = configuration.changed(two, path)
    assert "run house gets other settings than its results have" in said
    assert "facade.height_m 6.0 → 7.5" in said
    assert "\n" not in said
    path.write_text("not: [yaml")
    assert configuration.changed(two, path) == ""
