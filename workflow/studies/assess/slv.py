"""PGA at which the non-linear SLV check of a mechanism fails: what mechanisms are ranked by.

Feet, hinges and corners are chosen by it, so thousands of mechanisms of one façade are asked for
it. A place's displacement spectrum and its largest values are therefore known once.

A tie or an anchor that gives way early may be left out of a mechanism (`readings`). C8.7.1.2.1.6
takes d_SLV as the least of 0.4 d0 and of the displacement at which a link's failure takes more than
half of the largest acceleration. So a façade with a brittle tie may fail at a lower PGA than the
same façade without it. But 0.4 d0 is asked of a curve "with those actions alone whose presence is
verified until collapse": a link that gives way before is not one. It only ever pulls back, so
the curve without it lies nowhere above the curve with it, and the check of that curve holds for the
façade with the link. Both numbers are told, and the larger counts.
"""

import math
from typing import NamedTuple

import numpy as np
from rocking.mechanics.mechanism import Mechanism

from studies.assess import checks
from studies.assess.catalogue import SAY
from studies.assess.demand import PERIOD_STEP, SHORTEST, FloorDemand, displacement, floor_demand

LOWEST, HIGHEST = -120, 60  # powers of PERIOD_STEP between which spectra are kept: 0.1 ms to 100 s


def damaged(sections):
    """Period factor and damping of the building at ultimate states, for `floor_demand`."""
    assessment, stated = sections["assessment"], sections["smdof"]["damping_ratio"]
    damping = assessment["building_damping"]
    return assessment["building_period_factor"], stated if damping is None else damping


def readings(mechanism):
    """A mechanism as it is, then without the links that give way, the earliest first.

    A link is left out where its end sets d_SLV (`Mechanism.limit`). The last one has none such.
    """
    mechanisms = [mechanism]
    while (early := mechanisms[-1].early(checks.LIMITS["SLV"][0])) is not None:
        mechanisms.append(mechanisms[-1].without(early))
    return mechanisms


class Counted(NamedTuple):
    """What counts of a mechanism: it, or it without links that give way early."""

    mechanism: Mechanism
    pga_g: float  # of the SLV check
    left_out: int  # links


class Slv:
    """The non-linear SLV check of mechanisms under one demand on the ground.

    Of sections smdof and assessment. Called with a `family.Candidate` it returns the PGA at which
    the check fails [g], of ground and floor the less, and of `readings` the largest; infinite where
    the multiplier never vanishes, 0 where it is not positive at rest.
    """

    def __init__(self, sections, demand):
        """Keep what every mechanism takes."""
        assessment, self.demand, self.chain = sections["assessment"], demand, sections["smdof"]
        self.factor = checks.confidence(
            assessment["confidence_factor"], assessment["hinge_inset_m"]
        )
        self.damaged = damaged(sections)
        self._floors: dict[float, FloorDemand] = {}
        self._spectra: dict[tuple, tuple] = {}

    def places(self, candidate):
        """Demands that a mechanism is held to, and where each is, by "ground" and "height"."""
        place = candidate.place
        if place not in self._floors:
            given = self.demand, place, self.chain
            floor = floor_demand(*given, damaged=self.damaged) if place > 0.0 else self.demand
            self._floors[place] = floor
        demands = {"height": (self._floors[place], SAY("step.where.floor", place=place))}
        if candidate.on_ground:
            demands = {"ground": (self.demand, SAY("step.where.ground")), **demands}
        return demands

    def __call__(self, candidate):
        """Return the PGA at which the check fails [g]."""
        return self.reading(candidate).pga_g

    def letter(self, candidate):
        """PGA at which the check fails with every link that the mechanism has [g]."""
        mechanism = candidate.letter or candidate.mechanism
        return self._pga_g(mechanism, candidate) if mechanism.falls() else math.inf

    def reading(self, candidate):
        """`Counted` of a candidate: that of the largest PGA, the fewest links left out."""
        if candidate.mechanism.multiplier() <= 0.0:
            return Counted(candidate.mechanism, 0.0, 0)
        if not candidate.mechanism.falls():
            return Counted(candidate.mechanism, math.inf, 0)
        every = readings(candidate.mechanism)
        pga_g = [self._pga_g(mechanism, candidate) for mechanism in every]
        best = int(np.argmax(pga_g))
        return Counted(every[best], float(pga_g[best]), best)

    def _pga_g(self, mechanism, candidate):
        """PGA at which the check of one reading fails [g]; as `checks.nonlinear` has it."""
        share, factor, damping = checks.LIMITS["SLV"]
        control = mechanism.limit(share)[0]
        d = control * mechanism.participation()[2]
        a = checks.capacity_at(mechanism, control, self.factor, candidate.t0_s)
        period = factor * math.pi * math.sqrt(d / a)
        failing_g = []
        for demand, _ in self.places(candidate).values():
            needed = self._largest(demand, candidate.t0_s, period, damping)
            onset = checks.onset(mechanism, demand, self.factor, candidate.t0_s)[1]
            failing_g.append(max(demand.pga_g * d / needed, onset))
        return min(failing_g)

    def _largest(self, demand, low_s, high_s, damping):
        """Largest spectral displacement between two periods [m], see `largest_displacement`."""
        key = id(demand), damping  # those of `places`, which are kept
        if key not in self._spectra:
            edges = getattr(demand, "ground", demand).edges_s
            periods = np.union1d(PERIOD_STEP ** np.arange(LOWEST, HIGHEST + 1.0), edges)
            values = [displacement(demand, float(t), damping) for t in periods]
            self._spectra[key] = periods, np.array(values)
        periods, values = self._spectra[key]
        low = max(low_s, high_s / SHORTEST)
        between = values[np.searchsorted(periods, low) : np.searchsorted(periods, high_s)]
        most = displacement(demand, high_s, damping)
        return max(most, float(between.max())) if between.size else most


def read_as(candidate, reading):
    """A candidate with the mechanism that counts; `letter` is with every link."""
    if not reading.left_out:
        return candidate
    return candidate._replace(mechanism=reading.mechanism, letter=candidate.mechanism)
