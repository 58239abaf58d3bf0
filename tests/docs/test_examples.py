"""The examples of docs/yade.md run in YADE, say what the page says, and are right."""

import os
import re
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest
from yade_process import LIMIT_S, PYTHON, resolved

DOCS = Path(__file__).resolve().parents[2] / "docs"
EXAMPLES = DOCS / "examples"


@cache
def said(name):
    """What an example prints, as a user would start it."""
    done = subprocess.run(
        [PYTHON, EXAMPLES / f"{name}.py"],
        env={**os.environ, "PYTHONPATH": str(DOCS.parent)},
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return done.stdout


def numbers(text):
    return [float(number) for number in re.findall(r"\d+\.\d+", text)]


@pytest.fixture
def by_hand(monkeypatch):
    """Examples import each other, and what builds scenes needs no YADE."""
    monkeypatch.syspath_prepend(str(EXAMPLES))
    yield
    for path in EXAMPLES.glob("*.py"):
        sys.modules.pop(path.stem, None)


@pytest.mark.yade
@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(path.stem for path in EXAMPLES.glob("*.py")))
def test_an_example_prints_what_the_page_shows(name):
    page = (DOCS / "yade.md").read_text("utf-8")
    assert f"docs/examples/{name}.py" in page
    assert said(name) in page


@pytest.mark.yade
@pytest.mark.slow
def test_the_wall_is_upright_after_a_quarter_period_under_either_contact_law():
    """Housner's quarter period; at rest Hertz's depth."""
    upright, closed, _ = numbers(said("scene_by_hand"))
    assert upright == pytest.approx(closed, rel=0.005)
    deep, hertz, upright, closed, _ = numbers(said("own_contact_law"))
    assert deep == pytest.approx(hertz, rel=0.005)
    assert upright == pytest.approx(closed, rel=0.005)


@pytest.mark.yade
@pytest.mark.slow
def test_the_own_boundary_condition_holds_the_wall_in_yade_and_in_the_planar_solver(by_hand):
    """Alone it overturns; the frame stops it where geometry says, in both solvers."""
    from own_boundary_condition import B_M, GROUND_M_S2, NUMERICS, TIME_S, framed, standing
    from rocking.solver import Motions, history, to_plane

    said_alone, said_framed, said_met = said("own_boundary_condition").splitlines()
    assert "overturned" in said_alone
    assert "ok" in said_framed
    outward, met = numbers(said_framed)[0], numbers(said_met)[0]
    assert met < outward < 1.05 * met  # and no farther than the joint gives way
    motion = Motions(TIME_S, GROUND_M_S2)
    given = {**resolved()["numerics"], **NUMERICS}
    alone, held = (history(to_plane(s), motion, given) for s in (standing(), framed(standing())))
    assert (alone.status, held.status) == ("overturned", "ok")
    assert held.d_m.max() / B_M == pytest.approx(outward, rel=0.01)
