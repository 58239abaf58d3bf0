"""Distributions of a class and measures of a motion, by hand."""

import numpy as np
import pandas as pd
import pytest
from rocking.records import Record
from scipy.special import ndtr

from studies.atlas import classes, measures


def test_quantiles_of_distributions():
    u = np.array([0.0, 0.25, 0.5, 1.0])
    uniform = {"distribution": "uniform", "low": 2.0, "high": 6.0}
    assert classes.quantile(uniform, u).tolist() == [2.0, 3.0, 4.0, 6.0]
    assert classes.quantile({"distribution": "value", "median": 3.0}, u).tolist() == [3.0] * 4
    choice = {"distribution": "choice", "values": [1, 5, 9, 13]}
    assert classes.quantile(choice, u).tolist() == [1.0, 5.0, 9.0, 13.0]
    free = {"distribution": "lognormal", "median": 2.0, "spread": 0.3}
    at = classes.quantile(free, ndtr(np.array([-1.0, 0.0, 2.0])))
    assert at == pytest.approx(2.0 * np.exp([-0.3, 0.0, 0.6]))
    cut = classes.quantile({**free, "low": 1.5, "high": 4.0}, u)
    assert cut[[0, 3]] == pytest.approx([1.5, 4.0])
    low, middle, high = ndtr(np.log(np.array([1.5, cut[2], 4.0]) / 2.0) / 0.3)
    assert middle == pytest.approx(0.5 * (low + high))
    above = classes.quantile({**free, "low": 1.5}, u[:3])
    assert above[0] == pytest.approx(1.5)


def test_measures_of_a_motion_are_those_at_a_pga_of_1_g():
    """Another amplitude changes none; the last is a mean of the two before it, over the sum 1."""
    t = 0.01 * np.arange(800)
    shape = np.sin(6.0 * t) * np.exp(-((t - 3.0) ** 2))
    records = [Record(name, k * shape, 0.01, "file") for name, k in (("A", 1.0), ("B", -3.0))]
    design = pd.DataFrame({"period_s": [0.2, 0.6]}, index=[4, 7])
    found = measures.factors(records, design, 0.05)
    for table in found.values():
        assert list(table.index) == [4, 7]
        assert table["A"].to_numpy() == pytest.approx(table["B"].to_numpy(), rel=1e-9)
    average, sa = found["sa_avg_2s_g"]["A"], found["sa_t1_g"]["A"]
    assert average.iloc[0] == average.iloc[1]
    both = average ** (1.0 - measures.AT_T1) * sa**measures.AT_T1
    assert found["sa_avg_2s_t1_g"]["A"].to_numpy() == pytest.approx(both.to_numpy())
    assert sa.iloc[0] != pytest.approx(sa.iloc[1], rel=0.05)
    speed = np.abs(np.cumsum(shape) * 0.01).max() * 100.0 / (np.abs(shape).max() / 9.80665)
    assert found["pgv_cm_s"]["A"].to_numpy() == pytest.approx(speed, rel=0.01)
