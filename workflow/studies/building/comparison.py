"""Building against equal chains: weighted mean errors (eq. 1, Table 2) and the choice of n."""

from dataclasses import dataclass

import numpy as np

import smdof

QUANTITIES = ("acceleration", "response_spectrum", "power_spectrum")
N_DOF = (1, 2, 3, 4, 5)
# Table 2 of the study, n = 1 … 5
PAPER_WME = {
    ("acceleration", "BUCAR0"): (0.344, 0.309, 0.305, 0.298, 0.292),
    ("acceleration", "RRS228"): (0.407, 0.343, 0.331, 0.326, 0.323),
    ("response_spectrum", "BUCAR0"): (0.140, 0.082, 0.063, 0.056, 0.062),
    ("response_spectrum", "RRS228"): (0.152, 0.093, 0.074, 0.066, 0.062),
    ("power_spectrum", "BUCAR0"): (0.273, 0.160, 0.133, 0.119, 0.129),
    ("power_spectrum", "RRS228"): (0.231, 0.141, 0.117, 0.108, 0.105),
}


@dataclass(frozen=True)
class TopMotion:
    """A top acceleration with its spectra: x and y of each of QUANTITIES."""

    curves: dict

    def wme(self, other):
        """Return {quantity: WME} of another motion, this one being the reference."""
        out = {}
        for quantity, (x, y) in self.curves.items():
            grid = smdof.common_grid(x, y, *other.curves[quantity])
            out[quantity] = smdof.weighted_mean_error(*grid)
        return out


def top_motion(time_s, acceleration_m_s2, longest_period_s, highest_hz):
    """Spectra of a uniformly sampled top acceleration on the ranges over which they are compared.

    Response spectra (5 % damping, pseudo-acceleration) go from 0.02 s to `longest_period_s`, power
    spectra (averaged density) from 0 to `highest_hz` or half the sampling frequency.
    """
    dt = (time_s[-1] - time_s[0]) / (len(time_s) - 1)
    periods = np.linspace(0.02, longest_period_s, 199)
    response = smdof.response_spectrum(acceleration_m_s2, dt, periods)
    power = smdof.power_spectrum(acceleration_m_s2, dt)
    low = power.frequency_hz <= highest_hz
    return TopMotion(
        {
            "acceleration": (np.asarray(time_s), np.asarray(acceleration_m_s2)),
            "response_spectrum": (periods, response.psa_m_s2),
            "power_spectrum": (power.frequency_hz[low], power.power_m2_s3[low]),
        }
    )


def chain_top(ground_m_s2, dt_s, n_dof, period_s, damping_ratio):
    """Return time and absolute top acceleration of an equal chain."""
    chain = smdof.shear_chain(n_dof, period_s)
    motion = smdof.floor_motions(ground_m_s2, dt_s, chain, damping_ratio)
    return motion.time_s, motion.floors_m_s2[-1]


def against_chains(history, record, period_s, settings):
    """Top motion of a building under a record, and of equal chains of its period with their errors.

    `history` is a CSV with time and top acceleration in its first and third column, `settings`
    section building. Chains are (TopMotion, errors by quantity) by N_DOF.
    """
    time_s, _, top_m_s2, *_ = np.loadtxt(history, delimiter=",", skiprows=1).T
    ranges = settings["wme_longest_period_s"], settings["wme_highest_frequency_hz"]
    reference, chains = top_motion(time_s, top_m_s2, *ranges), {}
    given = record.acceleration_m_s2, record.dt_s
    for n in N_DOF:
        chain_time_s, chain_m_s2 = chain_top(*given, n, period_s, settings["damping_ratio"])
        motion = top_motion(chain_time_s, chain_m_s2, *ranges)
        chains[n] = motion, reference.wme(motion)
    return reference, chains


def choose_n(rows, gain):
    """Return the smallest n for which no larger n lowers the mean WME by more than `gain`.

    Rows are (n_dof, wme); the mean is taken over records and quantities.
    """
    by_n: dict[int, list[float]] = {}
    for n, value in rows:
        by_n.setdefault(int(n), []).append(float(value))
    means = {n: sum(values) / len(values) for n, values in sorted(by_n.items())}
    for n, value in means.items():
        if value - min(v for m, v in means.items() if m >= n) <= gain:
            return n
    raise ValueError("no WME to choose n from")
