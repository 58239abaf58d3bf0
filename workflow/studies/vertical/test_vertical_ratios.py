"""Ratios of collapse with vertical motion to that without, on tables made by hand."""

import numpy as np
import pandas as pd
import pytest

from studies.vertical import study as vertical


def table(whole, none=0.4):
    """Curves that fall at `none` without vertical motion and at `whole` with it [g]."""
    rows = []
    for k, value in enumerate(whole):
        for name, pga_g in (("none", none), ("hundredth", none), ("whole", value)):
            rows.append((f"R{k}", "A", "W1", "pos", name, 0.6, pga_g, 1.1 * pga_g, 10))
    return pd.DataFrame(rows, columns=vertical.COLUMNS)


def test_a_vertical_motion_that_halves_the_collapse_intensity_has_a_ratio_of_one_half():
    found = vertical.ratios(table([0.2, 0.5]))
    whole = found[(found["vertical"] == "whole") & (found["measure"] == "p10")]
    assert whole.set_index("record")["ratio"].to_dict() == pytest.approx({"R0": 0.5, "R1": 1.25})
    assert (found[found["vertical"] == "hundredth"]["ratio"] == 1.0).all()


def test_the_scatter_is_that_of_the_logarithm():
    """Ratios 1/2, 1.02 and 3/2: scatter as of their logarithms, one of three within 5 %."""
    ratio = np.array([0.5, 1.02, 1.5])
    found = vertical.summary(table([*(0.4 * ratio), np.nan])).set_index(["measure", "vertical"])
    row = found.loc[("median", "whole")]
    mean = np.log(ratio).mean()
    assert row["scatter"] == pytest.approx(np.sqrt(((np.log(ratio) - mean) ** 2).sum() / 2.0))
    assert (row["ratio_min"], row["ratio_median"], row["ratio_max"]) == pytest.approx(tuple(ratio))
    assert (row["n"], row["n_censored"]) == (4, 1)
    assert row["within_5_percent"] == pytest.approx(1.0 / 3.0)
    assert found.loc[("median", "hundredth"), "scatter"] == 0.0
