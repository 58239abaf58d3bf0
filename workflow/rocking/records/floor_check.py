"""What floors of a building do under their ground, and no other columns."""

import warnings

import numpy as np

from .errors import RecordError
from .record import check_plausible, integrate

GROUND = "ground"
VERTICAL = "vertical"
REFUSED_M, DOUBTED_M = 0.05, 0.005  # drift of a floor from the ground until the end
SLOW_HZ = (0.1, 1.0)  # where a building of some storeys moves as its ground does
LEAST_SHARE = 1e-4  # of the ground's velocity that lies there, for that to be judged
COARSE = 1000  # steps of print in a peak below which accelerations are coarse
NOT_THE_RECORD = 0.02  # difference of the ground from a record, of its peak


def check_floors(path, time_s, values, record=None):
    """Refuse floor motions that no building makes of its ground; see `read_floor_file`."""
    ground = values[GROUND]
    for name, a in values.items():
        if not np.any(a):
            raise RecordError(
                f"{path}: column {name} is zero throughout; expected absolute accelerations, of "
                "the ground too"
            )
        check_plausible(a, "m/s2", f"{path}: column {name}")
    floors = {name: a for name, a in values.items() if name.startswith("floor")}
    step = float(time_s[-1] - time_s[0]) / (len(time_s) - 1)
    if record is not None:
        _refuse_other_ground(path, time_s, ground, record)
    for name, a in floors.items():
        share = _slow_share(ground, a, step)
        if share is not None and share < 0.5:
            raise RecordError(
                f"{path}: column {name} has {share:.2f} of the ground's slow motion; expected "
                "absolute accelerations, these seem to be relative to the ground"
                if share > -0.5
                else f"{path}: column {name} moves against the ground; expected the same sign"
            )
        if share is not None and not share < 2.0:
            raise RecordError(
                f"{path}: column {name} has {share:.3g} times the ground's slow motion; expected "
                "the same: other units?"
            )
    _refuse_upside_down(path, ground, floors, step)
    doubts = [_drift(path, name, a - ground, step) for name, a in floors.items()]
    doubts += [_coarse(path, name, a) for name, a in values.items()]
    for line in filter(None, doubts[:]):
        warnings.warn(line, UserWarning, stacklevel=4)


def _refuse_other_ground(path, time_s, ground, record):
    off = 1.0
    for began in {0.0, float(time_s[0])}:  # times from the motion's first sample, or from a step
        own = np.interp(time_s - began, record.time_s, record.acceleration_m_s2, right=0.0)
        factor = float(np.dot(own, ground) / max(np.dot(own, own), 1e-300))
        if factor > 0.0:
            off = min(off, float(np.max(np.abs(ground - factor * own)) / np.max(np.abs(ground))))
    if off > NOT_THE_RECORD:
        raise RecordError(
            f"{path}: its ground differs from record {record.name} by {100 * off:.0f} % of the "
            "peak; expected that record, scaled or not"
        )


def _slow_share(ground, floor, step):
    """Part of the ground's slow velocity that a floor has, 1 if absolute; None: too little.

    Least squares over frequencies of `SLOW_HZ`, where a building follows its ground.
    """
    f = np.fft.rfftfreq(len(ground), step)
    slow = (f >= SLOW_HZ[0]) & (f <= SLOW_HZ[1])
    if np.count_nonzero(slow) < 2:
        return None
    g, a = (np.fft.rfft(x)[1:] / f[1:] for x in (ground, floor))
    g_slow, a_slow = g[slow[1:]], a[slow[1:]]
    power = float(np.sum(np.abs(g_slow) ** 2))
    if not power > LEAST_SHARE * float(np.sum(np.abs(g) ** 2)):
        return None
    return float(np.real(np.sum(a_slow * np.conj(g_slow)))) / power


def _refuse_upside_down(path, ground, floors, step):
    """Refuse floors whose motion relative to the ground shrinks all the way up."""
    if len(floors) < 2:
        return
    f = np.fft.rfftfreq(len(ground), step)[1:]
    peaks = []
    for a in floors.values():
        spectrum = np.fft.rfft(a - ground)[1:] / (2 * np.pi * f) ** 2
        spectrum[f < SLOW_HZ[0]] = 0.0
        peaks.append(np.max(np.abs(np.fft.irfft(np.insert(spectrum, 0, 0.0), len(ground)))))
    if all(high < low for low, high in zip(peaks, peaks[1:], strict=False)):
        shown = ", ".join(f"{1e3 * peak:.3g}" for peak in peaks)
        raise RecordError(
            f"{path}: floors move {shown} mm relative to the ground from floor1 up; expected more "
            "from floor to floor: are they from the top down?"
        )


def _drift(path, name, apart, step):
    """Doubt about a floor that drifts from the ground, refused where it drifts far."""
    drift_m = abs(float(integrate(apart, step)[1][-1]))
    if drift_m <= DOUBTED_M:
        return ""
    mean = float(np.mean(apart))
    said = (
        f"{path}: column {name} drifts {drift_m:.2g} m from the ground until the end (mean of the "
        f"difference {mean:.2g} m/s²), and a wall with it: take the mean off, or print more digits"
    )
    if drift_m > REFUSED_M:
        raise RecordError(said)
    return said


def _coarse(path, name, a):
    """Doubt about accelerations of few digits."""
    steps = np.diff(np.unique(np.round(a, 12)))
    print_m_s2 = float(np.min(steps[steps > 0.0], initial=np.inf))
    peak = float(np.max(np.abs(a)))
    if not np.isfinite(print_m_s2) or print_m_s2 * COARSE <= peak:
        return ""
    return (
        f"{path}: column {name} is in steps of {print_m_s2:.2g} m/s² at a peak of {peak:.2g} m/s²: "
        "print more digits"
    )
