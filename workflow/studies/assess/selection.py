"""Natural motions whose mean spectrum fits a target between stated periods.

NTC 2018, 3.2.3.6: of recorded motions, selected and scaled, the mean of the 5 % spectra may lie no
more than 10 % below and 30 % above the target at any period of interest. Each motion has a factor
of its own, that of its mean logarithmic distance from the target, within bounds; a set is built by
taking the motion that helps most, then by exchanging single motions as long as the fit improves,
and last by one common factor. At most one horizontal component of a station is taken, so that no
earthquake counts twice.
"""

from dataclasses import dataclass

import numpy as np
from rocking.records import G_M_S2

from smdof.spectra import response_spectrum
from studies.assess.code_checks import code_checks, mechanism_of

BELOW, ABOVE = 0.10, 0.30  # of the target, by NTC 2018
POINTS = 40  # periods at which the fit is judged
ROUNDS = 50  # of exchanges
DAMPING_RATIO = 0.05  # of the spectra
SHORTEST_HIGH_S, LONGEST_HIGH_S = 2.0, 4.0  # of what stands for match_high_s


@dataclass(frozen=True)
class Selection:
    """A set of scaled motions, the factor on each one's acceleration, and how their mean fits."""

    names: list
    factors: np.ndarray
    period_s: np.ndarray
    target_g: np.ndarray
    mean_g: np.ndarray

    @property
    def fits(self):
        """Whether the code's bounds hold at every period."""
        return _deviations(self.mean_g, self.target_g, 1e-9)[2]


def _deviations(mean_g, target_g, rounding):
    """Least and largest of mean/target − 1, and whether both are within the code's bounds."""
    ratio = mean_g / target_g - 1.0
    low, high = float(ratio.min()), float(ratio.max())
    return low, high, low >= -BELOW - rounding and high <= ABOVE + rounding


def periods(low_s, high_s, points=POINTS):
    """Periods at which a fit is judged."""
    return np.geomspace(low_s, high_s, points)


def longest_period(settings, demand):
    """Period up to which the motions are to fit [s]: match_high_s, or T_SLC of the whole façade.

    T_SLC within bounds; `settings` are sections facade, return_wall, smdof, assessment.
    """
    assessment = settings["assessment"]
    if assessment["match_high_s"] is not None:
        return assessment["match_high_s"]
    by_check = code_checks(mechanism_of(settings), settings, demand)
    slc = next(v for s, _, v, _ in by_check["slc_height"].steps if s == "T_SLC")
    return float(np.clip(slc, SHORTEST_HIGH_S, LONGEST_HIGH_S))


def spectra_of(records, period_s):
    """5 % spectra of records as recorded [g], a row a record."""
    spectra = [
        response_spectrum(r.acceleration_m_s2, r.dt_s, period_s, DAMPING_RATIO).psa_m_s2
        for r in records
    ]
    return np.array(spectra) / G_M_S2


def for_demand(demand, stations, spectra_g, period_s, assessment):
    """`choose` for a demand, by section assessment (motions, motion_factors).

    `stations` has the station of every record by its name, in the order of `spectra_g`.
    """
    target_g = np.array([demand.acceleration(t) for t in period_s])
    names, places = list(stations), list(stations.values())
    count, bounds = assessment["motions"], assessment["motion_factors"]
    return choose(names, places, spectra_g, period_s, target_g, count, bounds)


def fit_of(spectra):
    """Least and largest deviation of the chosen mean from its target; whether both are in bounds.

    None without motions; beside it the periods between which they fit [s]. Spectra have period_s,
    mean_g, target_g.
    """
    if spectra.empty:
        return None, (0.0, 0.0)
    deviations = _deviations(spectra["mean_g"], spectra["target_g"], 1e-3)
    return deviations, (spectra["period_s"].min(), spectra["period_s"].max())


def _misfit(ratio):
    """Mean square of a set's logarithmic distance, what is out of bounds counted tenfold."""
    log = np.log(ratio)
    log = log - log.mean()  # the common factor is free
    out = np.maximum(log - np.log1p(ABOVE), 0.0) + np.maximum(np.log1p(-BELOW) - log, 0.0)
    return float(np.mean(log**2) + 10.0 * np.mean(out**2))


def choose(names, stations, spectra_g, period_s, target_g, count, bounds):
    """Choose `count` motions: a `Selection`; a ValueError where there are fewer stations than that.

    Spectra are those of 5 % of the motions as recorded, shape (candidates, periods); `bounds` are
    least and largest factor.
    """
    names, stations = list(names), np.asarray(stations)
    if len(set(stations)) < count:
        raise ValueError(
            f"{len(set(stations))} stations; expected at least as many as motions, {count}"
        )
    own_factors = np.exp(np.mean(np.log(target_g / spectra_g), axis=1)).clip(*bounds)
    scaled = own_factors[:, None] * spectra_g / target_g

    def value(chosen):
        return _misfit(np.mean(scaled[chosen], axis=0))

    chosen: list[int] = []
    while len(chosen) < count:
        free = [i for i in range(len(names)) if stations[i] not in set(stations[chosen])]
        chosen.append(min(free, key=lambda i: value([*chosen, i])))
    best = value(chosen)
    for _ in range(ROUNDS):
        trials = []
        for k in range(count):
            rest = chosen[:k] + chosen[k + 1 :]
            taken = set(stations[rest])
            trials += [
                (value([*rest, i]), [*rest, i])
                for i in range(len(names))
                if i not in chosen and stations[i] not in taken
            ]
        least, exchanged = min(trials, default=(best, chosen))
        if least >= best - 1e-12:
            break
        best, chosen = least, exchanged
    chosen = sorted(chosen)
    factors = _common(scaled[chosen], own_factors[chosen], bounds)
    mean = np.mean(factors[:, None] * spectra_g[chosen], axis=0)
    return Selection([names[i] for i in chosen], factors, period_s, np.asarray(target_g), mean)


def _common(ratios, factors, bounds):
    """Factors times a common one: the mean as near the target as the lower bound lets it be."""
    ratio = np.mean(ratios, axis=0)
    common = np.exp(-np.mean(np.log(ratio)))
    common = max(common, (1.0 - BELOW) / ratio.min())
    return (common * factors).clip(*bounds)
