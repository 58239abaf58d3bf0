"""Searches for collapse against outcomes that are known beforehand, without any solver."""

import numpy as np
import pandas as pd
import pytest
from rocking.collapse import hidden, probability, search
from rocking.collapse.scan import seen_together
from rocking.tables import write_table

from yade_scripts.commands.search import drive

SETTINGS = {"level_ratio": 0.02, "beyond": 1.35, "max_pga_g": 2.0}
SETTINGS |= {"realisations": 6, "amplitude_spread": 0.01, "power": 0.0}
SETTINGS["safe_share"] = 0.03


def searched(strategy, falls):
    """All that a search asked for, by ascending amplitude, and what it found."""
    seen = []

    def run(ask):
        assert np.all(np.diff(ask.pga_g) > 0.0)
        seen.extend(ask.pga_g)
        return ["overturned" if falls(g) else "ok" for g in ask.pga_g]

    found = drive(strategy, run)
    return np.sort(seen), found


def separate_range(g):
    return 0.30 < g < 0.33 or g > 0.5


def test_a_scan_sees_every_change_of_outcome_finely():
    """A separate range wider than a level is found, its edges within a sixth of the window."""
    pga_g, _ = searched(search.scan(0.1, SETTINGS), separate_range)
    fell = np.array([separate_range(g) for g in pga_g])
    assert np.count_nonzero(np.diff(fell)) == 3
    for edge in (0.30, 0.33, 0.5):
        low, high = pga_g[pga_g <= edge].max(), pga_g[pga_g > edge].min()
        assert high / low <= 1.0 + 2.0 * 0.01 / 6.0 + 1e-12
    assert pga_g.max() >= 1.35 * 0.5
    assert pga_g.max() < 2.0


def test_a_façade_that_never_falls_is_climbed_to_the_end_and_no_further():
    pga_g, _ = searched(search.scan(0.1, SETTINGS), lambda g: False)
    assert pga_g[-1] == 2.0
    assert np.diff(np.log(pga_g)).max() <= np.log(1.02) + 1e-12


def test_a_façade_that_falls_at_once_is_scanned_below_the_start():
    """Down to where it stands over a tenth, however far below the start that is."""
    for threshold in (0.36, 0.01):
        pga_g, _ = searched(search.scan(0.4, SETTINGS), lambda g, at=threshold: g > at)
        assert pga_g.min() < threshold / 1.1
        low, high = pga_g[pga_g <= threshold].max(), pga_g[pga_g > threshold].min()
        assert high / low <= 1.0 + 2.0 * 0.01 / 6.0 + 1e-12


@pytest.mark.parametrize(("start", "slope"), [(0.4, 2.0), (0.13, 3.0)])
def test_a_climb_goes_down_to_where_peaks_are_small_over_a_tenth(start, slope):
    """d/b = slope · PGA: from where a fall could hide to below 0.3 over a factor of 1.1."""
    asked = []

    def run(ask):
        g = np.asarray(ask.pga_g)
        asked.extend(g)
        return search.Answer(np.where(slope * g > 1.0, "overturned", "ok"), slope * g)

    drive(search.climb(start, SETTINGS, block=4), run)
    calm = search.CALM / slope / search.CALM_RATIO
    assert calm * 1.02**-5 < min(asked) <= calm * 1.02


def test_a_façade_that_falls_at_any_amplitude_ends_the_scan():
    pga_g, _ = searched(search.scan(0.4, SETTINGS), lambda g: True)
    assert 0.0 < pga_g.min() < search.LEAST_G


def chaotic(seed, share, at_g=0.3, ratio=1.01):
    """Outcomes of a façade that falls above 0.5 g, and for a share of histories in one window.

    Below 0.25 g its answers follow one branch; above they scatter.
    """
    rng = np.random.default_rng(seed)

    def run(ask):
        g = np.asarray(ask.pga_g)
        d_over_b = np.where(g < 0.25, g / 0.5, 0.3 + 0.5 * rng.random(g.size))
        fell = (g > 0.5) | ((g > at_g) & (g < at_g * ratio) & (rng.random(g.size) < share))
        status = np.where(fell, "overturned", "ok")
        return search.Answer(status, np.where(fell, 1.0, d_over_b))

    return run


