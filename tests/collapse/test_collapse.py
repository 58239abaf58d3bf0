"""Collapse as a probability: shares, first crossings, what is safe, realisations, agreement."""

import numpy as np
import pandas as pd
import pytest
from rocking.collapse import agreement, hidden, probability
from rocking.collapse.plan import SLIGHT, plan

GRID = np.geomspace(0.1, 1.0, 1200)


def scan(fell):
    """Outcomes of a dense scan by a rule of amplitude."""
    fallen = np.array([bool(fell(g)) for g in GRID])
    status = np.where(fallen, "overturned", "ok")
    reached = np.where(fallen, 1.0, 0.9 * GRID)
    return pd.DataFrame(
        {"pga_g": GRID, "status": status, "collapsed": fallen.astype(int), "d_over_b": reached}
    )


def runs(*pairs):
    """YADE's runs as (PGA, fell)."""
    table = pd.DataFrame(pairs, columns=["pga_g", "collapsed"])
    return table.assign(status=np.where(table["collapsed"] == 1, "overturned", "ok"))


def test_share_is_that_of_the_realisations_within_the_spread():
    table = scan(lambda g: g > 0.5)
    share, realisations = probability.probability(GRID, table["collapsed"], [0.3, 0.5, 0.7], 0.02)
    assert share[[0, 2]].tolist() == [0.0, 1.0]
    assert share[1] == pytest.approx(0.5, abs=0.05)
    inside = np.abs(GRID / 0.5 - 1.0) <= 0.02
    assert realisations[1] == inside.sum()
    assert np.isnan(probability.probability(GRID, table["collapsed"], [2.0], 0.01)[0][0])


def test_realisations_that_a_search_adds_on_one_side_do_not_move_a_probability():
    """Five times as many just below a threshold: 10, 50 and 90 % stay where they were."""
    more = np.exp(np.linspace(np.log(0.48), np.log(0.4999), 200))
    pga_g = np.sort(np.concatenate([GRID, more]))
    crossings = []
    for at in (GRID, pga_g):
        share, _ = probability.probability(at, at > 0.5, at, 0.02)
        crossings.append([probability.first_crossing(at, share, p) for p in (0.1, 0.5, 0.9)])
    assert crossings[0] == pytest.approx([0.5 * 0.984, 0.5, 0.5 * 1.016], rel=2e-3)
    assert crossings[1] == pytest.approx(crossings[0], rel=2e-3)


def test_realisations_at_one_amplitude_count_alike():
    share, count = probability.probability([0.3] * 4, [0, 1, 1, 1], [0.3], 0.01)
    assert (share[0], count[0]) == (0.75, 4)


def test_a_separate_range_below_the_main_collapse_is_the_lowest_collapse():
    """Falls at 0.30 to 0.33 g, stands to 0.6 g: nothing above 0.30 g is safe."""
    found = probability.summary(
        scan(lambda g: 0.30 < g < 0.33 or g > 0.6), runs((0.2, 0), (0.4, 0), (0.7, 1)), (), 0.01
    )
    assert found["pga_collapse_g"] == pytest.approx(0.30, rel=0.003)
    assert 0.29 < found["pga_safe_g"] < 0.30
    assert found["pga_safe_g"] * 1.01 < found["pga_collapse_g"]  # nothing fell within the spread
    for name in ("p10", "median", "p90"):
        assert found[f"pga_{name}_g"] == pytest.approx(0.30, rel=0.012)
    assert found["pga_all_g"] == pytest.approx(0.60, rel=0.003)
    assert found["reversals"] == 2
    assert (found["runs_planar"], found["runs_yade"]) == (len(GRID), 3)


def test_what_may_hide_below_the_safe_amplitude():
    """Scatter from 0.4 g on, so many histories a window, none fell: Clopper and Pearson."""
    for count in (20, 29, 100):
        pga_g = 0.1 * np.exp(hidden.WINDOW * np.arange(0.0, 230.0, 1.0 / count))
        rng = np.random.default_rng(count)
        reached = np.where(pga_g < 0.4, pga_g / 2.0, 0.4 + 0.3 * rng.random(pga_g.size))
        table = pd.DataFrame({"pga_g": pga_g, "status": "ok", "collapsed": 0, "d_over_b": reached})
        bound = probability.summary(table, (), (), 0.01)["safe_bound"]
        assert (1.0 - bound) ** count == pytest.approx(0.05, rel=0.3)
        smooth = probability.summary(table.assign(d_over_b=pga_g), (), (), 0.01)
        assert np.isnan(smooth["safe_bound"])


