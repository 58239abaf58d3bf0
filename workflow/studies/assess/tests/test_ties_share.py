"""Under what share of all motions a façade stands, without and with its rows of ties."""

import numpy as np
import pytest
from rocking import Case, Motion
from rocking.collapse.case import Variant
from rocking.records import Record
from studies.assess.rods import row_of_rods
from studies.assess.ties_share import COLUMNS, shares

RODS = {"count": 2, "length_m": 4.0, "yield_mpa": 235.0, "elongation": 0.05, "slack_mm": 0.0}
FEW = {"numerics.after_motion_s": 0.5}
PGA_G = 0.25


def pulse(period_s):
    """One cycle: it overturns the façade of 6.48 m at 0.25 g where it is long."""
    time_s = np.arange(0.0, 4.0, 0.01)
    wave = np.sin(2.0 * np.pi * time_s / period_s) * (time_s < period_s)
    return Motion(Record(f"cycle of {period_s} s", wave, 0.01, "file"))


@pytest.mark.slow
def test_a_strong_row_holds_what_a_long_pulse_overturns():
    case = Case.configured("W1").varied(Variant("few", FEW))
    shaken = [(pulse(period_s), "pos") for period_s in (0.1, 2.0)]
    bare, tied = shares([case], [row_of_rods(RODS, 6.0, 60.0)], shaken, PGA_G)
    assert list(bare) == COLUMNS
    assert (bare["rows"], bare["curves"], bare["stood"], bare["share_stands"]) == (0, 2, 1, 0.5)
    assert (tied["rows"], tied["stood"], tied["share_stands"]) == (1, 2, 1.0)
    assert tied["pga_g"] == bare["pga_g"] == PGA_G
    assert len(shares([case], [], shaken[:1], PGA_G)) == 1  # no row is needed, or none helps
    assert [shares([case], [], shaken, pga_g)[0]["stood"] for pga_g in (0.07, 0.1)] == [2, 1]


def test_a_history_that_failed_counts_neither_way(monkeypatch):
    class Found:
        def __init__(self, status):
            self.status = np.array([status], object)

    outcomes = [Found(status) for status in ("ok", "overturned", "ok", "failed")]
    name = "studies.assess.ties_share.collapse_curves"
    monkeypatch.setattr(name, lambda case, shaken, search, settings: outcomes[: len(shaken)])
    case = Case.configured("W1")
    (row,) = shares([case], [], [(None, "pos")] * 4, PGA_G)
    assert (row["curves"], row["stood"], row["failed"]) == (4, 2, 1)
    assert row["share_stands"] == pytest.approx(2.0 / 3.0)
    outcomes = outcomes[3:]
    (row,) = shares([case], [], [(None, "pos")], PGA_G)
    assert np.isnan(row["share_stands"])
