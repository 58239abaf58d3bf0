"""The figure of perturbed ensembles: a panel a curve, in rows, and none that is empty."""

import numpy as np
import pandas as pd
import pytest
from PIL import Image
from run_script import script


def ensemble(folder, model, direction):
    """Eleven realisations at two levels, some of which fell; and a dense scan."""
    curve = {"model": model, "record": "R", "direction": direction}
    fell = np.arange(22) % 3 == 0
    rows = pd.DataFrame({"pga_g": np.repeat([0.20, 0.21], 11), "realisation": np.arange(22) % 11})
    rows["d_over_b"] = np.where(fell, 1.0, 0.4)
    rows["collapsed"], rows["status"] = fell, np.where(fell, "overturned", "ok")
    scan = pd.DataFrame({"pga_g": np.linspace(0.1, 0.3, 60)})
    scan["collapsed"] = scan["pga_g"] > 0.205
    scan["d_over_b"] = np.where(scan["collapsed"], 1.0, 0.4)
    scan["status"] = np.where(scan["collapsed"], "overturned", "ok")
    paths = []
    for kind, table in (("ensemble", rows), ("scan", scan)):
        paths.append(str(folder / f"{kind}_{model}_{direction}.csv"))
        table.assign(**curve)[[*curve, *table.columns]].to_csv(paths[-1], index=False)
    return paths


@pytest.mark.slow
@pytest.mark.parametrize(("count", "ratio"), [(8, 1.5), (3, 1.0), (0, 1.0)])
def test_curves_stand_in_rows_of_four(tmp_path, count, ratio):
    names = [
        (model, direction) for model in ("W1", "W2", "W1c", "W2c") for direction in ("pos", "neg")
    ]
    paths = [ensemble(tmp_path, *name) for name in names[:count]]
    picture = tmp_path / "chaos.png"
    script(
        "figure_chaos",
        tmp_path,
        input={"ensembles": [e for e, _ in paths], "scans": [s for _, s in paths], "facts": []},
        output={"png": str(picture), "pdf": str(tmp_path / "chaos.pdf")},
        params={"percentiles": [10, 90], "spread": 0.01},
    )
    with Image.open(picture) as image:
        assert ratio < image.width / image.height < 3.0  # eight in one row were eight to one