def test_a_lowest_collapse_says_on_how_many_histories_it_rests():
    table = scan(lambda g: g > 0.5)
    table.loc[table["pga_g"].sub(0.3).abs().idxmin(), ["status", "collapsed"]] = "overturned", 1
    found = probability.summary(table, (), (), 0.01)
    assert found["pga_collapse_g"] == pytest.approx(0.3, rel=0.002)
    assert found["collapse_fell"] == 1
    assert found["collapse_realisations"] == np.count_nonzero(np.abs(GRID / 0.3 - 1.0) <= 0.011)
    assert found["pga_p10_g"] > 0.45
    many = probability.summary(scan(lambda g: g > 0.5), (), (), 0.01)
    assert 4 <= many["collapse_fell"] < many["collapse_realisations"]


def test_a_collapse_in_yade_alone_is_not_safe():
    """The engine that confirms has the last word on what is safe."""
    found = probability.summary(scan(lambda g: g > 0.6), runs((0.45, 1)), (), 0.01)
    assert found["pga_collapse_g"] == 0.45
    assert found["pga_safe_g"] < 0.45
    assert found["pga_median_g"] == pytest.approx(0.6, rel=0.01)


def test_a_facade_that_never_fell_is_a_bound_and_failed_runs_say_nothing():
    table = runs((0.2, 0), (3.0, 0))
    table.loc[2] = [2.0, 1, "failed"]
    found = probability.summary(None, table, (), 0.01)
    assert np.isnan([found[f"pga_{n}_g"] for n in ("collapse", "median", "all")]).all()
    assert (found["pga_safe_g"], found["pga_max_g"], found["runs_planar"]) == (3.0, 3.0, 0)
    blank = pd.DataFrame(columns=probability.PROBABILITY_COLUMNS)
    assert probability.brackets(blank, found) == [(3.0, np.inf, 1.0)]


def test_realisations_of_a_curve_follow_its_probability():
    """A linear rise of probability gives realisations spread evenly, of total weight one."""
    table = pd.DataFrame({"pga_g": GRID, "probability": np.clip((GRID - 0.4) / 0.2, 0, 1)})
    realisations = probability.brackets(table.assign(realisations=9), {}, count=10)
    low, high, weight = np.array(realisations).T
    assert weight.sum() == pytest.approx(1.0)
    assert 0.5 * (low + high) == pytest.approx(0.4 + 0.2 * (np.arange(10) + 0.5) / 10, abs=1e-3)
    half = table.assign(realisations=9, probability=0.5 * table["probability"])
    assert sum(w for _, high, w in probability.brackets(half, {}) if np.isinf(high)) == 0.5


def test_amplitudes_of_the_same_digits_are_one():
    """Near 0.13 g a scan has steps of 0.0001 g or less, which is the table's last digit."""
    rows = [(0.1286, 0.02), (0.1287, 0.04), (0.1287, 0.5), (0.1287, 0.5), (0.1288, 1.0)]
    table = pd.DataFrame(rows, columns=["pga_g", "probability"]).assign(realisations=9)
    low, high, _ = np.array(probability.brackets(table, {}, count=10)).T
    assert np.all(low < high)
    assert np.array_equal(np.unique(high, return_counts=True)[1], [5, 5])
    assert np.array_equal(np.unique(low), [0.1286, 0.1287])


def test_a_list_of_intensities_is_told_by_its_own_runs():
    """Between two neighbours of different outcome the share rises linearly from 0 to 1."""
    sparse = runs((0.1, 0), (0.2, 0), (0.3, 1), (0.6, 1))
    found = probability.summary(None, sparse, (), 0.01)
    for name, share in (("p10", 0.1), ("median", 0.5), ("p90", 0.9)):
        assert found[f"pga_{name}_g"] == pytest.approx(0.2 + 0.1 * share)
    assert (found["pga_safe_g"], found["pga_collapse_g"], found["pga_all_g"]) == (0.2, 0.3, 0.3)
    assert len(agreement.compared(None, pd.DataFrame(), 0.01)) == 0


