"""How many runs confirm a scan: Wald's sequential test against exact binomials."""

import math

import numpy as np
import pandas as pd
import pytest
from rocking.collapse import agreement
from rocking.collapse.agreement import ODDS

from yade_scripts.commands.confirm import ERROR, Confirmation, turns

SHARES = (0.1, 0.5, 0.9)
MOST = 11


def shifted(p, odds):
    return odds * p / (1.0 - p + odds * p)


def sequence(odds, rng):
    """Verdict and number of runs where a façade falls with so many times the odds."""
    test, count = Confirmation(), 0
    for level, _ in turns(SHARES, MOST):
        p = SHARES[level]
        test.add((p, shifted(p, ODDS), shifted(p, 1.0 / ODDS)), rng.random() < shifted(p, odds))
        count += 1
        if test.verdict == 1:
            break
    return test.verdict, count


def trials(odds, count=4000):
    rng = np.random.default_rng(1)
    verdict, runs = zip(*(sequence(odds, rng) for _ in range(count)), strict=True)
    return np.array([math.nan if v is None else v for v in verdict]), np.array(runs)


def test_evidence_of_single_runs():
    """ln of the ratio of two likelihoods: a fall, then none, where 0.5, 0.9 and 0.1 were said."""
    test = Confirmation()
    test.add((0.5, 0.9, 0.1), True)
    assert test.evidence == pytest.approx([math.log(0.5 / 0.9), math.log(0.5 / 0.1)])
    test.add((0.5, 0.9, 0.1), False)
    both = math.log(0.5 / 0.9) + math.log(0.5 / 0.1)
    assert test.evidence == pytest.approx([both, both])
    assert test.verdict is None


def test_every_level_gets_its_runs_the_middle_one_first():
    levels = [0.2, 0.25, 0.3]
    order = list(turns(levels, 2))
    assert order[:4] == [(1, 0), (2, 0), (1, 1), (0, 0)]
    assert sorted(order) == [(level, number) for level in range(3) for number in range(2)]
    assert list(turns([0.4, 0.5], 1)) == [(1, 0), (0, 0)]
    assert list(turns([0.4], 2)) == [(0, 0), (0, 1)]


@pytest.mark.parametrize("odds", [ODDS, 1.0 / ODDS])
def test_a_scan_far_off_is_rarely_confirmed(odds):
    """Wald's bound: at most the stated error, whatever the number of runs."""
    verdict, _ = trials(odds)
    assert np.mean(verdict == 1) <= ERROR
    assert np.mean(verdict == 0) > 0.9


def test_a_true_scan_is_confirmed_by_a_third_of_the_runs():
    verdict, runs = trials(1.0)
    assert np.mean(verdict == 1) > 0.95
    assert np.mean(verdict == 0) <= 2.0 * ERROR  # two alternatives
    assert runs.mean() < len(SHARES) * MOST / 2.5


def step(at_g):
    """Outcomes at amplitudes 0.1 % apart, which fall from `at_g` on."""
    pga_g = np.geomspace(0.1, 0.4, 1400)
    fell = (pga_g >= at_g).astype(int)
    status = np.where(fell == 1, "overturned", "ok")
    return pd.DataFrame({"pga_g": pga_g, "status": status, "collapsed": fell})


def test_where_all_fall_at_once_two_runs_tell_a_shift_of_amplitude():
    """A scan that falls at 0.2 g: runs 1.5 % below and above, of one that falls 0.5 or 4 % off."""
    scan = step(0.2)
    for off, verdict in ((0.995, 1.0), (1.005, 1.0), (0.96, 0.0), (1.04, 0.0)):
        runs = step(0.2 * off).iloc[[0, 0]].assign(pga_g=[0.2 / 1.015, 0.2 * 1.015])
        runs["collapsed"] = (runs["pga_g"] >= 0.2 * off).astype(int)
        assert agreement.confirmed(scan, runs, 0.01) == verdict
    assert np.isnan(agreement.confirmed(None, runs, 0.01))
    assert np.isnan(agreement.confirmed(scan, pd.DataFrame(), 0.01))


def test_alternatives_are_odds_where_shares_change_slowly_and_a_shift_where_they_jump():
    slow = step(0.2).assign(collapsed=(np.arange(1400) % 2))
    p, more, less = agreement.alternatives(slow, [0.2], 0.01)[0]
    assert p == pytest.approx(0.5, abs=0.05)
    assert (more, less) == pytest.approx((shifted(p, ODDS), shifted(p, 1.0 / ODDS)))
    p, more, less = agreement.alternatives(step(0.2), [0.2 / 1.015], 0.01)[0]
    assert p < 0.05 < 0.95 < more
    assert less < p
