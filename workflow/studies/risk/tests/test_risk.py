"""Risk: closed forms of the rate, two forms of one hazard, fragilities that read back the same."""

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from rocking.collapse.equivalent import equivalent
from rocking.collapse.probability import KEY
from run_script import script
from scipy import stats
from scipy.integrate import quad
from studies.risk import fragility_tables
from studies.risk.collapse import risk_of
from studies.shared import nrml, rates
from studies.shared.fragility import Fragility
from studies.shared.hazard import Hazard, HazardError, imt_of, read_hazard

ROOT = Path(__file__).resolve().parents[4]
K0, K, THETA, BETA = 2e-4, 2.3, 0.31, 0.47


def power_law(*levels):
    x = np.array(levels)
    return Hazard("pga_g", x, K0 * x**-K)


def bent(x):
    """Hazard of a curve that steepens, on its own points."""
    return 1e-2 * (x / 0.05) ** -(1.2 + 0.5 * np.log(x / 0.05))


CURVED = np.geomspace(0.05, 2.0, 9)


def test_power_law_hazard_has_the_closed_form_of_jalayer_whatever_its_points():
    expected = K0 * THETA**-K * np.exp(0.5 * (K * BETA) ** 2)
    for hazard in (power_law(0.1, 0.2), power_law(0.01, 0.3, 0.5, 9.0), power_law(2.0, 3.0)):
        rate, _ = rates.collapse_rate(hazard, THETA, BETA)
        assert rate[0] == pytest.approx(expected, rel=1e-12)


def test_a_sharp_fragility_gives_the_hazard_at_its_median():
    hazard = Hazard("pga_g", CURVED, bent(CURVED))
    rate, _ = rates.collapse_rate(hazard, CURVED[4], 1e-5)
    assert rate[0] == pytest.approx(bent(CURVED[4]), rel=1e-3)


def test_rate_and_its_parts_agree_with_quadrature():
    """∫ F(x) |dλ/dx| dx, by quadrature of the hazard's own slope, interval by interval."""
    hazard = Hazard("pga_g", CURVED, bent(CURVED))
    edges, rate = rates.by_interval(hazard, THETA, BETA)
    fragility = stats.lognorm(BETA, scale=THETA)
    for a, b, part in zip(edges[1:-2], edges[2:-1], rate[0, 1:-1], strict=True):
        slope = np.log(hazard.rate(b) / hazard.rate(a)) / np.log(b / a)
        by_hand, _ = quad(lambda x, s=slope: fragility.cdf(x) * -s * hazard.rate(x) / x, a, b)
        assert part == pytest.approx(by_hand, rel=1e-8)
    total, outside = rates.collapse_rate(hazard, THETA, BETA)
    assert rate.sum() == pytest.approx(total[0], rel=1e-12)
    assert outside[0] == pytest.approx((rate[0, 0] + rate[0, -1]) / total[0])


