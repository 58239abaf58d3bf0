"""Ratios of collapse intensities: what of them is known, where they lie, how they scatter."""

import numpy as np
import pandas as pd
import pytest
from rocking.collapse.ratios import Ratios, spread


def test_what_never_collapsed_counts_but_has_no_ratio():
    found = Ratios([0.5, np.nan, 2.0, np.inf])
    assert (found.n, found.n_known, found.n_censored) == (4, 2, 2)
    assert found.known.tolist() == [0.5, 2.0]


def test_the_middle_of_two_ratios():
    """1/2 and 2: 5/4 between the ratios, 1 between their logarithms, which scatter by √2 ln 2."""
    found = Ratios([0.5, 2.0])
    assert found.percentiles([50.0]) == pytest.approx([1.25])
    assert found.percentiles([50.0], log=True) == pytest.approx([1.0])
    assert found.mean == pytest.approx(1.0)
    assert found.scatter == pytest.approx(np.sqrt(2.0) * np.log(2.0))


def test_a_share_is_open_below_and_closed_above():
    found = Ratios([0.9, 1.0, 1.1, np.nan])
    assert found.share(high=1.0) == pytest.approx(2.0 / 3.0)
    assert found.share(low=1.0) == pytest.approx(1.0 / 3.0)
    assert np.isnan(Ratios([np.nan]).share())
    assert np.isnan(Ratios([]).percentiles([50.0])).all()
    assert np.isnan(Ratios([1.0]).scatter)


def test_groups_come_in_their_order_with_what_is_asked_of_them():
    """A percentile by number, an attribute by name, a function; a group without ratios is blank."""
    rows = [("b", 1, 0.5), ("a", 1, np.nan), ("b", 1, 2.0), ("b", 2, 0.7)]
    table = pd.DataFrame(rows, columns=["model", "kind", "ratio"])
    columns = {"n": "n", "median": 50, "mean": "mean", "above": lambda found: found.share(low=1.0)}
    found = spread(table, ["model", "kind"], columns)
    assert found[["model", "kind", "n"]].to_numpy().tolist() == [
        ["b", 1, 2],
        ["a", 1, 1],
        ["b", 2, 1],
    ]
    assert found["median"].tolist() == pytest.approx([1.25, np.nan, 0.7], nan_ok=True)
    assert found["mean"].tolist() == pytest.approx([1.0, np.nan, 0.7], nan_ok=True)
    assert found["above"].tolist() == pytest.approx([0.5, np.nan, 0.0], nan_ok=True)
