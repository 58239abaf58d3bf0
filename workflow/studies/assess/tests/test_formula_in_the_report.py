"""A report says once where its median is far from the formula's."""

from types import SimpleNamespace

import pandas as pd
from rocking import estimate
from rocking.formula import words
from studies.assess import report
from studies.assess.catalogue import SAY
from study_cases import study_case, study_settings

from yade_scripts.model.facades import Facade

PARTS = ("whole", "above_2.000")


def test_the_report_names_a_median_far_from_the_formula_once():
    own = study_settings({"models": ["W1"], "facade": {"height_m": 7.2, "base": "column"}})
    by_formula = estimate(study_case("W1", {"facade.height_m": 7.2, "facade.base": "column"}))
    rows = [{"model": "W1", "median_pga_g": 5.0 * by_formula.median, "stations": 22}]
    (said,) = report.formula_said(words.outliers(own, pd.DataFrame(rows)), SAY)
    assert said.startswith("W1: the computed median")
    tables = {
        "parts_dynamic": pd.DataFrame([{**row, "part": part} for row in rows for part in PARTS]),
        "dynamic": pd.DataFrame(rows),
        "dynamic_sensitivity": pd.DataFrame(columns=["key", "factor", "ratio"]),
        "mechanisms": pd.DataFrame(columns=["kind", "pga_fails_g", "links_left_out"]),
    }
    data = SimpleNamespace(
        config=own,
        facade=Facade.of(own["facade"]),
        tables=tables,
        demand_said="stated",
        demand_g=0.3,
        relied="W1",
        factor=1.35,
        say=SAY,
    )
    assert report.rests_on(data).count(said) == 1  # of the whole façade, not of its parts