def lowest_fall(settings, run):
    """Lowest amplitude that falls, and how many were run."""
    seen = []

    def recorded(ask):
        answer = run(ask)
        seen.extend(zip(ask.pga_g, answer.status, strict=True))
        return answer

    drive(search.scan(0.1, settings), recorded)
    return min(g for g, status in seen if status == "overturned"), len(seen)


def later_swing(told):
    """A façade whose largest peak follows one branch and that falls above 0.5 g.

    A later swing scatters from 0.40 to 0.44 g; it goes over in 0.1 % of amplitude, at 0.42 g.
    `told`: whether the search learns of it.
    """

    def run(ask):
        g = np.asarray(ask.pga_g)
        fell = (g > 0.5) | ((g > 0.42) & (g < 0.42 * 1.001))
        first = np.where(g > 0.5, 1.0, 1.3 * g)
        wild = 0.3 + 0.18 * np.sin(4e5 * g)
        later = np.where((g > 0.4) & (g < 0.44), wild, 0.2)
        later = np.where(fell, 1.0, later)
        status = np.where(fell, "overturned", "ok")
        swings = np.stack([first, later], axis=1) if told else None
        return search.Answer(status, swings.max(axis=1) if told else np.fmax(first, later), swings)

    return run


def test_a_fall_in_a_later_swing_is_found_though_the_largest_peak_tells_nothing():
    """Levels 2 % and then 0.33 % apart step over it; by the largest peak alone it stays hidden."""
    settings = {**SETTINGS, "power": 0.95}
    found, runs = lowest_fall(settings, later_swing(True))
    assert 0.42 < found < 0.42 * 1.001
    hidden_, few = lowest_fall(settings, later_swing(False))
    assert hidden_ == pytest.approx(0.5, rel=0.01)
    assert runs > few + hidden.needed(0.95) / 3


def test_the_table_keeps_what_the_search_knew_of_later_swings(tmp_path):
    """Read back, it bounds what may hide as the search meant; by the largest peaks alone it errs.

    A later swing scatters and falls nowhere: the windows about it have their histories. Those that
    fell, and the first of all, have no window that says anything.
    """

    def run(asks):
        tables = []
        for _, pga_g, _ in asks:
            g = np.asarray(pga_g, float)
            answer = later_swing(True)(search.Ask(g * np.where(abs(g - 0.42) < 1e-3, 0.9, 1.0)))
            fell = (answer.status == "overturned").astype(int)
            said = {"pga_g": g, "d_over_b": answer.d_over_b, "status": answer.status}
            tables.append((pd.DataFrame({**said, "collapsed": fell}), answer.swings))
        return tables

    settings = {**SETTINGS, "power": 0.95}
    ((table, _),) = seen_together([(None, search.scan(0.1, settings))], run)
    write_table(table, tmp_path / "scan.csv", digits="%.8g")
    kept = pd.read_csv(tmp_path / "scan.csv")
    assert kept.loc[kept["collapsed"] == 1, "reach"].isna().all()
    wild = kept["pga_g"].between(0.405, 0.435)
    assert (kept.loc[wild, "reach"] > 1.0).all()
    assert (kept.loc[kept["pga_g"].between(0.3, 0.39), "reach"] < 1.0).all()
    bound = 1.0 - 0.05 ** (1.0 / hidden.needed(0.95))
    assert probability.summary(kept, (), (), 0.01)["safe_bound"] <= bound + 1e-12
    few = kept[~wild | (np.arange(len(kept)) % 5 == 0)]
    assert probability.summary(few, (), (), 0.01)["safe_bound"] > 2.0 * bound
    one = few.drop(columns="reach").assign(d_over_b=1.3 * few["pga_g"])
    assert probability.summary(one, (), (), 0.01)["safe_bound"] <= bound + 1e-12


