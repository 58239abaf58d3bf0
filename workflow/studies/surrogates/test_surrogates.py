"""How far surrogates stand for their records: ratios and weak sides."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
from run_script import script

from studies.surrogates import study as surrogates


def rows(scatter, keep_side):
    rng = np.random.default_rng(5)
    out = []
    for i in range(400):
        for sign, direction in ((1.0, "pos"), (-1.0, "neg")):
            real = 0.3 * np.exp(0.4 * sign)
            side = sign if keep_side else -sign
            made = 1.1 * 0.3 * np.exp(0.4 * side + scatter * rng.standard_normal())
            own = (f"R{i}", f"S{i // 2}", "W1", direction)
            for kind, pulses, value in (("recorded", None, real), ("surrogate", 0, made)):
                out.append((*own, kind, pulses, pulses, 0, value, value, 3.0))
    return pd.DataFrame(out, columns=surrogates.COLUMNS)


def test_summary_returns_the_distribution_that_made_the_ratios():
    table = surrogates.summary(rows(0.1, keep_side=True))
    whole = table[table["half"] == "all"].iloc[0]
    assert whole["n"] == 800
    assert whole["ratio_median"] == pytest.approx(1.1, rel=0.02)
    assert whole["scatter"] == pytest.approx(0.1, rel=0.1)
    assert whole["side_agrees"] == 1.0
    halves = table[table["half"] != "all"]
    assert halves["n"].sum() == 800
    lost = surrogates.summary(rows(0.05, keep_side=False)).iloc[0]
    assert lost["side_agrees"] == 0.0
    assert lost["scatter"] == pytest.approx(0.8, rel=0.05)


@pytest.mark.parametrize("directions", [["pos", "neg"], ["pos"]])
def test_the_figure_is_drawn_of_one_direction_too(tmp_path, directions):
    """One direction has no weak side: no second row of panels, and nothing of it in the table."""
    table = rows(0.1, keep_side=True)
    table = table[table["direction"].isin(directions) & table["record"].isin(["R0", "R1", "R2"])]
    found = surrogates.summary(table)
    assert found["side_agrees"].isna().all() == (len(directions) == 1)
    paths = {"table": "t.csv", "summary": "s.csv", "facts": []}
    table.to_csv(tmp_path / "t.csv", index=False)
    found.to_csv(tmp_path / "s.csv", index=False)
    given = {"input": paths, "params": {"study": "surrogates"}}
    script("figure", tmp_path, output={"png": "figure.png"}, **given)
    high = plt.imread(tmp_path / "figure.png").shape[0]
    assert (high > 700) == (len(directions) == 2), high


def test_both_components_of_a_station_are_in_one_half_and_what_never_fell_is_counted():
    table = rows(0.1, keep_side=True)
    halves = surrogates.half_of(table["station"])
    assert table.assign(half=halves).groupby("station")["half"].nunique().max() == 1
    table.loc[(table["kind"] == "surrogate") & (table["record"] == "R0"), "pga_half_g"] = np.nan
    whole = surrogates.summary(table).iloc[0]
    assert whole["n_censored"] == 2
