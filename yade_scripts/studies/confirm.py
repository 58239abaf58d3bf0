"""When YADE has confirmed the collapse probabilities of a dense scan: a sequential test.

Wald's sequential probability ratio test (Wald, Sequential tests of statistical hypotheses, 1945)
asks after every run whether the next one is still needed. The scan says that at an amplitude a
share p of the realisations falls. Two others are held against it, in which the façade falls more
often or less often at every amplitude, by the factor `odds` on p/(1 − p): with odds of nine they
say 0.9 or 0.1 where the scan says 0.5. The scan is confirmed once the runs are 1/`error` times as
likely by the scan as by either; then one of the two is taken for the scan in at most the share
`error` of curves. It is refuted once they are so much likelier by one of the others.
"""

import math
from collections import Counter

ODDS = 9.0
ERROR = 0.1


def shifted(probability, odds):
    """Probability whose p/(1 − p) is `odds` times as large."""
    return odds * probability / (1.0 - probability + odds * probability)


class Confirmation:
    """The test of one curve, run after run.

    Parameters
    ----------
    probability : dict of float to float
        Of the scan, by PGA: above 0 and below 1.
    odds, error : float
    """

    def __init__(self, probability, odds=ODDS, error=ERROR):
        """Nothing was run."""
        self.probability, self.bound = dict(probability), -math.log(error)
        self.others = (odds, 1.0 / odds)
        self.fell: Counter[float] = Counter()
        self.stood: Counter[float] = Counter()

    def add(self, pga_g, collapsed):
        """Count one run that did not fail."""
        (self.fell if collapsed else self.stood)[pga_g] += 1

    def evidence(self, odds):
        """Logarithm of how much likelier the runs are by the scan than by the other of `odds`."""
        total = 0.0
        for pga_g, p in self.probability.items():
            other = shifted(p, odds)
            total += self.fell[pga_g] * math.log(p / other)
            total += self.stood[pga_g] * math.log((1.0 - p) / (1.0 - other))
        return total

    @property
    def verdict(self):
        """1: confirmed, 0: refuted, None: open."""
        evidence = [self.evidence(odds) for odds in self.others]
        if min(evidence) >= self.bound:
            return 1
        return 0 if min(evidence) <= -self.bound else None


def turns(levels, count):
    """Order of `count` runs at every level: the middle one before each other, the highest first.

    A run where the scan says one half tells most, and one at the highest level is over soonest.

    Parameters
    ----------
    levels : sequence of float
    count : int

    Yields
    ------
    level, number : float, int
        The number counts from 0 at every level.
    """
    levels = sorted(levels)
    middle = levels[len(levels) // 2]
    others = [level for level in reversed(levels) if level != middle]
    cycle = [level for other in others for level in (middle, other)] or [middle]
    done = dict.fromkeys(levels, 0)
    while any(number < count for number in done.values()):
        for level in cycle:
            if done[level] < count:
                yield level, done[level]
                done[level] += 1


def posterior_share(collapsed, realisations):
    """Share of a binomial sample, kept off 0 and 1: Jeffreys' (k + ½)/(n + 1)."""
    return (collapsed + 0.5) / (realisations + 1.0)