def test_a_hazard_table_in_a_rate_with_its_interval_out(tmp_path):
    """By hand: the hazard at every collapse, averaged; moments of ln PGA for the lognormal one.

    Twenty stations, both components and directions; the interval by drawing stations again with
    other numbers.
    """
    x, rate = np.array([0.05, 0.1, 0.3, 1.0]), np.array([2e-2, 6e-3, 5e-4, 1.5e-5])
    rng = np.random.default_rng(11)
    station = rng.normal(np.log(THETA), 0.4, 20)
    ln_pga = station[:, None, None] + rng.normal(0.0, 0.2, (20, 2, 2))

    first, last = (np.diff(np.log(rate)) / np.diff(np.log(x)))[[0, -1]]

    def exceeded(ln_g):
        inside = np.interp(ln_g, np.log(x), np.log(rate))
        low, high = np.minimum(ln_g - np.log(x[0]), 0), np.maximum(ln_g - np.log(x[-1]), 0)
        return np.exp(inside + first * low + last * high)

    grid = np.linspace(np.log(1e-3), np.log(30.0), 1500)
    drops, middle = -np.diff(exceeded(grid)), 0.5 * (grid[1:] + grid[:-1])
    lognormal = stats.norm.cdf((middle - ln_pga.mean()) / ln_pga.std()) @ drops
    by_station = exceeded(ln_pga).mean(axis=(1, 2))
    drawn = by_station[rng.integers(0, 20, (2000, 20))].mean(axis=1)
    (tmp_path / "hazard.csv").write_text(
        "pga_g,annual_rate\n" + "".join(f"{a},{b}\n" for a, b in zip(x, rate, strict=True))
    )
    for name, table in run_tables(ln_pga).items():
        table.to_csv(tmp_path / f"{name}.csv", index=False)
    params = {"risk": {"site": None, "years": 50, "bins": 6}, "fragility": SETTINGS}
    inputs = ("brackets", "factors", "collapse", "probability", "hazard")
    script(
        "risk_rate",
        tmp_path,
        params=params | {"period_s": 0.27},
        input={name: f"{name}.csv" for name in inputs},
        output={"table": "risk.csv", "deaggregation": "parts.csv"},
    )
    (row,) = pd.read_csv(tmp_path / "risk.csv").to_dict("records")
    assert row["annual_rate"] == pytest.approx(by_station.mean(), rel=2e-3)
    assert row["rate_lognormal"] == pytest.approx(lognormal, rel=2e-3)
    low, high = np.percentile(drawn, [5, 95])
    assert (row["rate_low"], row["rate_high"]) == pytest.approx((low, high), rel=0.06)
    assert high / low > 1.5  # an interval worth the name
    hours = 8766.0  # of a year; none of those in 50 years fells it
    in_50_years = 1.0 - (1.0 - row["annual_rate"] / hours) ** (50.0 * hours)
    assert row["probability"] == pytest.approx(in_50_years, rel=1e-4)
    parts = pd.read_csv(tmp_path / "parts.csv")
    assert parts["annual_rate"].sum() == pytest.approx(row["annual_rate"], rel=1e-4)
    assert parts["share"].sum() == pytest.approx(1.0, rel=1e-4)
    assert (parts["share_low"] <= parts["share"]).all()
    assert (parts["share_high"] >= parts["share"]).all()
    assert parts["share_high"].max() < 1.0


SETTINGS = {"confidence": 0.9, "resamples": 2000, "seed": 1, "min_stations": 12}
STEP = 0.001  # between a PGA that stands and one that falls


def run_tables(ln_pga):
    """Tables of a run of sharp collapses; an axis each for stations, components and directions."""
    curves, dense, factors = [], [], []
    for (i, c, d), value in np.ndenumerate(ln_pga):
        key = dict(zip(KEY, ("W1", f"R{i}{c}", d), strict=True))
        curves.append({**key, "pga_safe_g": np.nan, "pga_collapse_g": np.exp(value)})
        curves[-1]["pga_max_g"] = 2.0 * np.exp(value)
        pga_g = np.exp(value + STEP * np.array([-0.5, 0.5]))
        part = pd.DataFrame({"pga_g": pga_g, "probability": [0.0, 1.0], "realisations": 9.0})
        dense.append(
            part.assign(
                **key,
                realisations_yade=np.nan,
                probability_yade=np.nan,
                probability_building=np.nan,
            )
        )
        if d == 0:
            factors.append((f"R{i}{c}", f"S{i}", "pga_g", 1.0))
    curves, dense = pd.DataFrame(curves), pd.concat(dense)
    stations = {record: station for record, station, *_ in factors}
    own = {record: {"pga_g": 1.0} for record in stations}
    brackets = fragility_tables.brackets(curves, dense, own, ["pga_g"], stations, 2.0)
    factors = pd.DataFrame(factors, columns=fragility_tables.FACTORS)
    tables = {"collapse": curves, "probability": dense, "brackets": brackets}
    return tables | {"factors": factors}


def risk(ln_pga):
    hazard, tables = Hazard("pga_g", CURVED, bent(CURVED)), run_tables(ln_pga)
    known = tables["factors"].set_index("record")
    curves = fragility_tables.shares(tables["collapse"], tables["probability"], known["per_pga"])
    mine = tables["brackets"].query("reading == 'share'")
    settings = {"years": 50, "bins": 6}
    row, parts = risk_of("W1", curves, known["station"], mine, hazard, settings, SETTINGS)
    return row, np.array([values[2:] for values in parts])


TWO_RANGES = np.geomspace(0.05, 1.9, 6001)


def between(*ranges):
    """A curve that falls in ranges of intensity and with a probability in each."""
    share = np.zeros(TWO_RANGES.size)
    for low, high, p in ranges:
        share[(low < TWO_RANGES) & (high > TWO_RANGES)] = p
    return TWO_RANGES, share


