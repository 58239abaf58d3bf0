"""How many runs confirm a scan: Wald's sequential test against exact binomials."""

import math

import numpy as np
import pandas as pd
import pytest
from rocking.collapse import agreement
from rocking.collapse.agreement import ODDS

from yade_scripts.commands import ensemble
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
        assert agreement.confirmed(scan, pd.DataFrame(), runs, 0.01) == verdict
    assert np.isnan(agreement.confirmed(None, runs, runs, 0.01))
    assert np.isnan(agreement.confirmed(scan, runs, pd.DataFrame(), 0.01))


def falls_twice():
    """Falls from 0.2 to 0.25 g and from 0.3 g on."""
    scan = step(0.2)
    stands = scan["pga_g"].between(0.25, 0.3)
    scan.loc[stands, ["status", "collapsed"]] = "ok", 0
    return scan


def test_single_runs_tell_between_the_lowest_collapse_and_the_highest_that_stood():
    """Below, above and at the lowest collapse every rival says the same, or it was chosen."""
    scan = falls_twice()
    lowest = scan.loc[scan["collapsed"] == 1, "pga_g"].min()
    found = agreement.told(scan, [0.15, lowest, 0.225, 0.275, 0.35], 0.01)
    assert [row is None for row in found] == [True, True, False, False, True]
    (fell, _, less), (stood, more, _) = found[2:4]
    assert stood < 0.1 < 0.9 < fell
    assert less < fell
    assert more > stood


def test_single_runs_count_beside_realisations():
    """One realisation that leaves a scan open, and single runs that confirm or refute it."""
    scan = falls_twice()
    runs = pd.DataFrame({"pga_g": [0.225], "status": "overturned", "collapsed": 1})
    assert np.isnan(agreement.confirmed(scan, pd.DataFrame(), runs, 0.01))
    at = pd.DataFrame({"pga_g": [0.225, 0.275] * 16})
    right = at.assign(status="ok", collapsed=[1, 0] * 16)
    wrong = at.assign(status="ok", collapsed=[0, 1] * 16)
    assert agreement.confirmed(scan, right, runs, 0.01) == 1.0
    assert agreement.confirmed(scan, wrong, runs, 0.01) == 0.0


class Planned:
    """A runner whose realisations all fall."""

    def __init__(self):
        self.at = []

    def run(self, pga_g, realisation):
        self.at.append(pga_g)
        return {"status": "overturned", "collapsed": 1, "realisation": realisation.number}

    def say(self, text):
        self.said = text


@pytest.mark.parametrize(("single", "count"), [(6, 4), (0, 33)])
def test_every_level_gets_a_realisation_and_no_more_once_confirmed(single, count):
    """Six single runs as the scan says leave a round of `turns`; without them nothing tells."""
    told = [[0.5, 0.9, 0.1]] * single
    levels, runs = [0.1, 0.2, 0.3], [0.4 + 0.1 * k for k in range(single)]
    plan = {
        "runs": runs,
        "told": told,
        "levels": levels,
        "probability": [[[0.5, 0.5, 0.5]] * 11] * 3,
    }
    curve = [{"pga_g": g, "status": "ok", "collapsed": k % 2} for k, g in enumerate(runs)]
    settings = {
        "realisations": 11,
        "amplitude_spread": 0.01,
        "seed": 1,
        "perturb": [],
        "stop": "confirmed",
    }
    runner = Planned()
    ensemble.confirm(runner, curve, plan, settings)
    assert set(runner.at) == set(levels)
    assert len(runner.at) == count
    assert runner.said.endswith("realisations confirm the dense scan") == bool(single)


def test_alternatives_are_odds_where_shares_change_slowly_and_a_shift_where_they_jump():
    slow = step(0.2).assign(collapsed=(np.arange(1400) % 2))
    p, more, less = agreement.alternatives(slow, [0.2], 0.01)[0]
    assert p == pytest.approx(0.5, abs=0.05)
    assert (more, less) == pytest.approx((shifted(p, ODDS), shifted(p, 1.0 / ODDS)))
    p, more, less = agreement.alternatives(step(0.2), [0.2 / 1.015], 0.01)[0]
    assert p < 0.05 < 0.95 < more
    assert less < p


def test_a_single_run_that_surprises_speaks_against_the_scan_alone():
    """It counts by the rival that foresaw it; one as the scan said counts as a realisation does."""
    one, other = Confirmation(), Confirmation()
    one.add((0.9, 0.99, 0.5), False, alone=True)
    assert one.evidence == pytest.approx([math.log(0.1 / 0.5)] * 2)
    other.add((0.9, 0.99, 0.5), True, alone=True)
    assert other.evidence == pytest.approx([math.log(0.9 / 0.99), math.log(0.9 / 0.5)])


def test_single_runs_that_contradict_the_scan_by_turns_confirm_none():
    """It says 0.976 and 0.024, and they stand and fall: counted as realisations they confirm it."""
    said = ((0.976, 0.997, 0.82), False), ((0.024, 0.18, 0.003), True)
    as_realisations, alone = Confirmation(), Confirmation()
    for probabilities, collapsed in said * 40:
        as_realisations.add(probabilities, collapsed)
        alone.add(probabilities, collapsed, alone=True)
    assert as_realisations.verdict == 1
    assert alone.verdict == 0
