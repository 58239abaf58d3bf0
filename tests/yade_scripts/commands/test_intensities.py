"""Which intensities are run, and the journal of finished runs."""

import json

import pytest
from yade_process import resolved

from yade_scripts.commands import search
from yade_scripts.commands.journal import Journal, run_key
from yade_scripts.files import write_atomic


def test_grid_runs_its_list_and_nothing_else():
    """Grid mode visits exactly the configured intensities."""
    settings = resolved(ida={"mode": "grid", "grid_g": [0.1, 0.2, 0.4]})["ida"]
    assert search.intensities(settings, plan=[0.3]) == [0.1, 0.2, 0.4]


def test_without_a_scan_or_a_list_nothing_is_run():
    with pytest.raises(ValueError, match="ida.mode = adaptive: expected the plan of a dense scan"):
        search.intensities(resolved()["ida"])


def test_journal_survives_a_torn_line(tmp_path):
    """Rows before a torn line are kept, the torn one is dropped, new ones append cleanly."""
    path = tmp_path / "journal.jsonl"
    journal = Journal(path)
    for i in range(3):
        journal.put(f"key{i}", {"value": i})
    with open(path, "ab") as handle:
        handle.write(b'{"key": "key3", "row": {"val')
    again = Journal(path)
    assert sorted(again.rows) == ["key0", "key1", "key2"]
    again.put("key4", {"value": 4})
    assert [json.loads(line)["key"] for line in path.read_text().splitlines()] == [
        "key0",
        "key1",
        "key2",
        "key4",
    ]


def test_run_key_separates_its_parts():
    """Moving a character from one part to the next changes the key."""
    assert run_key("ab", "c") != run_key("a", "bc")
    assert run_key({"b": 1, "a": 2}) == run_key({"a": 2, "b": 1})


def test_atomic_write_leaves_no_part_behind(tmp_path):
    """A failing write leaves the old content and no temporary file."""
    path = tmp_path / "table.csv"
    write_atomic(path, "old")
    with pytest.raises(AttributeError):
        write_atomic(path, None)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_journal_of_an_earlier_version_is_read(tmp_path):
    """Another digest of a line would compute every finished run again."""
    path = tmp_path / "journal.jsonl"
    line = '{"key": "key0", "reason": "at rest", "row": {"d_over_b": "0.25", "status": "ok"},'
    path.write_text(line + ' "sum": "e57c397a2f990648"}\n')
    assert Journal(path).get("key0") == {"d_over_b": "0.25", "status": "ok"}