def test_the_rate_of_a_curve_with_two_ranges_of_collapse_is_their_sum():
    """λ(0.2) − λ(0.3) + λ(0.5), by interval and in all; with a probability its part of it."""
    hazard = Hazard("pga_g", CURVED, bent(CURVED))
    edges = np.array([0.0, 0.25, 0.4, np.inf])
    for p in (1.0, 0.3):
        found = rates.of_curve(hazard, *between((0.2, 0.3, p), (0.5, 9.0, 1.0)), edges)
        at = hazard.rate(np.array([0.2, 0.25, 0.3, 0.5]))
        by_hand = [p * (at[0] - at[1]), p * (at[1] - at[2]), at[3]]
        assert found == pytest.approx(by_hand, rel=2e-3)
    single = rates.of_curve(hazard, *between((0.35, 9.0, 1.0)), edges)
    assert single.sum() == pytest.approx(rates.collapse_rate(hazard, 0.35, 1e-4)[0][0], rel=1e-3)


def test_the_rate_of_two_curves_is_the_mean_of_theirs():
    """One that falls in two ranges and one that falls once; and its equivalent PGA is as good."""
    hazard = power_law(0.06, 0.5, 1.5)
    curves = {("W1", "A", "pos"): between((0.2, 0.3, 1.0), (0.5, 9.0, 1.0))}
    curves[("W1", "B", "pos")] = between((0.4, 9.0, 1.0))
    stations, settings = {"A": "S", "B": "T"}, {"years": 50, "bins": 6}
    brackets = pd.DataFrame({"low": [0.2, 0.39], "high": [0.21, 0.41], "weight": 1.0})
    row, parts = risk_of("W1", curves, stations, brackets, hazard, settings, SETTINGS)
    at = hazard.rate(np.array([0.2, 0.3, 0.5, 0.4]))
    by_hand = 0.5 * (at[0] - at[1] + at[2] + at[3])
    assert row["annual_rate"] == pytest.approx(by_hand, rel=2e-3)
    assert sum(part[4] for part in parts) == pytest.approx(by_hand, rel=2e-3)
    c = [equivalent(*curve, slope=K) for curve in curves.values()]
    assert hazard.rate(np.array(c)).mean() == pytest.approx(by_hand, rel=2e-3)
    assert "no interval" in row["remark"]


def test_what_was_not_run_is_said_where_it_may_matter():
    """A curve that falls in one narrow range, run to 0.6 g: from there on it may always fall."""
    hazard, settings = power_law(0.06, 0.5, 1.5), {"years": 50, "bins": 6}
    x, share = between((0.4, 0.42, 1.0))
    curves = {("W1", "A", "pos"): (x[x < 0.6], share[x < 0.6])}
    brackets = pd.DataFrame({"low": [0.4], "high": [np.inf], "weight": 1.0})
    row, _ = risk_of("W1", curves, {"A": "S"}, brackets, hazard, settings, SETTINGS)
    at = hazard.rate(np.array([0.4, 0.42, 0.6]))
    said = float(row["remark"].partition("up to ")[2].partition(" % more")[0])
    assert said == pytest.approx(100.0 * at[2] / (at[0] - at[1]), rel=0.02)
    never = {("W1", "A", "pos"): (x, 0.0 * x)}
    row, parts = risk_of("W1", never, {"A": "S"}, brackets, hazard, settings, SETTINGS)
    assert "annual_rate" not in row
    assert not parts
    assert "no collapse" in row["remark"]


@pytest.mark.parametrize("n", [1, 2, 4, 6])
def test_too_few_stations_give_a_rate_without_an_interval_and_say_so(n):
    ln_pga = np.random.default_rng(3).normal(np.log(THETA), 0.4, (n, 2, 2))
    row, parts = risk(ln_pga)
    assert row["annual_rate"] > 0.0
    assert row["probability"] > 0.0
    assert np.isnan([row["rate_low"], row["rate_high"]]).all()
    assert np.isnan([row["probability_low"], row["probability_high"]]).all()
    assert np.isnan(parts[:, -2:]).all()
    assert np.isfinite(parts[:, -3]).all()
    stations = "1 station:" if n == 1 else f"{n} stations:"
    assert f"no interval from {2 * n} records of {stations} it takes at least 7" in row["remark"]


