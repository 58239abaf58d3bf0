"""The adaptive strategy and the journal of finished runs."""

import json

import pytest
from yade_process import resolved

from yade_scripts.files import write_atomic
from yade_scripts.studies import intensities
from yade_scripts.studies.journal import Journal, run_key


def drive(settings, outcome):
    """Follow the strategy on a façade whose status is `outcome(pga)`; return the visited dict."""
    done = {}
    while (g := intensities.next_intensity(done, settings)) is not None:
        assert g not in done
        done[g] = outcome(g)
        assert len(done) < 200
    return done


@pytest.mark.parametrize("capacity", [0.034, 0.0612, 0.2, 0.537, 1.3])
def test_collapse_is_bracketed_to_the_tolerance(capacity):
    """Below and above a single threshold, the bracket holds it and is tight enough."""
    settings = resolved(ida={"start_g": 0.03})["ida"]
    done = drive(settings, lambda g: "overturned" if g >= capacity else "ok")
    safe, collapse = intensities.collapse_bounds(done)
    assert (safe or 0.0) < capacity <= collapse
    width = min(settings["tolerance_g"], settings["tolerance_ratio"] * collapse)
    assert collapse - (safe or 0.0) <= width + 1e-4


def test_probes_beyond_the_first_collapse():
    """Re-stabilisation above the first collapse is visited and does not move the bracket."""
    settings = resolved(ida={"start_g": 0.03})["ida"]
    climb = intensities.climb_sequence(settings)
    window = (climb[4] - 0.02, climb[4] + 0.001)
    done = drive(settings, lambda g: "overturned" if window[0] <= g <= window[1] else "ok")
    assert max(done) == climb[4 + settings["beyond_collapse"]]
    assert intensities.collapse_bounds(done)[1] <= climb[4]
    assert done[climb[5]] == "ok"


def test_failed_runs_are_no_information():
    """A failed intensity neither ends the climb nor bounds the bisection."""
    settings = resolved(ida={"start_g": 0.03})["ida"]
    climb = intensities.climb_sequence(settings)

    def outcome(g):
        if g == climb[3]:
            return "failed"
        return "overturned" if g >= 0.5 else "ok"

    safe, collapse = intensities.collapse_bounds(drive(settings, outcome))
    assert safe < 0.5 <= collapse


def test_no_collapse_ends_at_the_largest_intensity():
    """A façade that never falls is climbed to max_pga_g and reported as censored."""
    settings = resolved(ida={"start_g": 0.03})["ida"]
    done = drive(settings, lambda g: "ok")
    assert max(done) == settings["max_pga_g"]
    assert intensities.collapse_bounds(done) == (settings["max_pga_g"], None)


def test_grid_runs_its_list_and_nothing_else():
    """Grid mode visits exactly the configured intensities."""
    settings = resolved(ida={"mode": "grid", "grid_g": [0.1, 0.2, 0.4]})["ida"]
    assert sorted(drive(settings, lambda g: "ok")) == [0.1, 0.2, 0.4]


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