def test_a_third_of_the_realisations_may_tell_that_nothing_hides():
    """A swing as a wave of 0.08 over 1 % of amplitude: steps of 0.33 % leave doubt, finer none."""

    def wave(ask):
        g = np.asarray(ask.pga_g)
        wavy = 0.55 + 0.08 * np.sin(2.0 * np.pi * np.log(g) / np.log(1.01)) * (g > 0.4) * (g < 0.41)
        fell = g > 0.5
        return search.Answer(np.where(fell, "overturned", "ok"), np.where(fell, 1.0, wavy))

    asked = []

    def recorded(ask):
        asked.extend(ask.pga_g)
        return wave(ask)

    drive(search.scan(0.1, {**SETTINGS, "power": 0.95}), recorded)
    there = np.sum((np.array(asked) > 0.402) & (np.array(asked) < 0.402 * 1.01))
    assert 0.25 * hidden.needed(0.95) < there < 0.7 * hidden.needed(0.95)


@pytest.mark.slow
@pytest.mark.parametrize("share", [0.03, 0.1])
def test_the_stated_power_is_reached_and_not_without_its_realisations(share):
    """Ranges of 3 or 10 % over 1 % of amplitude, 20 to 40 % below the collapse, in 150 curves."""
    places = 0.3 * (1.0 + 0.3 * np.random.default_rng(1).random(150))
    settings = {**SETTINGS, "safe_share": share}
    found = {
        power: np.mean(
            [
                lowest_fall({**settings, "power": power}, chaotic(k, share, at))[0] < 0.45
                for k, at in enumerate(places)
            ]
        )
        for power in (0.0, 0.8, 0.95)
    }
    assert found[0.95] > 0.95 - 2.0 * np.sqrt(0.95 * 0.05 / 150)
    assert 0.8 - 2.0 * np.sqrt(0.8 * 0.2 / 150) < found[0.8] < found[0.95]
    assert found[0.0] < 0.2


def test_a_table_of_the_search_says_that_its_power_was_reached(tmp_path):
    """Levels 1 % apart, as wide as the windows that are counted, from a table of eight digits."""
    settings = {**SETTINGS, "level_ratio": 0.01, "power": 0.95}
    for seed in range(10):
        rows, run = [], chaotic(seed, 0.0)

        def recorded(ask, rows=rows, run=run):
            answer = run(ask)
            rows += zip(ask.pga_g, answer.status, answer.d_over_b, strict=True)
            return answer

        drive(search.scan(0.1, settings), recorded)
        table = pd.DataFrame(rows, columns=["pga_g", "status", "d_over_b"])
        table["collapsed"] = (table["status"] == "overturned").astype(int)
        write_table(table.sort_values("pga_g"), tmp_path / "scan.csv", digits="%.8g")
        bound = probability.summary(pd.read_csv(tmp_path / "scan.csv"), (), (), 0.01)["safe_bound"]
        assert bound <= 1.0 - 0.05 ** (1.0 / hidden.needed(0.95)) + 1e-12


def test_one_branch_costs_no_realisations_beyond_those_beside_its_fall():
    def smooth(ask):
        g = np.asarray(ask.pga_g)
        status = np.where(g > 0.5, "overturned", "ok")
        return search.Answer(status, np.minimum(1.0, (g / 0.5) ** 2))

    lowest, runs = lowest_fall({**SETTINGS, "power": 0.95}, smooth)
    few = lowest_fall(SETTINGS, smooth)[1]
    calm = 0.5 * np.sqrt(search.CALM)
    assert lowest == pytest.approx(0.5, rel=0.01)
    beside = search.EDGE * hidden.needed(0.95)
    assert runs - few <= np.log(0.85 * 0.5 / calm) / np.log(1.0 + 0.02 / 6.0) + beside + 20


def test_a_climb_goes_on_until_all_have_fallen_over_the_stated_factor():
    """Also where a block of levels, all fallen, is shorter than that factor."""
    fine = {**SETTINGS, "level_ratio": 0.002}
    pga_g, _ = searched(search.climb(0.4, fine), lambda g: g < 0.45 or g > 0.5)
    assert pga_g[-1] >= 1.35 * 0.5


