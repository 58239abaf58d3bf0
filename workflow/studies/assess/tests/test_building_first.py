"""Which falls first at the demand: shares by hand, and what page 1 says."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from rocking import Case, Motion
from rocking.collapse.building import falls_at
from studies.assess import building_first
from studies.assess.catalogue import SAY

BUILDING = 0.2 * np.exp(np.linspace(-0.5, 0.5, 9))


def curves(facade, building, model="W2m"):
    """Tables of a façade and of its building, of as many records."""
    names = [f"r{k}" for k in range(len(facade))]
    about = {"model": model, "record": names, "direction": "pos"}
    whole = {"pga_building_g": building, "building_max_g": 3.0}
    return pd.DataFrame({**about, **whole}), pd.DataFrame(
        {**about, "pga_median_g": facade, "pga_max_g": 3.0}
    )


def rows_of(facade, building, demand_g=0.2):
    collapse, demanded = curves(facade, building)
    stations = {name: name for name in demanded["record"]}
    return building_first.answers(collapse, demanded, stations, demand_g, 200, 1)


def data_of(table, drift=0.005):
    return SimpleNamespace(
        tables={"building_first": table},
        relied="W2m",
        config={"smdof": {"fallen_drift_ratio": drift}},
        say=SAY,
    )


def test_half_of_the_buildings_are_down_at_their_median():
    facade = np.append(np.full(6, 1.0), [0.05, 0.05, np.nan])
    (row,) = rows_of(facade, BUILDING).to_dict("records")
    assert row["building_median_g"] == pytest.approx(0.2, rel=1e-3)
    assert row["building_probability"] == pytest.approx(0.5, abs=0.01)
    assert row["building_low"] < 0.5 < row["building_high"]
    assert row["building_fell_at_demand"] == 5
    assert row["building_first"] == pytest.approx(7.0 / 9.0)
    assert row["beyond_building"] == 1.0


def test_a_building_that_never_falls_is_not_first():
    (row,) = rows_of(np.full(9, 0.3), np.full(9, np.nan)).to_dict("records")
    assert row["building_first"] == 0.0
    assert row["building_fell_at_demand"] == 0
    assert row["beyond_building"] == 0.0


def test_one_curve_has_a_collapse_and_no_median():
    (row,) = rows_of(np.array([0.3]), np.array([0.1])).to_dict("records")
    assert row["building_fell_at_demand"] == 1
    assert row["building_first"] == 1.0
    assert np.isnan([row["building_median_g"], row["building_probability"]]).all()
    assert row["beyond_building"] == 0.0


def test_page_1_marks_a_facade_beyond_its_building_and_is_silent_of_an_elastic_one():
    beyond = building_first.said(data_of(rows_of(np.full(9, 0.4), BUILDING)))
    assert "comes to 0.5 % of drift with a probability of 50 % (W2m)" in beyond
    assert "lies beyond the building's, 0.2 g" in beyond
    before = building_first.said(data_of(rows_of(np.full(9, 0.1), BUILDING)))
    assert "in 0 % of the motions" in before
    assert "beyond" not in before
    table, demanded = curves(np.full(9, 0.1), np.nan)
    table["building_max_g"] = np.nan
    stations = {name: name for name in demanded["record"]}
    none = building_first.answers(table, demanded, stations, 0.2, 10, 1)
    assert list(none) == building_first.COLUMNS
    assert building_first.said(data_of(none)) == ""


def test_a_building_falls_where_its_drift_says():
    """Between two neighbouring amplitudes of the search; an elastic one never does."""
    keys = {"smdof.base_shear_ratio": 0.15, "facade.courses": 0}
    case, motion = Case.configured("W2", keys), Motion.named("RRS228")
    found = falls_at(case, motion, "neg", 2.0)
    _, columns = motion.columns(case)
    drifts = columns.drift_ratios(
        [-level * 9.80665 / np.abs(columns["ground"]).max() for level in (found / 1.021, found)]
    )
    assert drifts[0] < case["smdof"]["fallen_drift_ratio"] <= drifts[1]
    assert np.isnan(falls_at(case.varied({"smdof.base_shear_ratio": None}), motion, "neg", 2.0))
