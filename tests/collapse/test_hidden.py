"""Where a fall could hide among histories that stood: swings that part from their neighbours'."""

import numpy as np
import pandas as pd
import pytest
from rocking.collapse.hidden import (
    FURTHER,
    NEAR,
    UNSTABLE,
    doubtful,
    needed,
    parted,
    reach,
    unseen,
    windows,
)

PLACES = np.arange(-1.0, 9.0, 0.1)  # of amplitudes, in widths of a window above 0.2 g
PGA_G = 0.2 * 1.01**PLACES
BEGIN_G = PGA_G[0]
LOW_G = windows(BEGIN_G, 0.2 * 1.01**8)
LINE = 0.5 + 0.02 * PLACES
AT = 30  # a history in the middle of a window


def in_doubt(*swings, pga_g=PGA_G):
    """Windows of `LOW_G` that histories of these swings, one a second, leave in doubt."""
    swings = np.stack(swings, axis=1)
    could = reach(pga_g, swings, BEGIN_G)
    return doubtful(pga_g, swings.max(axis=1), could, LOW_G)


def beside(at):
    """Windows of `LOW_G` that hold a history or lie beside one that does."""
    window = np.searchsorted(LOW_G, PGA_G[at], side="right") - 1
    return (abs(np.arange(LOW_G.size) - window) <= 1).tolist()


def off(by, at=AT):
    """A swing of 0.3 but for one history."""
    return np.where(np.arange(PLACES.size) == at, 0.3 + by, 0.3)


def test_windows_begin_half_a_width_up_and_end_below_the_fall():
    assert pytest.approx(0.2 * 1.01 ** np.arange(0.5, 7.0)) == windows(0.2, 0.2 * 1.01**8)
    assert len(windows(0.2, 0.2 * 1.01**1.4)) == 0


def test_nothing_hides_where_every_swing_follows_its_neighbours():
    """Straight lines, of any slope, up to next to the unstable place."""
    assert not in_doubt(LINE, 0.2 + 0.05 * PLACES, 0.89 - 0.01 * PLACES).any()


def test_a_later_swing_that_parts_leaves_doubt_that_the_largest_peak_does_not_tell():
    """The largest peak lies on a line; a swing after it is 0.2 higher in one history of a hundred.

    Windows that hold it, or lie beside the one that does, could hide a fall.
    """
    assert in_doubt(LINE, off(0.2)).tolist() == beside(AT)
    assert np.all(off(0.2) < LINE)
    assert not in_doubt(np.maximum(LINE, off(0.2))).any()


def test_a_swing_may_part_by_a_quarter_of_its_way_to_the_unstable_place():
    """From 0.3 + r, r above its neighbours: 0.3 + r + `FURTHER` · r against `UNSTABLE`."""
    most = (UNSTABLE - 0.3) / (1.0 + FURTHER)
    assert not in_doubt(LINE, off(0.99 * most)).any()
    assert in_doubt(LINE, off(1.01 * most)).tolist() == beside(AT)
    assert in_doubt(LINE, off(-1.01 * (UNSTABLE - 0.3) / FURTHER)).tolist() == beside(AT)


def test_swings_of_different_seconds_do_not_add_up():
    """One is high and repeats, another parts and is low."""
    assert not in_doubt(LINE + 0.3, off(0.05)).any()
    assert in_doubt(np.where(np.arange(PLACES.size) == AT, 0.05, 0.0) + LINE + 0.3).any()


def test_neighbours_are_the_next_and_the_next_but_one():
    """|x|: 0 at the kink, where those next but one are at 2; 1 next to it, between 3 and 1."""
    at = np.arange(9.0)
    found = parted(at, np.abs(at - 4.0)[:, None])[:, 0]
    assert found == pytest.approx([0, 0, 0, 1, 2, 1, 0, 0, 0])
    uneven = np.array([0.0, 1.0, 1.5, 4.0, 4.2, 7.0])
    assert parted(uneven, np.stack([uneven, 3.0 - 2.0 * uneven], axis=1)) == pytest.approx(0.0)


def test_where_no_peak_comes_near_nothing_hides():
    low = NEAR - 0.31
    assert not in_doubt(off(0.0), off(low)).any()
    assert in_doubt(off(0.0), off(low + 0.02)).tolist() == beside(AT)


def test_few_histories_or_unknown_peaks_leave_doubt():
    """Three widths hold four histories that lie on a line, or one whose swings are not known."""
    few = slice(None, None, 8)
    assert in_doubt(LINE[few], pga_g=PGA_G[few]).all()
    assert not in_doubt(LINE[::5], pga_g=PGA_G[::5]).any()
    unknown = np.where(np.arange(PLACES.size) == AT, np.nan, LINE)
    assert in_doubt(unknown).tolist() == beside(AT)


def test_a_window_in_which_nothing_was_run_is_in_doubt_where_peaks_come_near():
    there = (LOW_G[3] > PGA_G) | (LOW_G[3] * 1.01 < PGA_G)
    could = np.full(there.sum(), 0.6)
    assert doubtful(PGA_G[there], LINE[there], could, LOW_G).tolist() == [False] * 3 + [True] + [
        False
    ] * (LOW_G.size - 4)
    assert not doubtful(PGA_G[there], 0.5 * LINE[there], could, LOW_G).any()


def test_what_may_hide_is_told_by_what_the_search_said_of_later_swings():
    """Ten histories a window: 1 − 0.05^(1/10) where one is in doubt, nothing where none is."""
    runs = pd.DataFrame({"pga_g": PGA_G, "collapsed": 0, "d_over_b": LINE})
    later = np.stack([LINE, off(0.2)], axis=1)
    assert np.isnan(unseen(runs, BEGIN_G, PGA_G[-1]))
    bound = unseen(runs.assign(reach=reach(PGA_G, later, BEGIN_G)), BEGIN_G, PGA_G[-1])
    assert bound == pytest.approx(1.0 - 0.05**0.1)


@pytest.mark.parametrize(("share", "n"), [(0.1, 29), (0.03, 99)])
def test_so_many_histories_find_a_share_of_collapse(share, n):
    """Twenty to one, by draws: one of n falls in 95 % of the cases, of one fewer in less."""
    assert needed(0.95, share) == n
    drawn = np.random.default_rng(6).binomial(n, share, 200_000)
    assert np.mean(drawn > 0) == pytest.approx(0.951, abs=0.004)
