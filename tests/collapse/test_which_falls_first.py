"""Which falls first: the building's drift beside a curve, its probability, and a shock before."""

import numpy as np
import pandas as pd
import pytest
from rocking import Motion, collapse_curve
from rocking.collapse import building
from rocking.collapse.case import Variant

from tests.cases import yielding_cases
from yade_scripts.model import storeys
from yade_scripts.model.motion import amplitude

LIST = {"search": "list", "settings": {"pga_g": np.geomspace(0.05, 0.6, 12)}}


def scan(pga_g, fell):
    """Outcomes of a scan, as far as a building is told of."""
    return pd.DataFrame({"pga_g": pga_g, building.FELL: fell})


def test_the_drift_is_that_of_the_chain_alone():
    """At every amplitude, and the PGA where it comes to the stated share of a storey's height."""
    case = yielding_cases.case("W2", 0.15, "peak_oriented", fallen_drift_ratio=0.004)
    motion = Motion.named("RRS228")
    curve = collapse_curve(case, motion, "neg", **LIST)
    time_s, columns = motion.columns(case)
    chain = storeys.chain_of(case, time_s[1] - time_s[0])
    factor = amplitude(columns["ground"], "neg", curve.pga_g)
    _, states = storeys.march(chain, columns["ground"], factor[::4])
    drift = storeys.largest_drift(states).max(axis=1) / (6.48 / 4)
    assert curve.table[building.DRIFT][::4].to_numpy() == pytest.approx(drift, rel=1e-9)
    known = np.flatnonzero(curve.table[building.DRIFT] >= 0.004)[0]
    found = curve.summary()["pga_building_g"]
    assert curve.pga_g[known - 1] < found <= curve.pga_g[known]
    pushed = collapse_curve(
        yielding_cases.case("W2m", 0.15, "peak_oriented"), motion, "neg", **LIST
    )
    assert pushed.table[building.DRIFT].equals(curve.table[building.DRIFT])


def test_an_elastic_building_and_the_ground_are_never_said_to_fall():
    motion = Motion.named("RRS228")
    for case in (yielding_cases.case("W2", None), yielding_cases.case("W1", 0.1)):
        curve = collapse_curve(case, motion, "neg", **LIST)
        found = curve.summary()
        assert building.DRIFT not in curve.table
        assert np.isnan(found["pga_building_g"])
        assert np.isnan(found["building_first"])


@pytest.mark.parametrize(
    ("facade", "first"), [((0.3, 0.3), 0.0), ((0.5, 0.4), 1.0), ((np.nan, np.nan), 1.0)]
)
def test_who_falls_first(facade, first):
    """A building that falls from 0.4 g on, before a façade that falls at 0.3, 0.5 g and never."""
    pga_g = np.geomspace(0.1, 1.0, 200)
    table = scan(pga_g, (pga_g >= 0.4).astype(int))
    median, lowest = facade
    said = building.told(table, {"pga_median_g": median, "pga_collapse_g": lowest}, 0.03)
    assert said["pga_building_g"] == pytest.approx(0.4, rel=0.02)
    assert said["building_first"] == first
    share = building.building_share(table, np.array([0.3, 0.4, 0.5]), 0.03)
    assert share[[0, 2]].tolist() == [0.0, 1.0]
    assert 0.3 < share[1] < 0.7


def test_a_building_that_stands_is_not_first():
    table = scan([0.1, 0.2], [0, 0])
    said = building.told(table, {"pga_median_g": 0.15, "pga_collapse_g": 0.15}, 0.03)
    assert np.isnan(said["pga_building_g"])
    assert said["building_first"] == 0.0


@pytest.mark.parametrize("model", ["W2", "W2m"])
def test_a_first_shock_leaves_the_building_damaged(model):
    """Peak-oriented storeys that yielded are softer in the second shock; elastic ones are not."""
    second = Motion.named("RRS228")
    after = second.varied(Variant(motion={"first": second, "first_pga_g": 0.1}))
    how = {"search": "list", "settings": {"pga_g": [0.03, 0.05]}}
    for ratio, same in ((0.05, False), (None, True)):
        case = yielding_cases.case(model, ratio, "peak_oriented")
        alone, damaged = (
            collapse_curve(case, motion, "neg", **how).table["d_over_b"].to_numpy()
            for motion in (second, after)
        )
        # the first shock's own peak is the larger where the façade stood
        assert np.all(damaged >= alone * (1.0 - 1e-9))
        drift = collapse_curve(case, after, "neg", **how).table.get(building.DRIFT)
        assert (drift is None) is same
        if not same:
            fresh = collapse_curve(case, second, "neg", **how).table[building.DRIFT]
            assert np.all(drift > 1.5 * fresh)