def test_every_motion_twice_narrows_nothing():
    """A second component like the first says nothing new: same rate, same interval."""
    ln_pga = np.random.default_rng(5).normal(np.log(THETA), 0.4, (9, 1, 2))
    (once, parts), (twice, again) = risk(ln_pga), risk(np.repeat(ln_pga, 2, axis=1))
    for name in ("annual_rate", "rate_low", "rate_high", "probability_low", "probability_high"):
        assert twice[name] == pytest.approx(once[name], rel=1e-4), name
    np.testing.assert_allclose(again, parts, rtol=1e-3, atol=1e-9)
    assert (once["n_records"], twice["n_records"]) == (9, 18)
    assert once["remark"] == "indicative: 9 records of 9 stations"
    assert twice["remark"] == "indicative: 18 records of 9 stations"


def test_many_fragilities_at_once_and_the_two_without_a_fit():
    hazard = Hazard("pga_g", CURVED, bent(CURVED))
    rate, _ = rates.collapse_rate(hazard, [THETA, 0.0, np.inf], [BETA, 0.3, 0.3])
    assert rate[0] == pytest.approx(rates.collapse_rate(hazard, THETA, BETA)[0][0])
    assert np.isinf(rate[1])
    assert rate[2] == 0.0


def test_probability_in_time_is_that_of_a_poisson_process():
    # 475 years of return period are 10 % in 50 years
    assert rates.probability_within(1 / 474.561, 50) == pytest.approx(0.1, rel=1e-4)


OPENQUAKE = (
    "#,,,,,\"generated_by='OpenQuake engine 3.18.0', start_date='2023-10-03T06:09:08',"
    " checksum=2107362341, kind='mean', investigation_time={t}, imt='{imt}'\"\n"
    "lon,lat,depth,poe-0.1000000,poe-0.4000000,poe-0.6000000,poe-0.9\n"
)


def test_an_export_of_openquake_and_a_table_of_rates_are_one_curve(tmp_path):
    rate = np.array([2e-2, 3e-3, 9e-4])
    table, export = tmp_path / "own.csv", tmp_path / "hazard_curve-mean-PGA_1.csv"
    rows = "".join(f"{x},{y}\n" for x, y in zip((0.1, 0.4, 0.6), rate, strict=True))
    table.write_text("# a site\npga_g,annual_rate\n" + rows)
    poes = ",".join(f"{p:.12E}" for p in 1.0 - np.exp(-50.0 * rate))
    sites = f"13.40,42.35,0.0,{poes},0.0\n13.50,42.35,0.0,1.0,0.2,0.1,0.0\n"
    export.write_text(OPENQUAKE.format(t="50.0", imt="PGA") + sites)
    one, other = read_hazard(table, 0.27), read_hazard(export, 0.27, site=(13.40, 42.35))
    assert one.measure == other.measure == "pga_g"
    np.testing.assert_allclose(one.intensity, other.intensity)
    np.testing.assert_allclose(one.annual_rate, other.annual_rate, rtol=1e-9)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("pga,annual_rate\n", "columns pga, annual_rate; expected one of pga_g"),
        ("pga_g,annual_rate\n0.1,0.1\n", "1 usable points; expected two or more"),
        ("pga_g,annual_rate\n0.1,0.1\n0.2,0.2\n", "line 3: rate 0.2 at 0.2, 0.1 at 0.1"),
        ("pga_g,annual_rate\n0.2,0.1\n0.1,0.05\n", "line 3: intensity 0.1 after 0.2"),
        ("pga_g,annual_rate\n0.1,0.1\nx,0.05\n", "line 3: expected a number, found 'x'"),
        ("pga_g;annual_rate\n0,1;0.1\n", "found '0,1'; write a decimal point, not a comma"),
        ("pga_g,annual_rate\n49,0.1\n98,0.05\n", "line 2: pga_g begins at 49; expected g: are"),
        ("pga_g,annual_rate\n0.1,0.1\n0.2,0.05,1\n", "line 3: 3 values; expected 2"),
        ("pga_g,annual_rate\n0,0.1\n0.2,0.05\n", "expected positive numbers"),
        (OPENQUAKE.format(t="50", imt="SA(0.3)") + "1,1,0,.2,.1,.1,0\n", "SA(0.3); Sa(T1) of this"),
        (OPENQUAKE.format(t="50", imt="MMI") + "1,1,0,.2,.1,.1,0\n", "measure MMI; expected PGA"),
        (OPENQUAKE.format(t="50", imt="PGA") + "1,1,0,2,.1,.1,0\n", "expected 0 to 1"),
        (OPENQUAKE.format(t="0", imt="PGA") + "1,1,0,.2,.1,.1,0\n", "expected it positive"),
        (
            OPENQUAKE.format(t="50", imt="PGA") + "1,1,0,.2,.1,.01,0\n2,1,0,.2,.1,.01,0\n",
            "2 sites; expected one (risk.site",
        ),
    ],
)
def test_a_faulty_hazard_table_is_refused_in_one_line(tmp_path, text, words):
    path = tmp_path / "hazard.csv"
    path.write_text(text)
    with pytest.raises(HazardError, match="hazard.csv") as caught:
        read_hazard(path, 0.27)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_openquake_model_carries_the_same_distribution_in_both_forms():
    fits = {"W1": Fragility(THETA, BETA), "W2": Fragility(0.2, 0.6)}
    for discrete in (False, True):
        text = nrml.document("trial", "a façade", imt_of("sa_t1_g", 0.27), fits, discrete)
        root = ET.fromstring(text)
        space = {"n": nrml.NAMESPACE}
        assert root.find("n:fragilityModel/n:limitStates", space).text == "collapse"
        for function, fit in zip(
            root.findall("n:fragilityModel/n:fragilityFunction", space), fits.values(), strict=True
        ):
            imls = function.find("n:imls", space)
            assert imls.get("imt") == "SA(0.27)"
            if discrete:
                x, p = (
                    np.array(function.find(f"n:{tag}", space).text.split(), float)
                    for tag in ("imls", "poes")
                )
            else:
                # weak shaking, of which there is much, fells nothing
                assert imls.get("noDamageLimit") == imls.get("minIML")
                params = function.find("n:params", space)
                m, s = (float(params.get(name)) for name in ("mean", "stddev"))
                # lognormal of mean m and standard deviation s, by its variance alone
                sigma = np.sqrt(np.log(1.0 + (s / m) ** 2))
                x = np.geomspace(float(imls.get("minIML")), float(imls.get("maxIML")), 20)
                p = stats.lognorm(sigma, scale=m * np.exp(-0.5 * sigma**2)).cdf(x)
            np.testing.assert_allclose(p, fit.probability(x), atol=2e-6)
            assert p[[0, -1]] == pytest.approx(nrml.TAILS, abs=2e-6)  # from few falls to nearly all
            assert np.all(np.diff(x) > 0.0)


