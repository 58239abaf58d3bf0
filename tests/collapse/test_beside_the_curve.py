"""What stands beside the PGA of collapse: bounds, agreement, ends of ratios, signs, fallbacks."""

import numpy as np
import pandas as pd
import pytest
from rocking import Motion, history
from rocking.collapse import hidden, probability, quick
from rocking.collapse.agreement import compared
from rocking.collapse.cautions import cautions, scale_factors
from rocking.collapse.crossing import between
from rocking.records import Record
from scipy.stats import fisher_exact
from study_cases import study_case


def rung(window, many, low_g=0.2):
    """So many amplitudes spread over one window [g]."""
    first = 0.5 + window  # the first window begins half a width up
    return low_g * np.exp(hidden.WINDOW * (first + (np.arange(many) + 0.5) / many))


def stood(counts, low_g=0.2):
    """Histories that all stood, whose peaks scatter, so many in each window; one fell above."""
    pga_g = np.concatenate([rung(k, n) for k, n in enumerate(counts)])
    reached = np.where(np.arange(pga_g.size) % 2, 0.9, 0.2)
    table = pd.DataFrame({"pga_g": pga_g, "collapsed": 0, "d_over_b": reached})
    end = low_g * np.exp(hidden.WINDOW * (0.5 + len(counts)))
    return table, low_g, end * (1.0 + 1e-9)


@pytest.mark.parametrize("counts", [(30, 6, 20), (6, 30, 20), (40, 40, 8)])
def test_the_bound_is_that_of_the_window_with_the_fewest_histories(counts):
    table, low_g, high_g = stood(counts)
    assert len(hidden.windows(low_g, high_g)) == len(counts)
    for confidence in (0.95, 0.8):
        bound = hidden.unseen(table, low_g, high_g, confidence)
        assert 0.0 < bound < 1.0
        assert (1.0 - bound) ** min(counts) == pytest.approx(1.0 - confidence, rel=1e-9)


def test_an_empty_window_may_hide_anything():
    table, low_g, high_g = stood((20, 0, 20))
    assert hidden.unseen(table, low_g, high_g) == 1.0


@pytest.mark.parametrize(
    ("fell_yade", "fell_planar", "agrees"),
    # of 5 and 9: all against none is 1 of 2002; 5 against 4 of 9 is 0.086; 0 against 8, 0.003
    [(5, 0, 0), (5, 9, 1), (5, 4, 1), (0, 8, 0), (0, 5, 1), (3, 5, 1)],
)
def test_two_shares_agree_unless_an_exact_test_of_their_counts_rejects_it(
    fell_yade, fell_planar, agrees
):
    p = fisher_exact([[fell_yade, 5 - fell_yade], [fell_planar, 9 - fell_planar]])[1]
    assert agrees == int(p >= 0.01)
    scan = pd.DataFrame({"pga_g": 0.3 * (1.0 + 1e-4 * np.arange(-4, 5)), "status": "ok"})
    scan["collapsed"] = (np.arange(9) % 9 < fell_planar).astype(int)
    outcomes = [1] * fell_yade + [0] * (5 - fell_yade)
    ensemble = pd.DataFrame({"pga_g": 0.3, "status": "ok", "collapsed": outcomes})
    table = compared(scan, ensemble, 0.01)
    row = table[table["realisations_yade"].notna()].iloc[0]
    assert row["agrees"] == agrees
    assert row["probability_yade"] == fell_yade / 5
    assert row["realisations"] == 9
    assert row["probability"] == pytest.approx(fell_planar / 9, abs=0.06)


def test_a_ratio_lies_between_what_the_scatter_of_both_leaves():
    """0.2 (0.18 to 0.24) over 0.4 (0.38 to 0.5): 0.5, from 0.18/0.5 to 0.24/0.38."""
    low, high = quick.ENDS
    table = pd.DataFrame({"pga_median_g": [0.4, 0.2], low: [0.38, 0.18], high: [0.5, 0.24]})
    found = quick.over_first(table)[list(quick.RATIO)].to_numpy()
    assert found[1] == pytest.approx([0.5, 0.18 / 0.5, 0.24 / 0.38])
    assert found[0] == pytest.approx([1.0, 0.38 / 0.5, 0.5 / 0.38])


def test_a_level_near_one_that_few_realisations_cannot_show_takes_those_further_up():
    """19 that all fell show 0.875 at the least, twice as many 0.93; one far above stood.

    Without those further up 0.9 would be sure only above that one.
    """

    def upper(many, level):
        pga_g = 0.3 * np.exp(np.arange(-0.1, 0.3, 0.02 / many))
        fell = pga_g >= 0.3 * (1.0 - 1e-9)
        fell[np.argmin(np.abs(pga_g - 0.36))] = False
        return between(pga_g, fell, np.full(pga_g.size, 1.0), 0.01, level)[1]

    assert upper(18, 0.9) == pytest.approx(0.3, rel=0.015)
    assert upper(60, 0.9) == pytest.approx(0.3, rel=0.015)
    assert upper(8, 0.9) > 0.35  # twice as many are too few as well
    assert upper(18, 0.8) == pytest.approx(0.3, rel=0.015)


