"""Finished runs beside each other: models that are gone, tables with blank columns."""

import warnings

import pandas as pd
import pytest
from rocking.runs.finished import curves_of, models_gone
from rocking.tables import read_tables, together


def test_a_run_of_a_model_that_is_gone_is_told_in_one_line(tmp_path):
    path = tmp_path / "ida_collapse.csv"
    path.write_text("model,record,pga_safe_g\nW1,A,0.2\nW9,A,0.1\nW8,B,0.1\n")
    said = models_gone(path)
    assert said.startswith(f"{path}: no model W8, W9 any more; expected W1, ")
    assert "\n" not in said
    path.write_text("model,record,pga_safe_g\nW1,A,0.2\n")
    assert models_gone(path) == ""
    assert curves_of(path) == [{"model": "W1", "record": "A", "pga_safe_g": "0.2"}]


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