def test_equal_rates_at_the_low_end_are_one_point(tmp_path):
    """Below the last of them the curve says nothing: 5 usable points, from 0.01."""
    path = tmp_path / "hazard.csv"
    path.write_text(
        "pga_g,annual_rate\n0.002,0.01\n0.01,0.01\n0.05,7e-3\n0.1,3e-3\n0.2,8e-4\n0.4,1e-4\n"
    )
    found = read_hazard(path, 0.27)
    np.testing.assert_allclose(found.intensity, [0.01, 0.05, 0.1, 0.2, 0.4])
    path.write_text("pga_g,annual_rate\n0.01,0.01\n0.05,7e-3\n0.1,7e-3\n")
    with pytest.raises(HazardError, match="expected it to fall"):
        read_hazard(path, 0.27)


@pytest.mark.parametrize(
    ("measure", "factor"), [("pga_g", 981.0), ("pga_g", 9.81), ("pga_g", 1e-3), ("pgv_cm_s", 1e-2)]
)
def test_a_curve_in_another_unit_is_refused_at_either_end(tmp_path, measure, factor):
    """A site of 0.25 g (25 cm/s) in 475 years, in gal, in m/s², in thousandths and in m/s."""
    path, own = tmp_path / "hazard.csv", {"pga_g": 1.0, "pgv_cm_s": 100.0}[measure]
    x, years = np.array([0.03, 0.1, 0.25, 0.45, 0.7]), np.array([20.0, 100.0, 475.0, 2475.0, 1e4])

    def write(by):
        rows = "".join(f"{by * a:g},{1 / t:g}\n" for a, t in zip(x, years, strict=True))
        path.write_text(f"{measure},annual_rate\n" + rows)

    write(own)
    assert len(read_hazard(path, 0.27).intensity) == 5
    write(own * factor)
    with pytest.raises(HazardError, match="are the units right"):
        read_hazard(path, 0.27)
