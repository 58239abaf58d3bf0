"""When YADE has confirmed the collapse probabilities of a dense scan: a sequential test.

Wald's sequential probability ratio test (Wald, Sequential tests of statistical hypotheses, 1945)
asks after every run whether the next one is still needed. At the run's amplitude the scan says that
a share p of the realisations falls; two others are held against it, of a façade that falls more
often, or less often. The scan is confirmed once all outcomes are 1/ERROR times as likely by the
scan as by either: then one of the two is taken for the scan in at most the share ERROR of curves.
It is refuted once they are so much likelier by one of the others.
"""

import math

ERROR = 0.1


class Confirmation:
    """The test of one curve, run after run.

    Attributes
    ----------
    evidence : list of 2 floats
        Logarithm of how much likelier the outcomes are by the scan than by the façade that falls
        more often, and by the one that falls less often.
    """

    def __init__(self):
        """Nothing was run."""
        self.bound, self.evidence = -math.log(ERROR), [0.0, 0.0]

    def add(self, probabilities, collapsed, *, alone=False):
        """Count one run that did not fail.

        `probabilities` are those to fall at its amplitude: of the scan, of the façade that falls
        more often and of the one that falls less often; above 0 and below 1. Of a single run
        `alone`, far from the levels, where the scan says less than one half of what it did, it
        speaks for neither rival and against the scan: a façade that falls where it should stand,
        and stands where it should fall, would else take evidence from both.
        """
        said, *others = probabilities if collapsed else [1.0 - p for p in probabilities]
        told = [math.log(said / other) for other in others]
        if alone and said < 0.5:
            told = [min(told)] * len(told)
        self.evidence = [total + more for total, more in zip(self.evidence, told, strict=True)]

    @property
    def verdict(self):
        """1: confirmed, 0: refuted, None: open."""
        least = min(self.evidence)
        return 1 if least >= self.bound else 0 if least <= -self.bound else None


def turns(levels, count):
    """Yield level and number of `count` runs a level: the middle one before each other one.

    The others begin with the highest. A run where the scan says one half tells most, and one at the
    highest level is over soonest. Both count from 0.
    """
    middle = len(levels) // 2
    others = sorted((i for i in range(len(levels)) if i != middle), key=lambda i: -levels[i])
    cycle = [i for other in others for i in (middle, other)] or [middle]
    done = [0] * len(levels)
    while min(done) < count:
        for i in cycle:
            if done[i] < count:
                yield i, done[i]
                done[i] += 1
