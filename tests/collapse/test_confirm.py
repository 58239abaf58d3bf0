"""How many runs confirm a scan: Wald's sequential test against exact binomials."""

import math

import numpy as np
import pandas as pd
import pytest
from rocking.collapse import probability

from yade_scripts.studies.confirm import ERROR, ODDS, Confirmation, posterior_share, shifted, turns

LEVELS = {0.2: 0.1, 0.25: 0.5, 0.3: 0.9}


def sequence(truth, rng, most=11):
    """Verdict and number of runs."""
    test = Confirmation(LEVELS)
    for level, _ in turns(LEVELS, most):
        test.add(level, rng.random() < truth[level])
        if test.verdict == 1:
            break
    return test.verdict, sum(test.fell.values()) + sum(test.stood.values())


def trials(odds, count=4000):
    truth = {level: shifted(p, odds) for level, p in LEVELS.items()}
    rng = np.random.default_rng(1)
    verdict, runs = zip(*(sequence(truth, rng) for _ in range(count)), strict=True)
    return np.array([math.nan if v is None else v for v in verdict]), np.array(runs)


def test_odds_shift_a_probability():
    assert shifted(0.5, 9.0) == pytest.approx(0.9)
    assert shifted(0.5, 1.0 / 9.0) == pytest.approx(0.1)
    assert shifted(shifted(0.3, 5.0), 0.2) == pytest.approx(0.3)


def test_every_level_gets_its_runs_the_middle_one_first():
    order = list(turns(LEVELS, 2))
    assert order[:4] == [(0.25, 0), (0.3, 0), (0.25, 1), (0.2, 0)]
    assert sorted(order) == [(level, number) for level in sorted(LEVELS) for number in range(2)]
    assert list(turns([0.4], 2)) == [(0.4, 0), (0.4, 1)]


def test_evidence_of_single_runs():
    """ln of the ratio of two binomial likelihoods: a fall where 0.5 and 0.9 were said."""
    test = Confirmation({0.25: 0.5})
    test.add(0.25, 1)
    assert test.evidence(9.0) == pytest.approx(math.log(0.5 / 0.9))
    test.add(0.25, 0)
    assert test.evidence(9.0) == pytest.approx(math.log(0.5 / 0.9) + math.log(0.5 / 0.1))
    assert test.evidence(1.0) == pytest.approx(0.0)


@pytest.mark.parametrize("odds", [ODDS, 1.0 / ODDS])
def test_a_shifted_scan_is_rarely_confirmed(odds):
    """Wald's bound: at most the stated error, whatever the number of runs."""
    verdict, _ = trials(odds)
    assert np.mean(verdict == 1) <= ERROR
    assert np.mean(verdict == 0) > 0.8


def test_a_true_scan_is_confirmed_by_a_third_of_the_runs():
    verdict, runs = trials(1.0)
    assert np.mean(verdict == 1) > 0.95
    assert np.mean(verdict == 0) <= 2.0 * ERROR  # two alternatives
    assert runs.mean() < 33 / 2.5


def test_the_table_of_collapse_says_whether_the_scan_is_confirmed():
    def table(fell):
        return pd.DataFrame(
            {
                "pga_g": list(LEVELS),
                "probability": list(LEVELS.values()),
                "realisations": 100,
                "probability_yade": np.array(fell) / 8.0,
                "realisations_yade": 8,
            }
        )

    assert probability.confirmed(table([1, 4, 7])) == 1.0
    assert probability.confirmed(table([7, 8, 8])) == 0.0
    assert np.isnan(probability.confirmed(table([1, 4, 7]).assign(probability=np.nan)))
    one = table([1, 4, 7]).assign(realisations_yade=[0, 2, 0], probability_yade=[0.0, 0.5, 0.0])
    assert np.isnan(probability.confirmed(one))
    assert posterior_share(0, 10) == pytest.approx(0.5 / 11)
