"""Table 2 of the study under every reading its text allows, one departure at a time.

"The weighted mean error … was obtained from the time-history responses and the acceleration
and power spectra … where x was time, period or frequency, Y was acceleration, spectral
acceleration or power amplitude … and X was the total range of x considered": the text names
neither the point that is the top, nor the ranges X, nor the kind of spectra, nor the chain's
damping model.
"""

from dataclasses import dataclass, replace

import numpy as np

import smdof
from studies.building.case import translation_mode

from .comparison import N_DOF, top_motion

ARIAS = (0.05, 0.95)
STUDY_PERIOD_S = 0.27
SIGNIFICANT = 0.05  # share of the mass along y from which a mode counts: EN 1998-1, 4.3.3.3.1


def first_mode(modes, reading):
    """Index of the mode that the study calls the first along y.

    Parameters
    ----------
    modes : Modes
    reading : {"mass", "order"}
        The mode with the largest effective mass along y; or, by the study's own words ("only the
        modes of vibration with significant effective modal mass in the Y axis were considered"),
        the longest with at least SIGNIFICANT of it.
    """
    if reading == "mass":
        return translation_mode(modes)
    return int(np.argmax(modes.effective_ratio[:, 1] >= SIGNIFICANT))


@dataclass(frozen=True)
class Reading:
    """One way to read Table 2; the defaults are those of `tables/wme.csv`.

    Attributes
    ----------
    point : {"roof", "left", "right"}
        The roof's panel, or the highest brick half-way along a wall that carries it.
    relative : bool
        Accelerations relative to the ground.
    strong : bool
        Only between 5 and 95 % of the reference's integral of a².
    longest_period_s : float
    absolute_spectrum, power
        See `comparison.top_motion`.
    highest_hz : float
    study_period : bool
        Chains tuned to the study's 0.27 s, not to SBDEM's own period.
    period_of : {"mass", "order"}
        SBDEM's own period, see `first_mode`.
    period_factor : float
        Of the chains' period: what the rounding of 0.27 s to two digits hides is 2 %.
    rayleigh : bool
        Chains with Rayleigh damping, 5 % in their first two modes.
    """

    point: str = "roof"
    relative: bool = False
    strong: bool = False
    longest_period_s: float = 2.0
    absolute_spectrum: bool = False
    power: str = "welch"
    highest_hz: float = 25.0
    study_period: bool = False
    period_of: str = "mass"
    period_factor: float = 1.0
    rayleigh: bool = False


def readings(longest_period_s=2.0, highest_hz=25.0):
    """Return {name: Reading}, the one of `tables/wme.csv` first."""
    own = Reading(longest_period_s=longest_period_s, highest_hz=highest_hz)
    return {
        "as tabled": own,
        "top of the left wall": replace(own, point="left"),
        "top of the right wall": replace(own, point="right"),
        "relative to the ground": replace(own, relative=True),
        "strong motion only": replace(own, strong=True),
        "periods to 1 s": replace(own, longest_period_s=1.0),
        "periods to 4 s": replace(own, longest_period_s=4.0),
        "absolute spectral acceleration": replace(own, absolute_spectrum=True),
        "periodogram": replace(own, power="periodogram"),
        "amplitude spectrum": replace(own, power="amplitude"),
        "frequencies to 10 Hz": replace(own, highest_hz=10.0),
        "chains of 0.27 s": replace(own, study_period=True),
        "chains of the first mode": replace(own, period_of="order"),
        "chains 2 % slower": replace(own, period_factor=1.02),
        "chains 2 % faster": replace(own, period_factor=0.98),
        "chains with Rayleigh damping": replace(own, rayleigh=True),
    }


def highest_brick(building, name):
    """Return the highest brick of a wall, of those the one nearest its middle."""
    wall = building.plan.wall(name)
    middle = wall.origin_m + wall.length_m / 2.0
    number = building.bricks.wall_names.index(name)
    own = np.flatnonzero(building.bricks.wall == number)
    blocks = building.scene.blocks

    def height_then_middle(i):
        centre = blocks[i].centre_m
        return round(centre[2], 6), -round(abs(centre[wall.axis] - middle), 6)

    return int(max(own, key=height_then_middle))


def strong_part(time_s, acceleration_m_s2):
    """Return start and end of the time between 5 and 95 % of ∫a²dt (Trifunac and Brady, 1975)."""
    share = np.cumsum(np.square(acceleration_m_s2))
    low, high = np.searchsorted(share / share[-1], ARIAS)
    return float(time_s[low]), float(time_s[high])


def errors(history, point, record, own_period_s, damping_ratio, reading):
    """Return {n: {quantity: WME}} of equal chains against a building's top.

    `point` is the row of the history that is the top, `own_period_s` SBDEM's first under the
    reading.
    """

    def cut(time, motion, ground, window):
        motion = motion - ground if reading.relative else motion
        inside = (time >= window[0] - 1e-9) & (time <= window[1] + 1e-9)
        return top_motion(
            time[inside],
            motion[inside],
            reading.longest_period_s,
            reading.highest_hz,
            absolute_spectrum=reading.absolute_spectrum,
            power=reading.power,
        )

    time, top = history.time_s, history.acceleration_m_s2[point]
    window = strong_part(time, top) if reading.strong else (time[0], time[-1])
    reference = cut(time, top, history.ground_m_s2, window)
    period = reading.period_factor * (STUDY_PERIOD_S if reading.study_period else own_period_s)
    model = "rayleigh" if reading.rayleigh else "modal"
    out = {}
    for n in N_DOF:
        equal = smdof.shear_chain(n, period)
        chain = smdof.floor_motions(
            record.acceleration_m_s2, record.dt_s, equal, damping_ratio, model
        )
        motion = cut(chain.time_s, chain.floors_m_s2[-1], chain.ground_m_s2, window)
        out[n] = reference.wme(motion)
    return out
