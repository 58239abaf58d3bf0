"""Curves that YADE confirms, and the suite for practice."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from made_curves import collapse_tables, curve
from rocking.records import load, read_table
from rocking.runs import Runs
from run_script import script

pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[2]


def test_what_yade_does_not_confirm_rests_on_the_scan_alone(tmp_path):
    """Two scanned curves that fall at 0.31 g; YADE, which runs the second, falls at 0.28 g."""
    scans = [
        curve(tmp_path / f"scan_{name}.csv", "W1", name, "pos", 0.29, 0.31) for name in ("A", "B")
    ]
    own = curve(tmp_path / "ida_B.csv", "W1", "B", "pos", 0.27, 0.28)
    found = collapse_tables(tmp_path, [own], scans=scans)
    table = pd.read_csv(found["collapse"]).set_index("record")
    assert table["pga_collapse_g"].to_dict() == {"A": 0.31, "B": 0.28}
    assert table["runs_yade"].to_dict() == {"A": 0, "B": 2}
    assert (table["runs_planar"] == 2).all()
    assert table.loc["A", "pga_p10_g"] == table.loc["B", "pga_p10_g"]


def test_yade_confirms_the_records_that_the_configuration_says():
    config = {
        "models": ["W1", "W3"],
        "records_table": "config/records.tsv",
        "records": ["BUCAR0", "RRS228", "HVSC1"],
        "facade": {"courses": 0},
        "directions": ["neg"],
        "ida": {"confirm_every": 2},
    }
    runs = Runs(config, ROOT)
    curves = [(m, r, "neg") for m in config["models"] for r in config["records"]]
    assert runs.scans("main") == curves
    assert runs.by_yade("main") == [curve for curve in curves if "RRS228" not in curve]
    assert runs.confirmed("main") == ["BUCAR0", "HVSC1"]
    config["ida"] = {"mode": "grid", "confirm_every": 2}
    grid = Runs(config, ROOT)
    assert grid.scans("main") == []
    assert grid.by_yade("main") == curves


def test_committed_suite_is_the_one_its_rule_makes(tmp_path):
    script("surrogate_suite", tmp_path, output={"table": str(tmp_path / "suite.tsv")})
    committed = ROOT / "config/suites/surrogate_suite.tsv"
    assert (tmp_path / "suite.tsv").read_bytes() == committed.read_bytes()
    names = list(read_table(committed))
    assert len(names) == 44
    motion = load(names[0], committed)  # a surrogate of the given peaks can be made
    assert np.abs(motion.acceleration_m_s2).max() / 9.80665 == pytest.approx(0.618, rel=0.01)
