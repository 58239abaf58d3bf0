"""The tests of figure 6 as they are handed to YADE."""

import json
from pathlib import Path

import pytest
from run_script import script

ROOT = Path(__file__).resolve().parents[4]
SETTINGS = {
    "base": "study",
    "shake_table_tilt_deg": [0.2, 0.21, 0.348],
    "shake_table_scale": [0.75],
}


@pytest.mark.slow
def test_every_shake_table_test_has_nodes_and_a_step(tmp_path):
    """The wall's file states none: they are the measured ones of W1."""
    settings = json.dumps({"calibration": SETTINGS})  # a text, as the rule gives it
    script(
        "calibrate_shake_table",
        tmp_path,
        input={
            "wall": str(ROOT / "config/walls/shawa.yaml"),
            "table": str(ROOT / "config/walls/shawa_records.tsv"),
            "law": str(ROOT / "config/beta_law.json"),
            "fidelity": str(ROOT / "config/fidelity.yaml"),
        },
        output={"tests": "tests.json", "motions": "motions"},
        params={"settings": json.dumps(settings), "baseline": None, "seed": 1},
    )
    tests = json.loads((tmp_path / "tests.json").read_text())
    assert len(tests) == 3 * 2 * 2  # motions, directions, laws
    for test in tests:
        numerics = test["config"]["numerics"]
        assert numerics["nodes_thickness"] >= 3
        assert numerics["nodes_height"] >= 3
        assert 0.0 < numerics["step_fraction"] <= 1.0
