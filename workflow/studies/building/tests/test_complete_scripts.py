"""Scripts of the complete building, run alone: tables of its curves."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from rocking.collapse import probability
from run_script import script

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[4]


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