def test_half_collapse_without_its_probability_is_the_middle_and_from_nothing_where_none_stood():
    table = pd.DataFrame(
        {
            "pga_safe_g": [0.2, np.nan, 0.3, np.nan],
            "pga_collapse_g": [0.4, 0.4, 0.5, np.nan],
            "pga_median_g": [np.nan, np.nan, 0.45, np.nan],
        }
    )
    assert probability.half_collapse(table).tolist()[:3] == pytest.approx([0.3, 0.2, 0.45])
    assert np.isnan(probability.half_collapse(table).iloc[3])


@pytest.mark.parametrize(
    ("safe", "collapse", "most", "expected"),
    [
        (0.2, 0.4, 0.4, ([0.2, 0.4], [0.0, 1.0])),
        (np.nan, 0.4, 0.4, ([0.2, 0.4], [0.0, 1.0])),  # nothing stood: half of what fell
        (0.3, 0.4, 0.9, ([0.3, 0.4], [0.0, 1.0])),
        (0.9, np.nan, 0.9, ([0.9], [0.0])),
        (np.nan, np.nan, np.nan, ([], [])),
    ],
)
def test_a_curve_of_few_runs_is_a_threshold(safe, collapse, most, expected):
    blank = pd.DataFrame(columns=probability.PROBABILITY_COLUMNS)
    row = {"pga_safe_g": safe, "pga_collapse_g": collapse, "pga_max_g": most}
    found = probability.dense_share(blank, row)
    assert [part.tolist() for part in found] == [pytest.approx(part) for part in expected]


def test_a_rotation_is_outward_where_the_top_is():
    """Of a block that rocks on its edge d = h sin θ, with the sign of both."""
    case = study_case("W1", {"numerics.after_motion_s": 1.0, "smdof": {"tail_s": 1.0}})
    t = 0.01 * np.arange(160)
    pulse = Motion(Record("pulse", -np.sin(2.5 * np.pi * t) * (t < 0.8), 0.01, source="file"))
    height, thickness = (case["facade"][key] for key in ("height_m", "thickness_m"))
    table = history(case, pulse, "pos", 0.2).table
    far = table["d_over_b"].abs() > 0.1
    assert far.sum() > 20
    turned = height / thickness * np.sin(table["rotation_rad"][far])
    assert turned.to_numpy() == pytest.approx(table["d_over_b"][far].to_numpy(), rel=0.1)
    speed = np.gradient(table["d_over_b"] * thickness, table["time_s"])[far]
    fastest = np.abs(speed).max()
    assert table["velocity_m_s"][far].to_numpy() == pytest.approx(speed, abs=0.1 * fastest)


@pytest.mark.parametrize("away", [0.3, -0.3])
def test_a_peak_off_the_branch_leaves_doubt_on_either_side_of_it(away):
    low = hidden.windows(0.2, 0.2 * np.exp(5.5 * hidden.WINDOW))
    pga_g = np.concatenate([rung(k, 200) for k in range(-1, 6)])

    def doubts(peaks):
        """Windows in doubt, each with what its histories could come to."""
        reached = np.full(pga_g.size, np.nan)
        for one in low:
            inside = (pga_g >= one * (1.0 - 1e-9)) & (pga_g < one * np.exp(hidden.WINDOW))
            reached[inside] = hidden.reach(pga_g, peaks, one)[inside]
        return hidden.doubtful(pga_g, peaks, reached, low)

    peaks = 0.6 + np.zeros(pga_g.size)
    assert not doubts(peaks).any()
    peaks[900] += away
    assert doubts(peaks).any()


def test_what_never_fell_rests_on_no_histories():
    table = pd.DataFrame({"pga_g": np.geomspace(0.1, 1.0, 300), "status": "ok", "collapsed": 0})
    found = probability.summary(table.assign(d_over_b=0.1), (), (), 0.01)
    assert np.isnan([found["collapse_fell"], found["collapse_realisations"]]).all()
    assert np.isnan(found["pga_collapse_g"])
    assert found["pga_safe_g"] == 1.0


def test_a_curve_whose_band_is_wider_than_a_tenth_is_counted():
    records = pd.DataFrame({"record": ["A"], "source": ["file"], "pga_g": [0.2]})
    runs = pd.DataFrame({"record": ["A"], "pga_g": [0.3], "status": ["ok"]})
    collapse = pd.DataFrame({"record": "A", "pga_collapse_g": [0.2, 0.2, 0.2]})
    collapse = collapse.assign(pga_p10_g=[0.2, 0.2, np.nan], pga_p90_g=[0.23, 0.21, np.nan])
    collapse = collapse.assign(pga_median_g=0.2, pga_all_g=0.3, pga_max_g=0.4)
    factors = scale_factors(records, runs, collapse)
    assert factors["scale_factor"].tolist() == pytest.approx([1.5])
    wide = [line for line in cautions(records, runs, collapse, factors) if "no single" in line]
    assert [line.split(" curves")[0] for line in wide] == ["1 of 3"]
    narrow = collapse.assign(pga_p90_g=0.21)
    assert not any("no single" in line for line in cautions(records, runs, narrow, factors))
