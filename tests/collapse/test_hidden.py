"""Where a fall could hide among histories that stood: peaks that leave a straight line."""

import numpy as np
import pytest
from rocking.collapse.hidden import doubtful, needed, windows

PLACES = np.arange(-1.0, 9.0, 0.1)  # of amplitudes, in widths of a window above 0.2 g
PGA_G = 0.2 * 1.01**PLACES
LOW_G = windows(0.2, 0.2 * 1.01**8)
LINE = 0.4 + 0.05 * PLACES


def test_windows_begin_half_a_width_up_and_end_below_the_fall():
    assert pytest.approx(0.2 * 1.01 ** np.arange(0.5, 7.0)) == LOW_G
    assert len(windows(0.2, 0.2 * 1.01**1.4)) == 0


def test_nothing_hides_on_one_branch():
    assert not doubtful(PGA_G, LINE, LOW_G).any()


def test_a_peak_off_the_branch_leaves_its_window_and_those_beside_it_in_doubt():
    """Off by 0.05 of d/b two widths up; where no peak comes to 0.45 it tells nothing."""
    off = np.where(np.isclose(PLACES, 2.0), 0.05, 0.0)
    expected = [True, True, True, False, False, False, False]
    assert doubtful(PGA_G, LINE + off, LOW_G).tolist() == expected
    assert not doubtful(PGA_G, 0.39 + off, LOW_G).any()
    assert doubtful(PGA_G, 0.41 + off, LOW_G).tolist() == expected


def test_few_histories_or_unknown_peaks_leave_doubt():
    """Three widths hold four histories that lie on a line, or one whose peak is not known."""
    assert doubtful(PGA_G[::8], LINE[::8], LOW_G).all()
    assert not doubtful(PGA_G[::5], LINE[::5], LOW_G).any()
    unknown = np.where(np.isclose(PLACES, 2.0), np.nan, LINE)
    assert doubtful(PGA_G, unknown, LOW_G).tolist()[:4] == [True, True, True, False]


@pytest.mark.parametrize(("share", "n"), [(0.1, 29), (0.03, 99)])
def test_so_many_histories_find_a_share_of_collapse(share, n):
    """Twenty to one, by draws: one of n falls in 95 % of the cases, of one fewer in less."""
    assert needed(0.95, share) == n
    drawn = np.random.default_rng(6).binomial(n, share, 200_000)
    assert np.mean(drawn > 0) == pytest.approx(0.951, abs=0.004)
