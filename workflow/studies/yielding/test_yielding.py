"""What a yielding building changes: arithmetic of losses, and the limit of a strong one."""

import numpy as np
import pandas as pd
import pytest
from rocking import Motion
from study_cases import study_case

from studies.yielding import study

SETTINGS = {
    "base_shear_ratios": [10.0],
    "loops": ["bilinear"],
    "periods_s": [],
    "lowest_g": 0.08,
    "highest_g": 0.6,
    "amplitudes": 10,
}


def table_of(values):
    """Rows of curves: model, V/W, loops, and an equivalent PGA by record."""
    rows = []
    for (model, ratio, loops), pga in values.items():
        for k, one in enumerate(pga):
            key = {"model": model, "record": f"r{k}", "direction": "pos", "station": f"s{k}"}
            own = {"period_s": 0.27, "base_shear_ratio": ratio, "loops": loops}
            rows.append({**key, **own, "pga_equivalent_g": one, "building_first": float(k % 2)})
    return pd.DataFrame(rows)


def test_losses_are_geometric_means_over_the_same_curve():
    """0.5 and 0.5 of W1 elastic, 0.5 and 1 with V/W 0.2: losses of 1/2, and of 1 − √(1/2)."""
    table = table_of(
        {
            ("W1", np.nan, "elastic"): [0.4, 0.2, np.nan],
            ("W2", np.nan, "elastic"): [0.2, 0.1, 0.1],
            ("W2", 0.2, "bilinear"): [0.2, 0.2, 0.1],
        }
    )
    found = study.summary(table).set_index("loops")
    assert found.loc["elastic", "loss"] == pytest.approx(0.5)
    assert found.loc["bilinear", "loss"] == pytest.approx(1.0 - np.sqrt(0.5))
    assert found.loc["bilinear", "over_elastic"] == pytest.approx(2.0 ** (1.0 / 3.0))
    assert found["censored"].tolist() == [1, 1]
    assert found["own_period"].tolist() == [1, 1]
    assert found["loss_low"].isna().all()  # of three stations there is no interval


def test_intervals_draw_stations():
    """Of ten stations with losses of 30 and 60 % in turn the interval is about their mean."""
    pairs = [0.7, 0.4] * 5
    table = table_of({("W1", np.nan, "elastic"): [1.0] * 10, ("W2", 0.2, "bilinear"): pairs})
    elastic = table_of({("W2", np.nan, "elastic"): pairs})
    found = study.summary(pd.concat([table, elastic])).iloc[0]
    mean = 1.0 - np.sqrt(0.28)
    assert found["loss"] == pytest.approx(mean)
    assert 0.3 < found["loss_low"] < mean < found["loss_high"] < 0.6
    assert found["building_first"] == 0.5


def test_other_periods_than_w1s_are_of_the_map():
    table = table_of({("W1", np.nan, "elastic"): [0.4], ("W2", 0.2, "bilinear"): [0.2]})
    slow = table[table["model"] == "W2"].assign(period_s=0.6)
    found = study.summary(pd.concat([table, slow])).set_index("period_s")
    assert found["own_period"].to_dict() == {0.27: 1, 0.6: 0}
    assert found.loc[0.6, "loss"] == found.loc[0.27, "loss"]


def test_other_periods_take_the_first_loops():
    case = study_case("W2")
    settings = {**SETTINGS, "base_shear_ratios": [0.1, 0.2], "loops": ["flag", "bilinear"]}
    found = study.variants(case, {**settings, "periods_s": [0.15]}, "here")
    alike = [(v.about["period_s"], v.about["loops"]) for v in found]
    assert alike.count((0.15, "flag")) == 2
    assert alike.count((0.15, "bilinear")) == 0
    assert alike.count((0.27, "bilinear")) == 2
    walls = study.variants(study_case("W1"), settings, "here")
    assert [v.about["loops"] for v in walls] == ["elastic"]


@pytest.mark.slow
def test_a_strong_building_loses_what_the_elastic_one_does():
    table = study.collapse(study_case("W2"), Motion.named("RRS228"), "neg", SETTINGS, "here")
    elastic, strong = table.to_dict("records")
    for name in ("pga_equivalent_g", "pga_collapse_g", "runs_planar"):
        assert strong[name] == elastic[name]
    assert np.isnan(elastic["pga_building_g"])