def test_a_short_climb_looks_two_of_its_steps_below_its_first_fall():
    """Levels 0.248, 0.277 (stand) and 0.311 g (falls): what falls at 0.26 to 0.27 g is found."""
    for low, high in ((0.26, 0.27), (0.285, 0.30)):
        rule = lambda g, low=low, high=high: low < g < high or g > 0.31  # noqa: E731
        assert not rule(0.1 * 1.12**8) | rule(0.1 * 1.12**9)
        assert rule(0.1 * 1.12**10)
        _, found = searched(search.crossings(0.1, 2.0, 1.12), rule)
        assert found[0] == pytest.approx(low, rel=search.SPREAD)


def test_a_short_climb_is_coarse_where_it_is_calm_and_finds_the_same():
    """d/b = 0.5 g/g_c: calm to 0.6 of the collapse; coarse levels up to there, then all."""
    known = {}
    for at_g in np.geomspace(0.06, 1.9, 23):
        for ratio in (1.03, 1.12):
            for calm in (True, False):
                asked = []

                def run(ask, at_g=at_g, calm=calm, asked=asked):
                    g = np.asarray(ask.pga_g)
                    asked.extend(g if not ask.realisations else ())
                    d = 0.5 * g / at_g if calm else np.full(g.size, np.nan)
                    status = np.where(g > at_g, "overturned", "ok")
                    return search.Answer(status, np.where(g > at_g, 1.0, d))

                known[calm] = drive(search.crossings(0.02, 2.0, ratio), run), len(set(asked))
            assert known[True][0] == known[False][0]
            if ratio == 1.03 and at_g > 0.2:
                assert known[True][1] < 0.6 * known[False][1]


def test_a_short_climb_sees_a_range_of_collapse_above_where_it_is_no_longer_calm():
    """d/b passes 0.3 at 0.4 g; it falls from 0.45 to 0.47 g alone, below the general 1 g."""

    def run(ask):
        g = np.asarray(ask.pga_g)
        fell = (g > 1.0) | ((g > 0.45) & (g < 0.47))
        return search.Answer(np.where(fell, "overturned", "ok"), np.where(fell, 1.0, 0.75 * g))

    low, half = drive(search.crossings(0.02, 2.0, 1.03), run)
    assert low == pytest.approx(0.45, rel=search.SPREAD)
    assert half == pytest.approx(0.45, rel=search.SPREAD)


def test_crossings_of_a_threshold_are_the_threshold():
    """Every realisation above falls: 10 and 50 % are crossed within half a window of it."""
    for ratio in (1.03, 1.12):
        _, found = searched(search.crossings(0.1, 2.0, ratio), lambda g: g > 0.4)
        assert found == pytest.approx((0.4, 0.4), rel=search.SPREAD)
        assert found[0] < found[1]
    assert np.isnan(searched(search.crossings(0.1, 2.0, 1.12), lambda g: False)[1]).all()


@pytest.mark.parametrize("low", np.arange(1.07, 1.2, 0.01))
def test_half_is_crossed_where_half_of_the_whole_window_falls(low):
    """A range of 2 % is less than half of ± 3 %, wherever the blocks of amplitudes end."""
    at_g = 0.1 * 1.01**140  # falls over less than one per cent there, too
    rule = lambda g: 0.999 < g / at_g < 1.003 or low < g / at_g < low + 0.02 or g > 0.6  # noqa: E731
    _, found = searched(search.crossings(0.1, 2.0, 1.01), rule)
    assert found[0] == pytest.approx(at_g, rel=search.SPREAD)
    assert found[1] == pytest.approx(0.6, rel=search.SPREAD)


def test_a_short_climb_looks_below_its_first_fall():
    """A separate range that lies between the levels of the climb's last two steps is found."""
    assert not any(0.30 < 0.1 * 1.12**k < 0.31 for k in range(20))
    _, found = searched(search.crossings(0.1, 2.0, 1.12), lambda g: 0.295 < g < 0.311 or g > 0.313)
    assert found[0] < 0.30


def test_the_first_of_ascending_levels():
    levels = [0.1, 0.2, 0.3, 0.4]
    for block in (1, 3):
        assert searched(search.first(levels, block), lambda g: g > 0.15)[1] == 0.2
    assert np.isnan(searched(search.first(levels), lambda g: g > 1.0)[1])
