"""Pushover curves' peaks and joints, and distributions of a class, by hand."""

import numpy as np
import pandas as pd
import pytest
from rocking import pushover
from rocking.formula import classes, measures
from rocking.records import Record
from scipy.special import ndtr

D = np.linspace(0.0, 0.6, 601)


def curve(corrected, lower=0.9):
    upper = 0.1 * (1.0 - D)
    table = {"d_over_b": D, "lambda_kinematic": upper, "lambda_kinematic_lower": lower * upper}
    return pd.DataFrame(table).assign(lambda_dem=0.9 * corrected, lambda_dem_corrected=corrected)


def test_the_curve_between_its_bounds_has_their_lambda_and_one_that_enters_late_says_where():
    inside = pushover.summary(curve(0.095 * (1.0 - D)))
    assert inside["lambda0_dem"] == pytest.approx(0.095, rel=0.03)
    assert inside["ratio"] == pytest.approx(inside["lambda0_dem"] / 0.1)
    assert inside["lambda0_kinematic"] == pytest.approx(0.1)
    assert inside["d_over_b_inside"] == 0.0
    late = pushover.summary(curve(np.where(D < 0.2, 0.05, 0.095 * (1.0 - D))))
    assert late["d_over_b_inside"] == pytest.approx(0.2, abs=0.03)
    above = pushover.summary(curve(np.where(D < 0.3, 0.13, 0.095 * (1.0 - D))))
    assert above["d_over_b_inside"] == pytest.approx(0.3, abs=0.03)


def test_without_bounds_the_peak_is_that_of_the_curve_as_it_came_up_to_half():
    bump = 0.06 + 0.03 * np.exp(-(((D - 0.2) / 0.05) ** 2)) + 0.1 * (D > 0.55)
    table = curve(bump, lower=np.nan)
    found = pushover.summary(table, bonded=True)
    assert found["d_over_b_peak"] == pytest.approx(0.2)
    assert found["lambda_peak"] == pytest.approx(0.9 * 0.09)
    assert np.isnan([found["lambda0_dem"], found["d_over_b_inside"]]).all()


def test_bed_joints_of_one_wall_carry_the_courses_above_them():
    """γ t v h_b i of i courses above; two nodes of the same joint are summed, other walls not."""
    rows = [
        ("left bed 1 a", 0.1, 1.0, 300.0),
        ("left bed 1 b", 0.1, 1.0, 200.0),
        ("left bed 2 a", 0.1, 2.0, 150.0),
        ("right bed 1 a", 0.1, 1.0, 999.0),
        ("left head 1 a", 0.1, 1.0, 999.0),
    ]
    forces = pd.DataFrame(rows, columns=["joint", "d_over_b", "z_m", "normal_n"])
    sections = {
        "facade": {"height_m": 4.0, "density_kg_m3": 1800.0},
        "w3": {"course_height_m": 1.0, "overlap_m": 0.2},
        "return_wall": {"thickness_m": 0.3},
    }
    table = pushover.joint_forces(forces, sections).set_index("course")
    each = 1800.0 * pushover.closed_forms.GRAVITY_M_S2 * 0.3 * 0.2 * 1.0
    assert table["normal_n"].to_dict() == {1: 500.0, 2: 150.0}
    assert table["weight_n"].to_dict() == pytest.approx({1: 3 * each, 2: 2 * each})
    assert table["ratio"].to_dict() == pytest.approx({1: 500 / 3 / each, 2: 75 / each})
    ratio = pushover.friction_moment_ratio(table.reset_index())
    assert ratio.item() == pytest.approx((500.0 + 300.0) / (3 * each + 4 * each))


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
