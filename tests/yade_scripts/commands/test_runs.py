"""A list of runs: what a case says of itself, and the realisations of its ensemble."""

import csv
import json

import pytest
from study_cases import study_case
from yade_process import run_study


@pytest.mark.yade
def test_realisations_of_a_list_are_those_of_the_case(tmp_path):
    """A façade of one metre under a long pulse of 2 g falls in every realisation; columns ahead."""
    case = study_case("W1", {"facade.height_m": 1.0, "facade.thickness_m": 0.1})
    case = case.varied({"ensemble.realisations": 3})
    (tmp_path / "W1.json").write_text(case.to_json())
    (tmp_path / "motion.csv").write_text("time_s,ground_m_s2\n0,0\n0.25,-1\n0.5,0\n0.6,0\n")
    own = {"about": {"height_m": 0.8}, "pga_g": [2.0], "realisations": True}
    listed = {"ahead": {"height_m": ".6g"}, "cases": [own]}
    (tmp_path / "list.json").write_text(json.dumps(listed))
    words = ["runs", "--list", "list.json", "--scene", "W1.json", "--motion", "motion.csv"]
    words += ["--record", "pulse", "--direction", "pos", "--journal", "j.jsonl"]
    done = run_study(*words, "--output", "runs.csv", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    rows = list(csv.DictReader((tmp_path / "runs.csv").open()))
    assert [(r["height_m"], r["realisation"], r["status"]) for r in rows] == [
        ("0.8", "1", "overturned"),
        ("0.8", "2", "overturned"),
        ("0.8", "3", "overturned"),
    ]
    assert len({r["amplitude_factor"] for r in rows}) == 3
