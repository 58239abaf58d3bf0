"""Tables of fragility: brackets in every measure, what follows from them, what they leave open."""

import numpy as np
import pandas as pd
import pytest
from rocking.collapse import probability
from studies.risk import fragility_tables as tables
from studies.shared import fragility

RECORDS = [f"r{i}" for i in range(24)]
SETTINGS = {"measures": ["better", "pga_g"], "confidence": 0.9, "resamples": 200, "seed": 3}
SETTINGS["min_stations"] = 10
STATIONS = {name: name for name in RECORDS}
LEVELS = np.geomspace(0.05, 4.0, 400)


@pytest.fixture(scope="module")
def made():
    """Curves that fall at sharp PGA, and a measure in which they all but agree.

    PGA at collapse is lognormal, 0.3 g and 0.5; its measure scatters by 0.1 about 6.
    """
    draw = np.random.default_rng(5)
    collapse = 0.3 * np.exp(0.5 * draw.standard_normal(len(RECORDS)))
    better = 6.0 * np.exp(0.1 * draw.standard_normal(len(RECORDS)))
    factors = {
        name: {"pga_g": 1.0, "better": m / c}
        for name, m, c in zip(RECORDS, better, collapse, strict=True)
    }
    curves, dense = [], []
    for name, g in zip(RECORDS, collapse, strict=True):
        key = dict(zip(probability.KEY, ("W1", name, "pos"), strict=True))
        known = {"pga_safe_g": 0.9 * g, "pga_collapse_g": g, "pga_max_g": 4.0, "pga_median_g": g}
        curves.append({**key, **known})
        share = (g <= LEVELS).astype(float)
        dense.append(pd.DataFrame({"pga_g": LEVELS, "probability": share, "realisations": 9.0}))
        dense[-1] = dense[-1].assign(**key, realisations_yade=np.nan, probability_yade=np.nan)
    return pd.DataFrame(curves), pd.concat(dense), factors


def test_brackets_hold_the_collapse_in_every_measure(made):
    """Low below and high above, in units of the measure; weights of a curve sum to one."""
    curves, dense, factors = made
    found = tables.brackets(curves, dense, factors, SETTINGS["measures"], STATIONS, 2.0)
    weights = found.groupby(["record", "im", "reading"])["weight"].sum()
    assert weights.to_numpy() == pytest.approx(1.0)
    for row in curves.to_dict("records"):
        for name in SETTINGS["measures"]:
            part = found[(found["record"] == row["record"]) & (found["im"] == name)]
            at = row["pga_collapse_g"] * factors[row["record"]][name]
            first = part[part["reading"] == tables.FIRST]
            assert (first["low"] < at).all()
            assert (first["high"] >= at).all()
            assert part["low"].to_numpy() == pytest.approx(at, rel=0.02)
            assert part["high"].to_numpy() == pytest.approx(at, rel=0.02)


def test_two_records_of_a_station_that_fall_alike_tell_as_much_as_one():
    """Stations are drawn again, with all their records, so the band is that of one record each."""
    edge = 0.3 * np.exp(0.5 * np.random.default_rng(11).standard_normal(16))
    one = pd.DataFrame({"station": [f"s{k}" for k in range(16)], "weight": 1.0})
    one = one.assign(record=one["station"], low=0.95 * edge, high=edge)
    two = pd.concat([one, one.assign(record=one["record"] + "b")], ignore_index=True)
    (single, alone), (double, both) = (fragility.fit_table(t, SETTINGS) for t in (one, two))
    assert (double.median, double.dispersion) == pytest.approx((single.median, single.dispersion))
    assert np.std(np.log(both.median)) == pytest.approx(np.std(np.log(alone.median)), rel=0.15)
    assert both.stations == alone.stations == 16


def test_both_readings_of_a_curve_that_stands_again(made):
    """Every curve also falls over a tenth below: first crossings are there, the share is not.

    Of a power law k = 2 the lower range counts (0.5⁻² − 0.55⁻²) and the upper 1 of c⁻².
    """
    curves, dense, factors = made
    at = dense["record"].map(curves.set_index("record")["pga_collapse_g"]).to_numpy()
    lower = (dense["pga_g"] > 0.5 * at) & (dense["pga_g"] < 0.55 * at)
    twice = dense.assign(probability=np.where(lower, 1.0, dense["probability"]))
    found = tables.brackets(curves, twice, factors, ["pga_g"], STATIONS, 2.0)
    by = {k: part.set_index("record")["high"] for k, part in found.groupby("reading")}
    pga_g = curves.set_index("record")["pga_collapse_g"]
    assert (by["first"] / pga_g).to_numpy() == pytest.approx(0.5, rel=0.03)
    mean = (0.5**-2 - 0.55**-2 + 1.0) ** -0.5
    assert (by["share"] / pga_g).groupby(level=0).mean().to_numpy() == pytest.approx(mean, rel=0.1)
    (row,), *_ = tables.fits(found, {**SETTINGS, "measures": ["pga_g"], "resamples": 100})
    assert row["median_first"] == pytest.approx(0.5 / mean * row["median"], rel=0.03)
    of_curves = tables.shares(curves, twice, dict.fromkeys(RECORDS, 5.0))
    x = np.array([0.01, 0.2, 0.3, 0.4, 3.9])
    falls = (x[:, None] > 0.5 * pga_g.to_numpy()) & (x[:, None] < 0.55 * pga_g.to_numpy())
    falls |= x[:, None] > pga_g.to_numpy()
    assert tables.share_at(of_curves.values(), 5.0 * x) == pytest.approx(
        falls.mean(axis=1), abs=0.05
    )


