"""What floors of a building do under their ground, and no other columns."""

import warnings

import numpy as np
from record_files.errors import RecordError
from record_files.record import check_plausible, integrate

GROUND = "ground"
VERTICAL = "vertical"
REFUSED_M, DOUBTED_M = 0.05, 0.005  # drift of a floor from the ground until the end
SLOW_HZ = (0.1, 0.5)  # where a building of some storeys moves as its ground does
LEAST_SHARE = 1e-2  # of the ground's displacement that lies there, for that to be judged
ENDS = 0.1  # share of a motion over which it is faded in and out there
LESS, FAR_LESS = 0.97, 0.8  # of the motion of the floor below
COARSE = 1000  # steps of print in a peak below which accelerations are coarse
NOT_THE_RECORD = 0.02  # difference of the ground from a record, of its peak
# A floor's energy for a mass of one, over its largest possible (`_taken`); between the two ends the
# order of the columns is not told. Of 220 regular chains under the shipped suite all lie above.
GIVEN, TAKEN = -0.01, 0.01
COARSE_STEP = (
    1.2  # change from sample to sample over size, of a harmonic with five samples a period
)


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
    doubts = [_out_of_order(path, ground, floors, step, record is not None)]
    doubts += [_drift(path, name, a - ground, step) for name, a in floors.items()]
    if record is None and floors:
        _refuse_other_order(path, ground, list(floors.values()), step)
    doubts += [_coarse(path, name, a) for name, a in values.items()]
    for line in filter(None, doubts[:]):
        warnings.warn(line, UserWarning, stacklevel=4)


def _refuse_other_ground(path, time_s, ground, record):
    off = 1.0
    for began in {0.0, float(time_s[0])}:  # times from the motion's first sample, or from a step
        recorded = np.interp(time_s - began, record.time_s, record.acceleration_m_s2, right=0.0)
        factor = float(np.dot(recorded, ground) / max(np.dot(recorded, recorded), 1e-300))
        if factor > 0.0:
            off = min(
                off, float(np.max(np.abs(ground - factor * recorded)) / np.max(np.abs(ground)))
            )
    if off > NOT_THE_RECORD:
        raise RecordError(
            f"{path}: its ground differs from record {record.name} by {100 * off:.0f} % of the "
            "peak; expected that record, scaled or not"
        )


def _slow_share(ground, floor, step):
    """Part of the ground's slow displacement that a floor has, 1 if absolute; None: too little.

    Least squares over frequencies of `SLOW_HZ`, where a building follows its ground, and one that
    yields by far more than half.
    """
    f = np.fft.rfftfreq(len(ground), step)
    slow = (f >= SLOW_HZ[0]) & (f <= SLOW_HZ[1])
    if np.count_nonzero(slow) < 2:
        return None
    count = max(1, int(ENDS * len(ground)))
    fade = np.minimum(1.0, (0.5 + np.arange(len(ground))) / count)
    fade = 0.5 - 0.5 * np.cos(np.pi * np.minimum(fade, fade[::-1]))
    g, apart = (
        np.fft.rfft(fade * (v - np.mean(v)))[1:] / f[1:]
        for v in (integrate(a, step)[0] for a in (ground, floor - ground))
    )
    g_slow = g[slow[1:]]
    power = float(np.sum(np.abs(g_slow) ** 2))
    if not power > LEAST_SHARE * float(np.sum(np.abs(g) ** 2)):
        return None
    return 1.0 + float(np.real(np.sum(apart[slow[1:]] * np.conj(g_slow)))) / power


