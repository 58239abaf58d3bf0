"""Friction: worth nothing where nothing slides; below the block's slope it slides first."""

import numpy as np
import pandas as pd
import pytest
from rocking import Case, Motion
from rocking.records import Record

from studies.friction import study as friction

SHORT = {"numerics.after_motion_s": 3.0, "smdof.tail_s": 1.0, "ida.max_pga_g": 1.0}


@pytest.fixture(scope="module")
def table():
    t = 0.01 * np.arange(160)
    pulse = Motion(Record("pulse", -np.sin(2.5 * np.pi * t) * (t < 0.8), 0.01, source="file"))
    settings = {"angles_deg": [40, 30, 3]}
    return friction.collapse(Case.configured("W1", SHORT), pulse, "pos", settings)


def test_friction_is_worth_nothing_where_nothing_slides(table):
    assert table["ratio"].iloc[1] == pytest.approx(1.0, abs=0.02)


def test_a_block_on_less_friction_than_its_slope_slides_first_and_falls_later(table):
    """It slides at tan 3° = 0.052 g, before it would rock at b/h = 0.058 g."""
    assert table["ratio"].iloc[2] > 1.05


def test_summary_counts_what_never_collapsed():
    rows = [("W1", 30, 1.0), ("W1", 30, 0.8), ("W1", 30, np.nan)]
    (row,) = friction.summary(
        pd.DataFrame(rows, columns=["model", "friction_deg", "ratio"])
    ).to_dict("records")
    assert (row["n"], row["n_censored"], row["median"]) == (3, 1, pytest.approx(0.9))
