"""The second solver shares with the first the scene and how loops are compiled, no mechanics."""

import re
from pathlib import Path

import reference_solver

MAY = {"rocking.runtime.compiled", "rocking.mechanics.closed_forms"}  # the latter for a block


def test_it_takes_nothing_of_the_first_solver_nor_of_what_runs_in_yade():
    paths = sorted(Path(reference_solver.__file__).parent.glob("*.py"))
    assert len(paths) > 8
    found = {
        name
        for path in paths
        for name in re.findall(r"(?m)^ *(?:from|import) +([\w.]+)", path.read_text("utf-8"))
        if name.split(".")[0] in ("rocking", "yade_scripts", "smdof", "studies")
    }
    assert {name for name in found if not name.startswith("yade_scripts.model")} == MAY
