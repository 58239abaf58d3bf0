"""Shake-table runs: displacements are from where the tilted wall rests."""

import math

import numpy as np
import pytest
from studies.calibration import shake_table

ABOUT = dict.fromkeys(shake_table.ABOUT, "x")
FACADE = {"height_m": 2.0, "thickness_m": 0.25, "tilt_deg": 0.3}
TEST = {"about": ABOUT, "beta_s": 1e-3, "config": {"facade": FACADE}}
REST_MM = 2e3 * math.sin(math.radians(0.3))


def done(status):
    return {"d_m": 1e-3 * (REST_MM + np.array([0.0, 40.0, -5.0, 1.0])), "status": status}


def test_displacement_is_from_the_rest_position():
    assert shake_table.rest_mm(TEST) == pytest.approx(REST_MM)
    np.testing.assert_allclose(
        shake_table.relative_mm(TEST, done("ok")), [0.0, 40.0, -5.0, 1.0], atol=1e-9
    )


@pytest.mark.parametrize(
    ("status", "value"), [("ok", 40.0), ("overturned", 250.0), ("failed", None)]
)
def test_a_fallen_wall_has_moved_by_its_thickness(status, value):
    found = shake_table.largest_mm(TEST, done(status))
    assert math.isnan(found) if value is None else found == pytest.approx(value)
    row = shake_table.row_of(TEST, done(status))
    assert set(row) == set(shake_table.COLUMNS)
    assert row["overturned"] == {"ok": 0, "overturned": 1, "failed": ""}[status]
    assert (row["peak_mm"] == "40.00") == (status == "ok")
    assert (row["lowest_mm"] == "-5.00") == (status != "failed")
