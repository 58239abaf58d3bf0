"""What explicit runs of a building are read for: its ringing, and how far its modes have it."""

from types import SimpleNamespace

import numpy as np
import pytest
from studies.building.explicit import AFTER_S, differences, ringing_period, second_along_y
from studies.building.history import PointHistory

TIME_S = np.arange(0.0, 3.0, 0.0005)


@pytest.mark.parametrize(("period_s", "damping"), [(0.137, 0.01), (0.137, 0.05), (0.27, 0.0)])
def test_the_period_is_that_of_the_ringing_not_of_what_dies_down_or_stays(period_s, damping):
    """What comes before AFTER_S is of another period; a quiet tail of noise does not count."""
    omega = 2.0 * np.pi / period_s
    ringing = np.exp(-damping * omega * TIME_S) * np.cos(omega * TIME_S)
    short = np.exp(-25.0 * TIME_S) * np.cos(9.3 * omega * TIME_S)
    hum = 1e-4 * ringing[TIME_S >= AFTER_S].max() * np.sin(31.0 * omega * TIME_S)
    value = ringing + short + hum
    assert ringing_period(TIME_S, value) == pytest.approx(period_s, rel=0.003)
    start, tail = TIME_S < AFTER_S, TIME_S > AFTER_S + 2.0
    value[start] = np.sin(2.0 * np.pi * TIME_S[start] / 0.05)
    value[tail] = 1e-4 * np.sin(2.0 * np.pi * TIME_S[tail] / 0.02)
    assert ringing_period(TIME_S, value) == pytest.approx(period_s, rel=0.003)


@pytest.mark.parametrize(
    ("along_y", "period_s", "second"),
    [
        ((0.5, 0.3, 0.0, 0.1), (0.30, 0.28, 0.12, 0.09), 3),  # the second is a twin of the first
        ((0.5, 0.3, 0.0, 0.1), (0.30, 0.15, 0.12, 0.09), 1),
        ((0.1, 0.6, 0.05, 0.2), (0.5, 0.3, 0.2, 0.1), 3),
        ((0.6, 0.1, 0.3, 0.0), (0.3, 0.28, 0.1, 0.05), 2),  # bends, though not the next
    ],
)
def test_a_twin_of_the_first_mode_is_not_the_second_along_y(along_y, period_s, second):
    ratio = np.zeros((4, 6))
    ratio[:, 1] = along_y
    modes = SimpleNamespace(
        effective_ratio=ratio,
        period_s=np.array(period_s),
        largest=lambda direction: int(np.argmax(along_y)),
    )
    assert second_along_y(modes) == second


def test_a_run_is_at_no_distance_from_itself_and_each_point_and_quantity_is_its_own():
    a, d = (np.array([np.sin(k * TIME_S) for k in ks]) for ks in ((5.0, 7.0), (2.0, 3.0)))
    history = PointHistory(TIME_S, 0.0 * TIME_S, a, d)
    run = np.column_stack([TIME_S, *a, *d])
    other = run.copy()
    other[:, 4] *= 1.1  # the displacement of the second point
    rows = differences({"run": run, "other": other}, {"modal": history}, ("top", "corner"))
    wme = {row[:1] + row[2:4]: row[4] for row in rows}
    assert len(rows) == 8
    assert wme.pop(("other", "corner", "displacement")) > 0.01
    assert max(wme.values()) < 1e-12
