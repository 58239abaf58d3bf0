"""Curves and histories of a case by YADE, in the Python that it was built for."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from rocking.collapse.history import History
from rocking.collapse.scan import one_by_one, seen_together
from rocking.tables import read_frame
from yade_scripts.model import models
from yade_scripts.model.floor_motions import write_columns, write_tabulated
from yade_scripts.model.motion import GROUND, amplitude
from yade_scripts.model.yielding import TabulatedFloors

SCRIPTS = Path(models.__file__).resolve().parents[1]
LIMIT_S = 1800.0  # of one call
WHOLE = 17  # digits: what YADE reads is what was computed
BLOCK = 4  # amplitudes that a climb asks for at once: each takes seconds
COLUMNS = ["pga_g", "d_over_b", "status", "collapsed", "dt_s", "steps", "wall_s"]


def run_yade(*words, folder, limit_s=LIMIT_S):
    """Run a command of `yade_scripts` in a folder.

    ValueError with its last line, if it fails or takes longer than `limit_s`.
    """
    python = os.environ.get("YADE_PYTHON") or shutil.which("python3", path=os.defpath)
    command = [str(python or sys.executable), str(SCRIPTS), *words]
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    try:
        done = subprocess.run(
            command, cwd=folder, env=environment, capture_output=True, text=True, timeout=limit_s
        )
    except subprocess.TimeoutExpired:
        raise ValueError(f"YADE: {words[0]} took more than {limit_s:g} s") from None
    if done.returncode:
        raise ValueError(f"YADE: {(done.stderr.strip().splitlines() or ['no message'])[-1]}")


class YadeRuns:
    """Outcomes of a case at any amplitudes, by YADE; finished runs are kept while it lives.

    `limit_s` is for each call, of up to `block` amplitudes. `second` is the motion along the façade
    of a case in three dimensions, whose outcomes have its largest twist and slide too.
    """

    block = BLOCK

    def __init__(self, case, motion, direction, limit_s=LIMIT_S, second=None):
        """Write the case and its motions to a folder of their own."""
        self.limit_s, self.static_g = limit_s, models.static_multiplier(case.sections)
        self._folder = tempfile.TemporaryDirectory(prefix="rocking-")
        self.folder = Path(self._folder.name)
        (self.folder / "case.json").write_text(case.to_json())
        given = _written(self.folder, "motion", motion, case)
        self.columns = COLUMNS if second is None else [*COLUMNS, "twist_rad", "slid_m"]
        self.case: dict = {
            "scene": "case.json",
            "motion": given,
            "record": motion.name or "motion",
            "direction": direction,
        }
        if second is not None:
            write_columns(self.folder / "second.csv", *second.columns(case), digits=WHOLE)
            self.case["second"] = "second.csv"
        if motion.first is not None and motion.first_pga_g > 0.0:
            self.case["before"] = {
                "motion": _written(self.folder, "first", motion.first, case),
                "pga_g": motion.first_pga_g,
                "pause_s": motion.pause_s,
            }

    def run(self, pga_g, realisations=False):
        """Outcomes at some amplitudes; realisations are run with the scene's own nodes and step."""
        listed: dict = {"cases": [{**self.case, "pga_g": [float(g) for g in pga_g]}]}
        listed["ahead"] = {"pga_g": ".17g"}
        (self.folder / "runs.json").write_text(json.dumps(listed))
        words = ("--list", "runs.json", "--journal", "journal.jsonl", "--output", "runs.csv")
        run_yade("runs", *words, folder=self.folder, limit_s=self.limit_s)
        table = read_frame(self.folder / "runs.csv")
        return table.assign(collapsed=(table["status"] == "overturned").astype(int))[self.columns]

    def seen(self, strategy):
        """Outcomes of all that a search asks for, by ascending amplitude, and what it found."""
        return seen_together([(self, strategy)], one_by_one)[0]


def _written(folder, name, motion, case):
    """Write what shakes a case into a file; its name."""
    time_s, columns = motion.columns(case)
    write = write_tabulated if isinstance(columns, TabulatedFloors) else write_columns
    write(folder / f"{name}.csv", time_s, columns, digits=WHOLE)
    return f"{name}.csv"


def yade_history(case, motion, direction, pga_g):
    """One history by YADE, with contact forces and energies; see the command `history`.

    ValueError of one line, for a motion with a first shock.
    """
    if motion.before(case, direction) is not None:
        raise ValueError("history by YADE: expected a motion without a first shock")
    with tempfile.TemporaryDirectory(prefix="rocking-") as folder:
        Path(folder, "case.json").write_text(case.to_json(), encoding="utf-8")
        time_s, columns = motion.columns(case)
        if isinstance(columns, TabulatedFloors):
            columns = columns.at(amplitude(columns[GROUND], "pos", pga_g))
        write_columns(Path(folder, "motion.csv"), time_s, columns, digits=WHOLE)
        words = ["--scene", "case.json", "--motion", "motion.csv", "--direction", direction]
        words += ["--record", motion.name or "motion", "--pga", f"{pga_g:.17g}"]
        run_yade("history", *words, "--output", "history.csv", folder=folder)
        table = read_frame(Path(folder, "history.csv"))
    status = str(table["status"].iloc[0])
    peak = float("nan") if status == "failed" else float(table["d_over_b"].abs().max())
    return History(table, peak, status)
