"""The table of changes fits the code: each text is found where the table says, and changes it."""

import re
import shlex
from pathlib import Path

import pytest

from mutations.run import replaced, whole_table

ROOT = Path(__file__).parents[3]
TABLE = whole_table()


def there(path):
    """Whether a file is not that of a study whose folder was deleted."""
    parts = Path(path).parts
    return parts[:2] != ("workflow", "studies") or ROOT.joinpath(*parts[:3]).is_dir()


def test_every_change_can_be_made():
    changes = [change for entry in TABLE.values() for change in entry["changes"]]
    assert len(changes) >= 40
    for change in changes:
        if not there(change["file"]):
            continue
        before = (ROOT / change["file"]).read_text(encoding="utf-8")
        after = replaced(before, change["old"], change["new"], change.get("at"))
        assert after != before
        assert len(after) - len(before) == len(change["new"]) - len(change["old"])


def test_every_change_names_its_tests_and_every_survivor_its_reason():
    for name, entry in TABLE.items():
        for change in entry["changes"]:
            named = [w for w in change.get("tests", entry.get("tests", "")).split() if "/" in w]
            assert named, name
            named = [word.split("::")[0] for word in named if there(word)]
            assert all((ROOT / word).exists() for word in named), named
            assert len(change.get("left", "a reason in words").split()) > 3


def selected(words):
    """What stands in the tests that an expression of pytest's selects from, and its words."""
    given = shlex.split(words)
    chosen = given[given.index("-k") + 1] if "-k" in given else ""
    places = [ROOT / word.split("::")[0] for word in given if "/" in word and there(word)]
    files = [
        path
        for place in places
        for path in ([place] if place.is_file() else place.rglob("test_*.py"))
    ]
    texts = [path.name + path.read_text(encoding="utf-8") for path in files]
    return texts, set(re.findall(r"\w+", chosen)) - {"or", "and", "not"}


def test_what_selects_tests_names_some_that_are_there():
    """A test that was renamed would otherwise leave its change to tests that do not see it."""
    for name, entry in TABLE.items():
        for words in {entry.get("tests"), *(c.get("tests") for c in entry["changes"])} - {None}:
            texts, chosen = selected(words)
            missed = [word for word in chosen if not any(word in text for text in texts)]
            assert missed == [] or texts == [], name


def test_an_ambiguous_change_is_refused():
    assert replaced("a b a", "a", "c", at=2) == "a b c"
    for old, at in (("a", None), ("d", None), ("a", 3)):
        with pytest.raises(SystemExit, match="out of date"):
            replaced("a b a", old, "c", at)
