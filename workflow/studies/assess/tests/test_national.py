"""Rows of NTC 2018's hazard: the demand of a return period, and the curve of PGA."""

import math

import numpy as np
import pytest
from studies.assess import inputs, national, site
from studies.assess.national import check_rows
from study_cases import study_settings

ROWS = [
    {"return_period_years": tr, "ag_g": ag, "f0": f0, "tc_star_s": tc}
    for tr, ag, f0, tc in (
        (30, 0.062, 2.43, 0.27),
        (101, 0.108, 2.37, 0.29),
        (475, 0.202, 2.36, 0.32),
        (975, 0.262, 2.38, 0.34),
        (2475, 0.361, 2.41, 0.36),
    )
]
OWN = {
    "hazard": ROWS,
    "return_period_years": 475,
    "soil": "B",
    "topography": "T2",
    "ag_g": None,
    "en_spectrum": None,
}


def test_the_row_of_a_return_period_is_taken_as_it_is():
    assert national.row_at(ROWS, 475) == pytest.approx(
        {"ag_g": 0.202, "f0": 2.36, "tc_star_s": 0.32}
    )
    demand = site.demand_from({"assessment": OWN}, [], None, None)
    soil = 1.4 - 0.4 * 2.36 * 0.202  # subsoil B
    assert demand.pga_g == pytest.approx(0.202 * min(soil, 1.2) * 1.2)


def test_between_rows_parameters_are_straight_on_logarithmic_scales():
    """712 years: log p = log p1 + log(p2/p1) log(712/475)/log(975/475)."""
    share = math.log(712 / 475) / math.log(975 / 475)
    found = national.row_at(ROWS, 712)
    assert found["ag_g"] == pytest.approx(0.202 * (0.262 / 0.202) ** share, rel=1e-9)
    assert found["tc_star_s"] == pytest.approx(0.32 * (0.34 / 0.32) ** share, rel=1e-9)


def test_the_curve_is_exceeded_once_in_each_return_period_on_the_subsoil():
    curve = national.curve_of(ROWS, "B", "T2")
    for row in ROWS:
        pga_g = national.spectrum_of(row, "B", "T2").pga_g
        assert curve.rate(pga_g) == pytest.approx(1.0 / row["return_period_years"], rel=1e-9)
    assert site.pga_at(curve, 475) == pytest.approx(
        site.demand_from({"assessment": OWN}, [], None, None).pga_g
    )


def test_a_soft_soil_that_shakes_less_under_a_rarer_motion_keeps_a_curve():
    """On subsoil D S_S a_g falls from F0 a_g = 0.8 to 1: the rarer row says nothing there."""
    rows = [
        {"return_period_years": tr, "ag_g": ag, "f0": 2.5, "tc_star_s": 0.35}
        for tr, ag in ((475, 0.32), (975, 0.37), (2475, 0.6))
    ]
    pga_g = [0.32 * (2.4 - 1.5 * 0.8), 0.37 * (2.4 - 1.5 * 0.925), 0.6 * 0.9]
    assert pga_g[1] < pga_g[0] < pga_g[2]
    curve = national.curve_of(rows, "D", "T1")
    assert curve.intensity == pytest.approx([pga_g[0], pga_g[2]])
    assert curve.annual_rate == pytest.approx([1 / 475, 1 / 2475])
    assert np.all(np.diff(curve.intensity) > 0.0)


def test_both_hazards_of_a_site_stand_side_by_side():
    curve = national.curve_of(ROWS, "A", "T1")
    assert list(site.hazards_of(OWN, curve, "own.csv")) == ["NTC 2018", "own.csv"]
    assert list(site.hazards_of({**OWN, "hazard": []}, curve, "own.csv")) == ["own.csv"]


@pytest.mark.parametrize(
    ("own", "words"),
    [
        ({"hazard": ROWS[:1]}, "1 row; expected two or more"),
        ({"hazard": ROWS[::-1]}, "row 2: return_period_years = 975 after 2475"),
        (
            {"hazard": [ROWS[0], {**ROWS[1], "ag_g": 0.05}]},
            "row 2: ag_g = 0.05 after 0.062; expected return periods and a_g that rise",
        ),
        ({"hazard": ROWS, "return_period_years": 5000}, "has 30 to 2475 years"),
        ({"hazard": ROWS, "ag_g": 0.2}, "ag_g: stated beside assessment.hazard"),
    ],
)
def test_rows_that_are_no_hazard_are_refused_in_one_line(own, words):
    resolved = study_settings({"assessment": own})
    with pytest.raises(ValueError, match=words) as caught:
        inputs.check_demand(resolved)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("factor", "words"), [(10.0, "in tenths of g"), (9.81, "expected g"), (0.01, "expected g")]
)
def test_a_national_table_in_another_unit_is_refused(factor, words):
    """An island's rows are the same at all return periods but little: 0.05 g printed as 0.5."""
    rows = [
        {"return_period_years": t, "ag_g": factor * ag, "f0": 2.7, "tc_star_s": 0.3}
        for t, ag in ((30, 0.019), (50, 0.024), (475, 0.051), (2475, 0.075))
    ]
    with pytest.raises(ValueError, match=f"row 1: ag_g = .* at 30 years.*{words}"):
        check_rows(rows)
    check_rows([{**row, "ag_g": row["ag_g"] / factor} for row in rows])
