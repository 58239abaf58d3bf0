"""What stands beside a rate and a fragility: the share from beyond the table, and the band."""

import numpy as np
import pandas as pd
import pytest
from scipy.special import ndtri
from studies.risk.collapse import BUILDING, COLUMNS, PARTS, beside_building, risk_of
from studies.risk.fragility_tables import building_shares
from studies.shared import rates
from studies.shared.fragility import MIN_DISPERSION, Bootstrap, Fragility, fit
from studies.shared.hazard import Hazard, HazardError, read_hazard

LAW = Hazard("pga_g", np.array([0.1, 0.2, 0.4]), 1e-3 * np.array([0.1, 0.2, 0.4]) ** -2.0)
SETTINGS = {"confidence": 0.9, "resamples": 200, "seed": 1, "min_stations": 12}


def falls_from(pga_g):
    """A curve that falls from a PGA on, on a fine row of them."""
    x = np.geomspace(0.02, 3.0, 4001)
    return x, (x >= pga_g).astype(float)


def test_the_share_from_beyond_the_table_is_that_below_and_above_it():
    """λ = 10⁻³ x⁻²; curves that fall from 0.05, 0.15 and 0.8 g, the table from 0.1 to 0.4 g.

    Below the table λ(0.05) − λ(0.1) of the first; above it λ(0.4) of the first two, λ(0.8) of the
    third.
    """
    falls = {"A": 0.05, "B": 0.15, "C": 0.8}
    curves = {("W1", name, "pos"): falls_from(g) for name, g in falls.items()}
    brackets = pd.DataFrame(
        {"low": [0.04, 0.14, 0.7], "high": [0.06, 0.16, 0.9], "weight": [1.0, 1.0, 1.0]}
    )
    places = {name: f"S{name}" for name in "ABC"}
    row, parts = risk_of("W1", curves, places, brackets, LAW, {"years": 50, "bins": 4}, SETTINGS)
    rate = {g: 1e-3 * g**-2.0 for g in (0.05, 0.1, 0.15, 0.4, 0.8)}
    total = rate[0.05] + rate[0.15] + rate[0.8]
    below, above = rate[0.05] - rate[0.1], 2.0 * rate[0.4] + rate[0.8]
    assert row["outside_share"] == pytest.approx((below + above) / total, rel=5e-3)
    assert row["annual_rate"] == pytest.approx(total / 3.0, rel=5e-3)
    assert row["probability"] == pytest.approx(1.0 - np.exp(-50.0 * row["annual_rate"]))
    share = pd.DataFrame(parts, columns=PARTS)["share"]
    assert share.iloc[0] == pytest.approx(below / total, rel=5e-3)
    assert share.iloc[-1] == pytest.approx(above / total, rel=5e-3)
    lognormal = rates.collapse_rate(LAW, row["median"], row["dispersion"])[0][0]
    assert row["rate_lognormal"] == pytest.approx(lognormal)
    assert set(row) == set(COLUMNS)


def test_a_draw_in_which_nothing_fell_has_no_probability_in_the_band():
    """Of ten draws nine have no median: the band is 0 but for its upper end, that of the tenth."""
    median = np.array([np.inf] * 5 + [0.3] * 5)
    drawn = Bootstrap(median, np.array([np.nan] * 5 + [0.4] * 5), stations=20)
    low, high = drawn.band([0.1, 0.3, 0.9], 0.9)
    assert low.tolist() == [0.0, 0.0, 0.0]
    assert high == pytest.approx(Fragility(0.3, 0.4).probability([0.1, 0.3, 0.9]))


def test_the_band_holds_at_each_intensity_the_stated_part_of_the_curves():
    median = np.geomspace(0.2, 0.4, 101)
    low, high = Bootstrap(median, np.full(101, 0.5), stations=20).band([0.3], 0.9)
    assert low[0] == pytest.approx(Fragility(median[95], 0.5).probability(0.3), rel=0.02)
    assert high[0] == pytest.approx(Fragility(median[5], 0.5).probability(0.3), rel=0.02)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("pga_g,annual_rate,remark\n0.1,0.1,a\n0.2,0.05,b\n", "columns pga_g, annual_rate, remark"),
        ("annual_rate,pga_g\n0.1,0.1\n0.05,0.2\n", "expected one of pga_g"),
        ("#,investigation_time=50.0, imt='PGA'\n", "expected the columns lon, lat"),
    ],
)
def test_a_heading_that_is_none_is_said(tmp_path, text, words):
    path = tmp_path / "hazard.csv"
    path.write_text(text)
    with pytest.raises(HazardError) as caught:
        read_hazard(path, 0.27)
    assert words in str(caught.value)


