"""The dynamic answer of one model: median, share at the demand, and rate, by closed forms."""

import numpy as np
import pandas as pd
import pytest
from studies.assess.dynamic_answer import answer
from studies.shared.hazard import Hazard

K0, K = 2e-4, 2.3
HAZARD = Hazard("pga_g", np.array([0.1, 1.0]), K0 * np.array([0.1, 1.0]) ** -K)
PGA_G = np.exp(np.linspace(-0.6, 0.6, 13)) * 0.4
DEMAND_G = 0.3


def curves(pga_g):
    names = [f"R{i}" for i in range(len(pga_g))]
    return pd.DataFrame(
        {
            **{"model": "W1", "record": names},
            **{"pga_median_g": pga_g, "pga_max_g": 2.0, "runs_planar": 10},
        }
    )


def test_curves_that_all_collapse_have_their_own_median_and_jalayers_rate():
    table = curves(PGA_G)
    hazards = {"one": HAZARD, "twice": Hazard("pga_g", HAZARD.intensity, 2.0 * HAZARD.annual_rate)}
    row, curve, rates = answer(table, {r: r for r in table["record"]}, DEMAND_G, hazards, 400, 1)
    assert row["median_pga_g"] == pytest.approx(0.4, rel=1e-6)
    beta = np.std(np.log(PGA_G))
    assert row["dispersion"] == pytest.approx(beta, rel=1e-4)
    exact = K0 * 0.4**-K * np.exp(0.5 * (K * beta) ** 2)
    assert row["annual_rate"] == pytest.approx(exact, rel=1e-4)
    assert row["rate_low"] < exact < row["rate_high"]
    assert [one["hazard"] for one in rates] == ["one", "twice"]
    assert [one["annual_rate"] for one in rates] == pytest.approx([exact, 2.0 * exact], rel=1e-4)
    assert row["fell_at_demand"] == np.sum(PGA_G <= DEMAND_G)
    at = np.interp(DEMAND_G, curve["pga_g"], curve["probability"])
    assert row["probability"] == pytest.approx(at, abs=1e-3)
    assert row["probability_low"] < row["probability"] < row["probability_high"]
    width = np.log(row["ci_high_g"] / row["ci_low_g"])  # of 95 %: ± 1.96 standard errors
    assert width == pytest.approx(2.0 * 1.96 * beta / np.sqrt(PGA_G.size), rel=0.15)


def test_curves_that_stand_raise_the_median_above_those_that_fall():
    pga_g = np.append(PGA_G, [np.nan] * 6)
    table = curves(pga_g)
    row, _, rates = answer(table, {r: r for r in table["record"]}, DEMAND_G, {}, 100, 1)
    assert row["never_collapsed"] == 6
    assert row["median_pga_g"] > 1.2 * 0.4
    assert "annual_rate" not in row
    assert rates == []


def test_six_stations_give_no_interval_however_many_motions():
    table = curves(PGA_G)
    stations = {record: f"S{i % 6}" for i, record in enumerate(table["record"])}
    row, curve, rates = answer(table, stations, DEMAND_G, {"one": HAZARD}, 100, 1)
    assert curve is None
    assert rates == []
    assert np.isnan(row["annual_rate"])
    assert np.isnan([row["probability"], row["ci_low_g"], row["ci_high_g"]]).all()
    assert row["median_pga_g"] == pytest.approx(0.4, rel=1e-6)
