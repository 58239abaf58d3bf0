"""Public names: equality and hash, a case that cannot be changed, types, extremes."""

import copy
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from rocking import Case, Curve, History, Motion
from rocking.collapse.limits import intensity
from study_cases import study_case

ROOT = Path(__file__).parents[2]


def test_cases_of_the_same_sections_are_one():
    one, other = (study_case("W1", {"facade.height_m": 5.0}) for _ in range(2))
    assert one == other
    assert hash(one) == hash(other)
    assert one != one.varied({"facade.height_m": 5.1})
    assert len({one, other, pickle.loads(pickle.dumps(one)), copy.copy(one)}) == 1


def test_a_case_is_frozen_all_the_way_down():
    given = dict(study_case("W1", {"facade.ties": [{"height_m": 3.0}]}).sections)
    case = Case(given)
    for change in (
        lambda: case.sections.update(model="W2"),
        lambda: case["facade"].__setitem__("height_m", 9.0),
        lambda: case["facade"]["ties"].append({}),
        lambda: case["facade"]["ties"][0].pop("height_m"),
    ):
        with pytest.raises(TypeError, match="make another one by case.varied"):
            change()
    plain = copy.deepcopy(case.sections)
    plain["facade"]["ties"].append({})
    assert len(case["facade"]["ties"]) == 1


def test_motions_curves_and_histories_are_compared_by_content():
    one = Motion.sampled([0.0, 0.2, -0.1, 0.0], 0.02, "g", name="mine")
    same = Motion.sampled(np.array([0.0, 0.2, -0.1, 0.0]), 0.02, "g", name="mine")
    other = Motion.sampled([0.0, 0.2, -0.1, 0.01], 0.02, "g", name="mine")
    assert one == same != other
    assert hash(one) == hash(same)
    assert len({one, same, other}) == 2
    table = pd.DataFrame(
        {"pga_g": [0.1, 0.2], "status": ["ok", "overturned"], "d_over_b": [0.1, 1]}
    )
    curves = [Curve("W1", "mine", "pos", table.copy(), 0.02, wall_s=s) for s in (1.0, 2.0)]
    assert curves[0] == curves[1]
    assert hash(curves[0]) == hash(curves[1])
    assert curves[0] != Curve("W1", "mine", "pos", table.assign(pga_g=[0.1, 0.3]), 0.02)
    found = [History(table.copy(), float("nan"), "failed") for _ in range(2)]
    assert found[0] == found[1]
    assert hash(found[0]) == hash(found[1])
    assert found[0] != History(table, 0.1, "ok")
    assert one != "mine"


def test_an_intensity_beyond_three_g_is_said():
    with pytest.warns(UserWarning, match="pga_g = 5 g: beyond 3 g"):
        intensity("pga_g", 5.0)


@pytest.mark.slow
def test_a_type_checker_finds_a_wrong_argument(tmp_path):
    script = tmp_path / "mine.py"
    script.write_text(
        "from rocking import Case, Motion, collapse_curve\n"
        'case = Case.configured("W1")\n'
        'good = collapse_curve(case, Motion.named("RRS228"), "neg")\n'
        'bad = collapse_curve(case, "RRS228", "neg")\n'
        'worse = collapse_curve(case, Motion.named("RRS228"), "up")\n'
    )
    command = [sys.executable, "-m", "mypy", "--config-file=", "--follow-imports=silent"]
    command += ["--ignore-missing-imports", "--cache-dir", str(tmp_path / "cache"), str(script)]
    path = {"MYPYPATH": f"{ROOT / 'workflow'}:{ROOT}", "PATH": "/usr/bin:/bin"}
    said = subprocess.run(command, capture_output=True, text=True, timeout=600, env=path).stdout
    lines = [line for line in said.splitlines() if "error" in line and "mine.py" in line]
    assert [line.split(":")[1] for line in lines] == ["4", "5"], said
