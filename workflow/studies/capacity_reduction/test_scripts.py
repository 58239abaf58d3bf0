"""Scripts of the study, run alone on small made-up results."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from made_curves import curve, record
from run_script import script

from smdof.chain import floor_motions, shear_chain
from yade_scripts.model.motion import SupportMotion

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("below", [0, 3])
def test_motion_of_a_facade_up_the_building_is_that_of_the_floors_it_stands_on(tmp_path, below):
    path = record(tmp_path, "R")
    out = {"motion": str(tmp_path / "m.csv"), "facts": str(tmp_path / "m.json")}
    chain = {"n_dof": 2, "damping_ratio": 0.05, "damping_model": "modal", "tail_s": 1.0}
    script(
        "capacity_reduction_motion",
        tmp_path,
        input={"record": path},
        output=out,
        params={"smdof": chain},
        wildcards={"t1": "0.3", "below": str(below)},
    )
    given = pd.read_csv(path)["acceleration_m_s2"].to_numpy()
    tail_s = np.log(1e4) * 0.3 / (2 * np.pi * 0.05)  # longer than the 1 s asked for
    whole = floor_motions(given, 0.01, shear_chain(below + 2, 0.3), tail_s=tail_s)
    levels = np.vstack([whole.ground_m_s2, whole.floors_m_s2])
    found = pd.read_csv(out["motion"])
    assert list(found.columns) == ["time_s", "ground_m_s2", "floor1_m_s2", "floor2_m_s2"]
    motions = found.to_numpy()[:, 1:].T
    np.testing.assert_allclose(motions, levels[below:], rtol=1e-6, atol=1e-7)
    for level in motions:  # YADE holds the last value, so what drives a support ends at zero
        driven = SupportMotion(found["time_s"].to_numpy(), level)
        np.testing.assert_array_equal(driven.acceleration_m_s2[: level.size], level)
        assert driven.acceleration_m_s2[-1] == 0.0 or abs(level[-1]) < 1e-9 * abs(level).max()
    speed = np.cumsum(levels[-1] - levels[0]) * 0.01
    assert np.abs(speed[-30:]).max() < 0.005 * np.abs(speed).max()  # at rest on the ground
    facts = json.loads(Path(out["facts"]).read_text())
    assert facts["base_height_ratio"] == pytest.approx(below / (below + 2))
    assert facts["base_peak_g"] == pytest.approx(np.abs(levels[below]).max() / 9.80665)
    assert (facts["base_peak_g"] > 1.2 * facts["pga_g"]) == (below > 0)


def test_capacity_ratio_is_in_ground_acceleration(tmp_path):
    """A façade that falls at a base peak of 0.3 g and sits where the peak doubles: ratio 1/2."""
    record(tmp_path, "R")
    case = tmp_path / "T0.3_below4"
    case.mkdir()
    facts = {
        "record": "R",
        "t1_s": 0.3,
        "masses_below": 4,
        "base_height_ratio": 0.5,
        "pga_g": 0.3,
        "base_peak_g": 0.6,
    }
    (case / "R.json").write_text(json.dumps(facts))
    w1 = [
        curve(tmp_path / "w1p.csv", "W1", "R", "pos", 0.29, 0.31),
        curve(tmp_path / "w1n.csv", "W1", "R", "neg", 0.29, 0.31),
    ]
    w2 = [
        curve(case / "R_pos.csv", "W2", "R", "pos", 0.29, 0.31),
        curve(case / "R_neg.csv", "W2", "R", "neg", 3.0, None),
    ]
    out = {"table": "t.csv", "png": "f.png", "pdf": "f.pdf"}
    script(
        "figure_capacity_reduction",
        tmp_path,
        input={
            "w1": w1,
            "w2": w2,
            "w1_scans": w1,  # two amplitudes make a scan
            "w2_scans": w2,
            "facts": [str(case / "R.json")],
            "records": [str(tmp_path / "R.json")],
        },
        output={k: str(tmp_path / v) for k, v in out.items()},
        params={"spread": 0.01, "hazard_slope": 2.0, "w1": w1, "w2": w2},
    )
    table = pd.read_csv(tmp_path / "t.csv").set_index("direction")
    assert table.loc["pos", "ratio"] == pytest.approx(0.5)
    assert table.loc["pos", "ratio_equivalent"] == pytest.approx(0.5)
    assert np.isnan(table.loc["neg", "ratio_equivalent"])
    assert table["censored"].to_dict() == {"pos": 0, "neg": 1}
    assert table.loc["pos", "source"] == "surrogate"
    assert (tmp_path / "f.png").stat().st_size > 5000
