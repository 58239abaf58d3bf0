"""Tables with blank columns, put together."""

import warnings

import pandas as pd
import pytest
from rocking.tables import read_tables, together


@pytest.fixture
def blank():
    """Three tables: with a blank column, with another column, without rows."""
    return [
        pd.DataFrame({"model": ["W1"], "pga_g": [0.2], "fell": [True]}),
        pd.DataFrame({"model": ["W2"], "pga_g": [None], "fell": [False], "more": ["x"]}),
        pd.DataFrame({"model": [], "pga_g": []}),
    ]


def test_blank_columns_warn_of_nothing_and_are_kept(blank, tmp_path):
    """A line of pandas a curve hides what matters on the terminal."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = together(blank)
    assert list(found.columns) == ["model", "pga_g", "fell", "more"]
    assert list(found.index) == [0, 1]
    assert list(together(blank[1::-1]).columns) == ["model", "pga_g", "fell", "more"]
    assert found["pga_g"].dtype == float
    assert found["fell"].tolist() == [True, False]
    assert found["model"].tolist() == ["W1", "W2"]
    assert together(blank[2:]).columns.tolist() == ["model", "pga_g"]
    paths = [tmp_path / f"{k}.csv" for k in range(3)]
    for path, table in zip(paths, blank, strict=True):
        table.to_csv(path, index=False)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert read_tables(paths).equals(found)


def test_a_column_that_is_blank_in_all_stays(blank):
    both = [table.assign(none=None) for table in blank[:2]]
    assert "none" in together(both)
    assert together(both)["none"].isna().all()
