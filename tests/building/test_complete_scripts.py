"""Scripts of the complete building, run alone: where a curve begins, and its tables."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from rocking.collapse import probability
from run_script import script

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]


def test_a_curve_begins_inside_the_first_range_of_the_scan(tmp_path):
    """The gap between two ranges and the second are looked at too; without a collapse, the end."""
    pga = 0.1 * 1.01 ** np.arange(120)
    fell = ((pga > 0.15) & (pga < 0.18)) | (pga > 0.2)
    for name, values in (("falls", fell), ("stands", 0 * fell)):
        scan = pd.DataFrame({"pga_g": pga, "collapsed": values.astype(int)})
        scan["status"] = np.where(values, "overturned", "ok")
        scan.to_csv(tmp_path / f"{name}.csv", index=False)
        script(
            "complete_plan",
            tmp_path,
            input={"scan": f"{name}.csv"},
            output={"plan": f"{name}.json"},
            params={"spread": 0.01, "step": 0.05, "most": 4},
        )
    plan = json.loads((tmp_path / "falls.json").read_text())
    assert plan["start_g"] == pytest.approx(1.05 * pga[pga > 0.15][0], abs=1e-3)
    assert plan["ranges"] == pytest.approx([0.19, 0.5 * (0.2 + pga[-1])], abs=0.004)
    plan = json.loads((tmp_path / "stands.json").read_text())
    assert plan == {"start_g": pytest.approx(pga[-1], abs=1e-4), "ranges": []}


def test_curves_are_tabled_in_the_form_of_the_other_models(tmp_path):
    """A row a curve; what YADE found at a level beside the scan; a failed run is neither."""
    head = "model,record,direction,pga_g,d_over_b,collapsed,status,dt_s,steps,wall_s\n"
    rows = ["0.20,0.4,0,ok", "0.21,1,1,overturned", "0.22,0.6,0,ok", "0.23,,,failed"]
    rows += ["0.24,1,1,overturned"]
    text = "".join(f"CB,shake,neg,{row},4e-4,1000,0.5\n" for row in rows)
    (tmp_path / "curve.csv").write_text(head + text)
    pga = 0.2 + 0.005 * np.arange(9)
    scan = pd.DataFrame({"model": "CB", "record": "shake", "direction": "neg", "pga_g": pga})
    fell = pga > 0.2075
    scan["collapsed"], scan["status"] = fell.astype(int), np.where(fell, "overturned", "ok")
    scan.to_csv(tmp_path / "scan.csv", index=False)
    scan.assign(direction="pos").to_csv(tmp_path / "lone.csv", index=False)
    script(
        "table_complete_collapse",
        tmp_path,
        input={"ida": ["curve.csv"], "scans": ["scan.csv", "lone.csv"]},
        output={"collapse": "collapse.csv", "probability": "probability.csv"},
        params={"spread": 0.01},
    )
    table = pd.read_csv(tmp_path / "collapse.csv")
    assert list(table.columns) == probability.COLUMNS
    row = table.iloc[0]
    assert row[["pga_safe_g", "pga_collapse_g", "pga_all_g"]].tolist() == [0.205, 0.21, 0.225]
    assert row[["runs_planar", "runs_yade", "disagreements"]].tolist() == [9, 5, 1]
    assert row["reversals"] == 0
    lone = table.iloc[1]  # the record's other direction has a scan alone
    assert lone[["pga_safe_g", "pga_collapse_g", "runs_yade"]].tolist() == [0.205, 0.21, 0]
    share = pd.read_csv(tmp_path / "probability.csv")
    assert share.loc[share["direction"] == "pos", "realisations_yade"].fillna(0).eq(0).all()
    share = share[share["direction"] == "neg"]
    assert list(share.columns) == probability.PROBABILITY_COLUMNS
    own = share[share["realisations_yade"] == 1]
    assert own["pga_g"].tolist() == [0.20, 0.21, 0.22, 0.24]
    assert own["probability_yade"].tolist() == [0.0, 1.0, 0.0, 1.0]
    assert own["probability"].tolist() == [0.0, 1.0, 1.0, 1.0]
    assert len(share) == 9 + 4
    script(
        "figure_complete",
        tmp_path,
        input={"ida": ["curve.csv"], "scans": ["scan.csv"], "facts": []},
        output={"png": "figure.png", "pdf": "figure.pdf"},
        params={"spread": 0.01},
    )
    assert (tmp_path / "figure.png").stat().st_size > 10_000