def test_fits_find_medians_and_the_better_measure(made):
    curves, dense, factors = made
    found = tables.brackets(curves, dense, factors, SETTINGS["measures"], STATIONS, 2.0)
    rows, efficiency, fitted = tables.fits(found, SETTINGS)
    by = {row["im"]: row for row in rows}
    pga = np.log(curves["pga_collapse_g"])
    assert by["pga_g"]["median"] == pytest.approx(np.exp(pga.mean()), rel=0.02)
    assert by["pga_g"]["dispersion"] == pytest.approx(pga.std(ddof=0), rel=0.05)
    assert by["better"]["median"] == pytest.approx(6.0, rel=0.1)
    assert by["better"]["ci_low"] < by["better"]["median"] < by["better"]["ci_high"]
    assert (by["pga_g"]["n"], by["pga_g"]["n_records"], by["pga_g"]["n_censored"]) == (24, 24, 0.0)
    less = {row["im"]: row["less_than_pga"] for row in efficiency}
    assert less["better"] > 0.99
    assert np.isnan(less["pga_g"])
    table = pd.DataFrame(fitted)
    half = table[np.isclose(table["probability"], 0.5)].set_index("im")["intensity"]
    assert half["pga_g"] == pytest.approx(by["pga_g"]["median"])
    assert (table["band_low"] <= table["probability"] + 1e-9).mean() > 0.9
    assert (table["band_high"] >= table["probability"] - 1e-9).mean() > 0.9


@pytest.mark.parametrize(
    ("standing", "words"),
    [
        (0, ""),
        (6, ""),
        (16, "median extrapolated: most curves do not collapse"),
        (24, "not determined: no collapse"),
    ],
)
def test_a_row_says_where_most_stood(made, standing, words):
    curves, dense, factors = made
    names = RECORDS[:standing]
    dense = dense.copy()
    dense.loc[dense["record"].isin(names), "probability"] = 0.0
    found = tables.brackets(curves, dense, factors, ["pga_g"], STATIONS, 2.0)
    rows, *_ = tables.fits(found, {**SETTINGS, "measures": ["pga_g"], "resamples": 20})
    assert rows[0]["remark"] == words
    assert rows[0]["n_censored"] == standing


def test_few_stations_are_indicative(made):
    curves, dense, factors = made
    found = tables.brackets(curves[:8], dense, factors, ["pga_g"], STATIONS, 2.0)
    rows, *_ = tables.fits(found, {**SETTINGS, "measures": ["pga_g"], "resamples": 20})
    assert rows[0]["remark"] == "indicative: 8 records of 8 stations"


def test_a_measure_that_leaves_the_pulse_out_is_insufficient(made):
    """PGA at collapse made to fall with PGV/PGA as its −0.8th power; another measure undoes it."""
    curves, _, _ = made
    draw = np.random.default_rng(9)
    log_x, noise = draw.normal(scale=[[0.5], [0.05]], size=(2, len(RECORDS)))
    noise -= np.polyval(np.polyfit(log_x, noise, 1), log_x)  # of its own, it has no slope
    x = np.exp(log_x)
    curves = curves.assign(pga_equivalent_g=0.3 * x**-0.8 * np.exp(noise))
    properties = {
        name: {"significant_duration_s": 9.0 * d, "pgv_over_pga_s": v}
        for name, v, d in zip(RECORDS, x, draw.permutation(x), strict=True)
    }
    factors = {name: {"pga_g": 1.0, "v": v**0.8} for name, v in zip(RECORDS, x, strict=True)}
    settings = {**SETTINGS, "measures": ["pga_g", "v"]}
    found = tables.slopes(curves, factors, properties, settings, STATIONS)
    found = found.set_index(["im", "against"])
    assert found.loc[("pga_g", "pgv_over_pga_s"), "slope"] == pytest.approx(-0.8)
    assert found.loc[("pga_g", "pgv_over_pga_s"), "sufficient"] == 0
    assert found.loc[("v", "pgv_over_pga_s"), "slope"] == pytest.approx(0.0, abs=1e-9)
    assert found.loc[("v", "pgv_over_pga_s"), "sufficient"] == 1
    assert (found["n"] == len(RECORDS)).all()