def test_disagreement_is_beyond_the_scatter_of_both():
    """Eleven realisations that stand where all planar ones fall disagree; one of 11 does not."""
    dense = scan(lambda g: g > 0.5)
    realisations = [
        runs(*[(g, int(i < fell)) for i in range(11)]) for g, fell in ((0.7, 0), (0.8, 10))
    ]
    table = agreement.compared(dense, pd.concat(realisations), 0.01)
    levels = table[table["realisations_yade"].notna()].set_index("pga_g")
    assert levels["agrees"].to_dict() == {0.7: 0.0, 0.8: 1.0}
    assert levels.loc[0.8, "probability_yade"] == pytest.approx(10 / 11)
    assert agreement.disagreements(table) == int((table["agrees"] == 0).sum())
    alone = agreement.compared(dense, pd.DataFrame(), 0.01)
    assert pd.isna(agreement.disagreements(alone))  # none was compared, which is not none differs


def test_the_plan_goes_where_outcomes_change():
    """Both sides of the lowest collapse, the range and the gap above; levels of 10, 50, 90 %."""
    ida = {
        "start_g": 0.1,
        "growth": 1.35,
        "max_pga_g": 3.0,
        "max_collapse_ranges": 4,
        "confirm": "full",
    }
    ensemble = {"percentiles": [10.0, 90.0], "amplitude_spread": 0.01, "enabled": "auto"}
    ensemble |= {"realisations": 3, "seed": 1, "perturb": ["amplitude"]}
    table = scan(lambda g: 0.30 < g < 0.40 or g > 0.6)
    found = plan(table, ida, ensemble)
    runs_g = np.array(found["runs"])
    lowest = table.loc[table["collapsed"] == 1, "pga_g"].min()
    assert np.abs(runs_g / lowest - 1.0).min() < 1e-3
    assert np.abs(runs_g / (0.97 * lowest) - 1.0).min() < 1e-3
    assert ((runs_g > 0.32) & (runs_g < 0.38)).any()  # in the separate range
    assert ((runs_g > 0.45) & (runs_g < 0.55)).any()  # in the gap above it
    below, above = found["levels"]  # 10, 50 and 90 % lie together
    assert 0.290 < below < 0.300 < above < 0.310
    said = np.array(found["probability"])  # by level, realisation and hypothesis
    assert said.shape == (2, 3, 3)
    assert np.all((said[0, :, 0] < 0.3) & (said[0, :, 1] > 0.7))  # a shift of 3 % would show
    assert np.all((said[1, :, 0] > 0.7) & (said[1, :, 2] < 0.3))
    for level, kept in ((0.98 * lowest, 0), (0.85 * lowest, 1)):  # of the climb, one beside a run
        climbed = plan(table, {**ida, "start_g": level / 1.35**2}, ensemble)["runs"]
        assert np.isclose(climbed, level, atol=1e-4).sum() == kept
    slight = table.assign(d_over_b=SLIGHT * np.where(GRID < 0.2, 0.99, 1.01))
    assert plan(slight, ida, ensemble)["runs"][0] == pytest.approx(0.1 * 1.35**2, abs=1e-4)
    slow = table.assign(collapsed=(np.sin(1e4 * GRID) < (GRID - 0.5) * 5).astype(int))
    slow["status"] = np.where(slow["collapsed"] == 1, "overturned", "ok")
    three = plan(slow, ida, ensemble)
    said = np.mean(three["probability"], axis=1)
    assert np.all(np.diff(said[:, 0]) > 0.1)
    assert np.all((said[:, 2] < said[:, 0]) & (said[:, 0] < said[:, 1]))
    few = plan(table, {**ida, "confirm": "collapse"}, ensemble)
    assert few["runs"] == pytest.approx([0.97 * lowest, lowest], abs=1e-4)
    never = plan(scan(lambda g: False), ida, ensemble)
    assert (never["levels"], never["runs"][-1]) == ([], 3.0)
