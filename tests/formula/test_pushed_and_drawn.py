"""Pushover curves' peaks and joints, and distributions of a class, by hand."""

import numpy as np
import pandas as pd
import pytest
from rocking import pushover

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
