"""What a reported curve holds of the reference solver's dense probability."""

import math

import numpy as np
import pandas as pd
import pytest
from studies.accuracy import coverage
from yade_process import resolved

SPREAD = 0.01


def reported(**values):
    row = dict.fromkeys(("collapse", "p10", "median", "p90"), 0.4) | values
    key = {"model": "W2", "record": "quake", "direction": "pos", "reversals": 0}
    return key | {f"pga_{name}_g": value for name, value in row.items()}


def scanned(fell, low=0.3, high=0.6, step=0.001):
    """Scan whose outcomes a function of the amplitude gives; every tenth is a coarse level."""
    pga_g = np.exp(np.arange(math.log(low), math.log(high), step))
    outcome = np.array([int(fell(g)) for g in pga_g])
    level = (np.arange(pga_g.size) % 10 == 0).astype(int)
    status = np.where(outcome, "overturned", "ok")
    return pd.DataFrame({"pga_g": pga_g, "level": level, "status": status, "collapsed": outcome})


def test_a_sharp_threshold_is_covered_by_its_own_ramp():
    """Counted within ± 1 %, a threshold at 0.4 g is a ramp: 0.8 of it lies within ± 0.8 %."""
    table = scanned(lambda g: g >= 0.4)
    found = coverage.compare(table, reported(p10=0.4 * 0.992, p90=0.4 * 1.008), SPREAD)
    assert found["coverage"] == pytest.approx(0.8, abs=0.06)  # steps of 0.1 %: ten a side
    assert found["coverage_pooled"] == pytest.approx(found["coverage"])
    assert found["reference_median_g"] == pytest.approx(0.4, rel=2e-3)
    assert found["reference_collapse_g"] == pytest.approx(0.4, rel=0.011)
    assert found["reference_collapse_g"] >= found["reference_fine_g"] >= 0.4
    shifted = coverage.compare(table, reported(p10=0.4 * 1.012, p90=0.4 * 1.028), SPREAD)
    assert shifted["coverage"] == pytest.approx(0.0, abs=0.01)


def test_a_separate_range_counts_where_it_is_first_reached():
    """All fall from 0.40 to 0.44 g, none up to 0.5 g, all above: first reached at 0.40 g."""
    table = scanned(lambda g: 0.40 <= g < 0.44 or g >= 0.5)
    found = coverage.compare(table, reported(p10=0.397, p90=0.403), SPREAD)
    assert found["coverage"] > 0.7
    assert found["coverage_pooled"] < 0.6
    assert found["reference_p90_g"] == pytest.approx(0.403, rel=2e-3)
    assert found["reference_reversals"] == 2
    until = coverage.compare(table, reported(p10=0.39, p90=0.47), SPREAD)  # in the gap: none falls
    assert until["coverage"] == pytest.approx(1.0)


def test_what_is_never_reached_lies_above_everything():
    table = scanned(lambda g: (1000 * g) % 2 < 1)
    assert coverage.coverage(table["pga_g"], 0.0 * table["pga_g"] + 0.5, math.nan, math.nan) == (
        0.0,
        0.0,
    )
    found = coverage.compare(table, reported(p10=0.2, p90=math.nan), SPREAD)
    assert 0.4 < found["coverage"] < 0.75


def test_a_failed_history_is_no_outcome():
    table = scanned(lambda g: g >= 0.4)
    table.loc[table["pga_g"] < 0.35, ["status", "collapsed"]] = ["failed", 1]
    assert coverage.compare(table, reported(), SPREAD)["reference_fine_g"] == pytest.approx(
        0.4, rel=2e-3
    )


def test_the_scan_finds_both_sides_of_a_pulse(tmp_path):
    """One slow cycle overturns W1 once, from some amplitude on; the fine levels surround it."""
    t = np.arange(0.0, 2.5, 0.01)
    ground = np.where(t < 1.2, np.sin(2.0 * np.pi * t / 1.2), 0.0)
    path = tmp_path / "motion.csv"
    pd.DataFrame({"time_s": t, "ground_m_s2": ground}).to_csv(path, index=False)
    job = {**resolved(), "model": "W1", "beta_s": 0.00276}
    settings = {**job["ida"], "reference_nodes": 5, "reference_tolerance": 1e-5}
    settings |= {"level_ratio": 0.05, "reference_scan_step": 0.01, "max_pga_g": 2.0}
    settings["amplitude_spread"] = 0.03
    table = coverage.scan(job, path, "neg", settings, 0.025)
    coarse = table[table["level"] == 1]
    first = coarse.loc[coarse["collapsed"] == 1, "pga_g"].min()
    assert table["pga_g"].is_monotonic_increasing
    assert coarse["pga_g"].iloc[0] == pytest.approx(0.025)
    assert coarse.tail(7)["collapsed"].all()  # a factor 1.35 in steps of 5 %
    fine = table[table["level"] == 0]
    assert fine["pga_g"].min() == pytest.approx(0.97**2 / 1.05 * first)
    assert set(fine["collapsed"]) == {0, 1}
    found = coverage.compare(table, reported(p10=0.9 * first, p90=math.nan), 0.03)
    assert found["coverage"] == pytest.approx(1.0, abs=0.2)  # the fine scan ends where all fall
