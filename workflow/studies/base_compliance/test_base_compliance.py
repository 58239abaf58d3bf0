"""What the base of a rigid façade is worth: static tables, collapse of a pulse, the summary."""

import numpy as np
import pandas as pd
import pytest
from rocking import Motion
from rocking.collapse import curve as curves
from rocking.records import Record
from study_cases import study_case

from studies.base_compliance import study

SHORT = {"numerics.after_motion_s": 3.0, "smdof.tail_s": 1.0, "ida.max_pga_g": 1.0}


def test_static_curves():
    """Twenty courses and the column's base are near the column; E/h takes a third of its peak."""
    table = study.static({"study": study.FACADES["study"]})
    assert list(table) == study.STATIC
    inner = table[table["d_over_b"] <= 0.6]
    wall = inner["lambda_wall"].to_numpy()
    assert inner["lambda_courses"].to_numpy() == pytest.approx(wall, rel=0.01)
    assert inner["lambda_base_column"].to_numpy() == pytest.approx(wall, rel=0.03)
    share = table["lambda_base_study"].max() / table["lambda_wall"].max()
    assert share == pytest.approx(0.656, abs=0.01)
    assert (table["lambda_wall"] < table["lambda_rigid"])[table["d_over_b"] < 0.75].all()


@pytest.mark.slow
def test_collapse_under_a_pulse():
    """Half a sine outward: E/h falls far too early, the column's base and stacks are near."""
    t = 0.01 * np.arange(160)
    pulse = Record("pulse", -np.sin(2.0 * np.pi * t) * (t < 0.5), 0.01, source="file")
    case = study_case("W1", SHORT)
    table = study.of_wall("own", case, Motion(pulse), "pos").set_index("facade")
    assert list(table.index)[:3] == ["8 courses, 1.2", "study", "column"]
    assert table.loc["study", "ratio"] < 0.8
    assert table.loc["column", "ratio"] == pytest.approx(1.0, abs=0.05)
    assert table.loc[study.CHOICE, "ratio"] == pytest.approx(1.0, abs=0.03)
    half = table.loc[study.HALF, "pga_median_g"]
    assert half == pytest.approx(table.loc[study.CHOICE, "pga_median_g"], rel=0.01)
    assert not table["failed"].any()
    assert (table["cpu_s"] > 0.0).all()


def test_walls():
    """The case's own, and two others: Γ of 0.002 and 0.08, β of their own."""
    found = dict(study.walls(study_case("W1")))
    assert list(found) == [study.OWN, *study.SHAKEN]
    sizes = [found[name]["facade"] for name in study.SHAKEN]
    sizes = [[f[k] for k in ("height_m", "thickness_m", "density_kg_m3", "e_mpa")] for f in sizes]
    gamma = [study.column.compliance(h, b, rho, 1e6 * e) for h, b, rho, e in sizes]
    assert gamma == pytest.approx([0.0019, 0.084], rel=0.05)
    assert len({case["beta_s"] for case in found.values()}) == 3


def test_summary():
    """Percentiles of the ratios by base, without the stack itself."""
    names = ("study", "column")
    rows = [("W1", "r", "pos", name, r, 1.0) for r in (0.7, 0.8, np.nan) for name in names]
    columns = ["model", "record", "direction", "facade", "ratio", "cpu_s"]
    table = pd.DataFrame(rows, columns=columns)
    found = study.summary(table).set_index("facade")
    assert list(found.loc["study", ["n", "n_censored"]]) == [3, 1]
    assert found.loc["column", "median"] == pytest.approx(0.75)


def test_the_scan_s_settings_are_within_the_search_s_limits():
    for key, value in study.SCAN.items():
        curves._allowed(key, curves.WHERE[key], value)