def test_blank_lines_and_remarks_of_a_hazard_table_do_not_count(tmp_path):
    path = tmp_path / "hazard.csv"
    path.write_text("\n# of a site\npga_g,annual_rate\n\n0.1,0.1\n   \n# and on\n0.2,0.05\n")
    found = read_hazard(path, 0.27)
    assert found.intensity.tolist() == [0.1, 0.2]
    assert found.annual_rate.tolist() == [0.1, 0.05]


@pytest.mark.parametrize(("below", "above"), [(3.0, 1.0), (1.0, 1.0), (0.5, 4.5)])
def test_brackets_that_meet_in_a_point_share_it_by_their_weights(below, above):
    """So much of the weight falls below 0.2: there the narrowest curve has that probability."""
    found = fit([0.1, 0.2], [0.2, 0.4], [below, above])
    assert found.dispersion == MIN_DISPERSION
    share = below / (below + above)
    assert found.probability(0.2) == pytest.approx(share, abs=1e-9)
    assert found.median == pytest.approx(0.2 * np.exp(-MIN_DISPERSION * ndtri(share)))


def test_brackets_in_a_table_of_several_columns_are_refused():
    with pytest.raises(ValueError, match="as many lower as upper"):
        fit(np.full((2, 2), 0.1), np.full((2, 2), 0.2))


def test_the_rate_of_a_building_and_of_facades_before_it():
    """λ = 10⁻³ x⁻²: façades fall from 0.2 and 0.4 g, their buildings from 0.1 and from 0.8 g.

    Of the façades' rate λ(0.2) + λ(0.4) the first's comes after its building, the second's before
    it but for λ(0.8).
    """
    curves = {}
    for name, facade, building in (("A", 0.2, 0.1), ("B", 0.4, 0.8)):
        x, fell = falls_from(facade)
        curves["W2", name, "pos"] = x, fell, falls_from(building)[1]
    risk = {"years": 50, "bins": 4}
    row = beside_building(curves, {"A": "SA", "B": "SB"}, LAW, risk, SETTINGS)
    rate = {g: 1e-3 * g**-2.0 for g in (0.1, 0.2, 0.4, 0.8)}
    assert row["building_rate"] == pytest.approx(0.5 * (rate[0.1] + rate[0.8]), rel=5e-3)
    assert row["building_probability"] == pytest.approx(1.0 - np.exp(-50.0 * row["building_rate"]))
    before = (rate[0.4] - rate[0.8]) / (rate[0.2] + rate[0.4])
    assert row["share_before_building"] == pytest.approx(before, rel=5e-3)
    assert np.isnan(row["building_low"])  # of two stations there is no interval
    assert list(row) == BUILDING
    assert beside_building({}, {}, LAW, risk, SETTINGS) == {}


def test_curves_before_an_elastic_building_say_nothing_of_it():
    key = {"model": "W2", "record": "A", "direction": "pos"}
    pga_g = np.array([0.1, 0.2, 0.3])
    table = pd.DataFrame({**key, "pga_g": pga_g, "probability": [0.0, 0.5, 1.0]})
    table = table.assign(realisations=9, realisations_yade=np.nan, probability_building=np.nan)
    curves = pd.DataFrame([key])
    assert building_shares(curves, table, {"A": 2.0}) == {}
    weak = table.assign(probability_building=[0.2, 0.6, 1.0])
    ((x, fell, down),) = building_shares(curves, weak, {"A": 2.0}).values()
    assert x == pytest.approx(2.0 * pga_g)
    assert fell == pytest.approx([0.0, 0.5, 1.0])
    assert down == pytest.approx([0.2, 0.6, 1.0])
