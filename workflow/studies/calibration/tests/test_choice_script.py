"""Where a façade falls under two laws of β: the scan and YADE together say it."""

import json

import pandas as pd
import pytest
from run_script import script


@pytest.mark.slow
def test_collapse_is_the_lowest_that_either_solver_saw(tmp_path):
    """YADE stops once it has confirmed a scan: its few levels alone would say 0.58 g."""
    pga_g = [0.160, 0.169, 0.170, 0.171, 0.180, 0.600]
    scan = pd.DataFrame({"pga_g": pga_g, "status": ["ok"] * 3 + ["overturned"] * 3})
    scan["collapsed"] = (scan["status"] == "overturned").astype(int)
    scan.to_csv(tmp_path / "scan.csv", index=False)
    about = {"model": "W2", "record": "R", "direction": "neg"}
    yade = pd.DataFrame({"pga_g": [0.1, 0.165, 0.58], "d_over_b": [0.2, 0.5, 1.0]})
    yade["status"] = ["ok", "ok", "overturned"]
    yade["collapsed"] = [0, 0, 1]
    yade = yade.assign(dt_s=1e-4, steps=1000, wall_s=1.0)
    yade.assign(**about).to_csv(tmp_path / "yade.csv", index=False)
    scene = {"model": "W2", "damping": {"law": "eq5"}, "beta_s": 0.00277}
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    (tmp_path / "facts.json").write_text(json.dumps({"name": "R", "source": "file", "details": {}}))
    script(
        "calibrate_choice",
        tmp_path,
        input={
            "cases": ["scene.json"],
            "ida": ["yade.csv"],
            "scans": ["scan.csv"],
            "facts": "facts.json",
        },
        output={"table": "table.csv", "png": "choice.png", "pdf": "choice.pdf"},
        params={"spread": 0.01},
    )
    row = pd.read_csv(tmp_path / "table.csv").iloc[0]
    assert row["pga_collapse_g"] == 0.171
    assert row["pga_safe_g"] == 0.169  # 0.170 and 1 % of it reach the lowest that fell
    assert 0.169 < row["pga_median_g"] < 0.180