def _out_of_order(path, ground, floors, step, told):
    """Doubt about floors that move less than the one below them, refused where all do.

    Where one moves far less and nobody has told what the ground is, the record is asked for.

    Their motion is relative to the ground, above frequencies at which an offset counts. Each storey
    adds to it in the first mode, and did in 165 chains of one to six unequal storeys, elastic and
    yielding: by 1 % at least.
    """
    if len(floors) < 2:
        return ""
    f = np.fft.rfftfreq(len(ground), step)[1:]
    size = []
    for a in floors.values():
        spectrum = np.fft.rfft(a - ground)[1:] / (2 * np.pi * f) ** 2
        spectrum[f < SLOW_HZ[0]] = 0.0
        size.append(float(np.sqrt(2.0 * np.sum(np.abs(spectrum) ** 2))) / len(ground))
    shown = ", ".join(f"{1e3 * rms_m:.3g}" for rms_m in size)
    said = f"{path}: floors move {shown} mm (r.m.s.) relative to the ground from floor1 up"
    ratios = [high / low if low else 1.0 for low, high in zip(size, size[1:], strict=False)]
    if all(ratio < 1.0 for ratio in ratios):
        raise RecordError(f"{said}; expected more from floor to floor: are they from the top down?")
    said += ": are they in order, the ground and the lowest floor first?"
    if min(ratios) < FAR_LESS and not told:
        raise RecordError(f"{said} If so, state record, the motion that the building was given")
    return said if min(ratios) < LESS else ""


def _refuse_other_order(path, ground, floors, step):
    """Refuse columns of which the ground's is not the first; ask for the record where that is open.

    What stands on the ground takes energy from it, whether it stays elastic or yields. From rest,
    and in the ground's frame, floors of masses m_j have taken Σ m_j E_j ≥ 0 with
    E = -∫ a_g v dt, v the velocity relative to the ground. With the roof for the ground the next
    floor has −E = ∫ a v dt = k s²/(2 m) + c/m ∫ v² dt ≥ 0, s the drift of the last storey: the
    roof's mass is moved by that storey alone. So both are below 0 in columns from the roof down.
    """
    parts = [_taken(ground, a - ground, step) for a in floors]
    energy, bound = (sum(column) for column in zip(*parts, strict=True))
    if not bound > 0.0:
        return
    shares = parts[0][0] / parts[0][1] if parts[0][1] else 0.0, energy / bound
    rough = max(map(_roughness, (a - ground for a in floors)))
    if rough < COARSE_STEP and min(shares) > TAKEN:
        return
    if rough < COARSE_STEP and max(shares) < GIVEN:
        raise RecordError(
            f"{path}: floors give energy to their ground ({shares[0]:.2f} of what floor1 could "
            f"take, {shares[1]:.2f} of all floors), and a building takes it: are the columns from "
            "the roof down?"
        )
    raise RecordError(
        f"{path}: these samples do not tell whether column {GROUND} is the ground (energy taken: "
        f"{shares[0]:.3f} of what floor1 could, {shares[1]:.3f} of all floors): state record, the "
        "motion that the building was given"
    )


def _taken(ground, apart, step):
    """Energy that a mass of one takes, −∫ a_g v dt, and the most at these sizes of both [m²/s²]."""
    v = integrate(apart, step)[0]
    v = v - np.mean(v)  # of floors that are cut out of a longer motion
    size = np.sqrt(np.sum(ground**2) * np.sum(v**2))
    return -step * float(np.sum(ground * v)), step * float(size)


def _roughness(apart):
    """Change from sample to sample over size: 2 sin(π step/period) of a harmonic."""
    size = float(np.sum(apart**2))
    return float(np.sqrt(np.sum(np.diff(apart) ** 2) / size)) if size else 0.0


def _drift(path, name, apart, step):
    """Doubt about a floor that drifts from the ground, refused where it drifts far."""
    path_m, quarter = integrate(apart, step)[1], max(1, len(apart) // 4)
    later = float(np.mean(path_m[-quarter:]) - np.mean(path_m[-2 * quarter : -quarter]))
    # as far as an offset takes it until the end; a storey that yields leaves a drift that stays
    drift_m = min(abs(float(path_m[-1])), 8.0 / 3.0 * abs(later))
    if drift_m <= DOUBTED_M:
        return ""
    mean = float(np.mean(apart))
    said = (
        f"{path}: column {name} drifts {drift_m:.2g} m from the ground until the end (mean of the "
        f"difference {mean:.2g} m/s²), and a wall with it: take the mean off, or print "
        "more digits or shorter steps"
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
