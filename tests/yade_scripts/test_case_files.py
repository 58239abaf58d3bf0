"""Files given to the commands by hand: what they cannot use ends in one line that names it."""

import copy
import json
import os

import numpy as np
import pytest
from study_cases import study_case

from yade_scripts.commands import ida, pushover, runs
from yade_scripts.files import read_case
from yade_scripts.model import floor_motions


@pytest.fixture(scope="module")
def sections():
    return study_case("W1").sections


def written(path, content):
    path.write_text(json.dumps(content))
    return str(path)


def refusal(read, *given):
    with pytest.raises(ValueError, match=".") as caught:
        read(*given)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_a_case_file_is_read_as_it_was_written(tmp_path, sections):
    assert read_case(written(tmp_path / "W1.json", sections)) == json.loads(json.dumps(sections))


@pytest.mark.parametrize("content", [None, [], 3, {}, {"model": "W1"}, {"facade": {}}])
def test_what_is_no_case_is_named_with_what_it_lacks(tmp_path, content):
    path = written(tmp_path / "other.json", content)
    said = refusal(read_case, path)
    assert said.startswith(f"{path}: ")
    assert "model" in said or "facade" in said


@pytest.mark.parametrize(
    ("place", "value", "words"),
    [
        (("facade", "height_m"), "tall", "facade.height_m = 'tall': expected a number"),
        (("facade", "thickness_m"), None, "facade.thickness_m = None: expected a number > 0"),
        (("facade", "e_mpa"), -1, "facade.e_mpa = -1: expected a number > 0"),
        (("beta_s",), "0.003", "beta_s = '0.003': expected a number"),
        (("smdof", "period_s"), "0.27 s", "smdof.period_s = '0.27 s': expected a number"),
        (("numerics",), "few", "numerics = 'few': expected a section"),
        (("facade",), [], "facade = []: expected a section"),
    ],
)
def test_text_where_a_unit_stands_is_named_with_its_key(tmp_path, sections, place, value, words):
    changed = copy.deepcopy(sections)
    *path, key = place
    part = changed
    for name in path:
        part = part[name]
    part[key] = value
    assert words in refusal(read_case, written(tmp_path / "W1.json", changed))


@pytest.mark.parametrize("content", [None, [], {"a": 1}])
def test_a_list_or_a_plan_that_is_none_is_named(tmp_path, sections, content):
    wrong, out = written(tmp_path / "wrong.json", content), str(tmp_path / "out.csv")
    case, motion = written(tmp_path / "W1.json", sections), str(tmp_path / "m.csv")
    floor_motions.write(motion, np.array([0.0, 0.01]), np.array([0.0, 1.0]))
    curve = ["--record", "A", "--direction", "neg", "--journal", str(tmp_path / "journal")]
    for command, words in (
        (runs, ["--list", wrong, "--journal", str(tmp_path / "journal")]),
        (pushover, ["--scene", wrong]),
        (ida, ["--scene", case, "--motion", motion, "--plan", wrong, *curve]),
    ):
        said = refusal(command.main, [*words, "--output", out])
        assert said.startswith(f"{wrong}: "), command.__name__


@pytest.mark.parametrize("plan", [{"runs": [0.1]}, {"start_g": 0.1, "ranges": []}])
def test_plans_of_runs_and_of_a_climb_are_both_taken(tmp_path, sections, monkeypatch, plan):
    """The first is of a dense scan, the second of a complete building. YADE is loaded after it."""

    def reached():
        raise RuntimeError("the plan was taken")

    monkeypatch.setattr(ida.adapter, "load_yade", reached)
    case, motion = written(tmp_path / "W1.json", sections), str(tmp_path / "m.csv")
    floor_motions.write(motion, np.array([0.0, 0.01]), np.array([0.0, 1.0]))
    words = ["--scene", case, "--motion", motion, "--record", "A", "--direction", "neg"]
    words += ["--plan", written(tmp_path / "plan.json", plan), "--journal", str(tmp_path / "j")]
    with pytest.raises(RuntimeError, match="the plan was taken"):
        ida.main([*words, "--output", str(tmp_path / "out.csv")])


def test_a_faulty_motion_is_named_with_its_file(tmp_path):
    path = tmp_path / "m.csv"
    for rows, words in (
        ("0,0\n0.01,x\n", "'x'"),
        ("0.02,0\n0.01,1\n", "row 2: expected time_s to rise"),
        ("0,0\n0.01,1\n0.01,2\n", "row 3: expected time_s to rise"),
        ("", "at least two complete rows"),
    ):
        path.write_text(f"time_s,ground_m_s2\n{rows}")
        said = refusal(floor_motions.read, path)
        assert said.startswith(str(path))
        assert words in said


def test_a_pipe_is_not_waited_for_and_brackets_without_end_are_no_traceback(tmp_path):
    pipe, deep = tmp_path / "pipe.json", tmp_path / "deep.json"
    os.mkfifo(pipe)
    assert f"{pipe}: neither a file nor a link to one" in refusal(read_case, pipe)
    deep.write_text("[" * 100_000)
    assert f"{deep}: not JSON" in refusal(read_case, deep)
