"""Floor motions of another program: read, and checked against what floors of a building do.

The file has times and absolute accelerations of the ground and of every floor from the lowest up,
with captions (`time_s, ground_m_s2, floor1_m_s2, …`) or without. The walls behind a façade move as
the floors do, so what is wrong with a column moves a wall: accelerations that are relative to the
ground, another unit, floors from the top down, or a mean that the ground does not have.
"""

import re
import warnings

import numpy as np

from .errors import RecordError
from .formats.captions import TIME_UNITS
from .formats.columns import uniform_step
from .formats.header import heading_unit
from .formats.layout import layout
from .record import UNITS_M_S2, check_plausible, integrate, unit_name
from .text import read_text

GROUND = "ground"
VERTICAL = "vertical"
REFUSED_M, DOUBTED_M = 0.05, 0.005  # drift of a floor from the ground until the end
SLOW_HZ = (0.1, 1.0)  # where a building of some storeys moves as its ground does
LEAST_SHARE = 1e-4  # of the ground's velocity that lies there, for that to be judged
COARSE = 1000  # steps of print in a peak below which accelerations are coarse
NOT_THE_RECORD = 0.02  # difference of the ground from a record, of its peak
_FLOOR = re.compile(
    r"(?:floor|storey|story|level|piano|planta|etage|stock\w*|geschoss|f|l)[ _-]?(\d{1,2})", re.I
)
_GROUND = re.compile(r"(?:ground|base|soil|suolo|terreno|boden|floor[ _-]?0|level[ _-]?0)", re.I)


def read_floor_file(path, units=None, columns=None, record=None):
    """Read floor motions of another program.

    Parameters
    ----------
    path : path
        A table with times first.
    units : str, optional
        Of all accelerations, where the captions state none.
    columns : sequence of str, optional
        What the columns after the time are, "ground", "floor1", … and at most "vertical", of a file
        without captions.
    record : Record, optional
        The ground motion that the other program was given; its ground has to be that, scaled or
        not.

    Returns
    -------
    time_s : ndarray, shape (nt,)
    columns : dict of str to ndarray
        Absolute accelerations [m/s²]: "ground", "floor1", …, as `floor_motions.read` gives them.

    Raises
    ------
    RecordError
        In one line that names the file and the column.

    Warns
    -----
    UserWarning
        For floors that drift from the ground, or accelerations of few digits.
    """
    text = read_text(path)
    found = layout(text)
    if found is None or found.time_s is None:
        raise RecordError(f"{path}: expected a column of times, then ground, floor1, …")
    labels = [label for label, _, _ in found.channels]
    if columns is None and any(map(_name, labels)):
        columns = [_name(label) for label in labels]
    if columns is None:
        raise RecordError(
            f"{path}: no captions ground, floor1, …; state columns=['{GROUND}', 'floor1', …] for "
            f"its {len(labels)} columns after the time"
        )
    columns = [str(one) for one in columns]
    _check_names(path, columns, labels)
    factors = _factors(path, labels, columns, units)
    time_s = _times(text, found)
    values = {
        name: factor * np.array(channel[1])
        for name, channel, factor in zip(columns, found.channels, factors, strict=True)
    }
    values = {name: values[name] for name in sorted(values, key=_height)}
    check_floors(path, time_s, values, record)
    return time_s, values


def _name(label):
    """What a caption names, "ground", "floor2" or "vertical"; empty for anything else."""
    words = re.sub(r"[(\[].*|_(?:%?m?g|\w+_s2|gal)$", "", label.strip()).strip(" _")
    words = re.sub(r"^(?:acc\w*|a)[ _-]", "", words, flags=re.I)
    floor = _FLOOR.fullmatch(words)
    if floor and int(floor[1]):
        return f"floor{int(floor[1])}"
    if _GROUND.fullmatch(words):
        return GROUND
    return VERTICAL if re.fullmatch(r"vert\w*|up", words, re.I) else ""


def _height(name):
    floor = re.fullmatch(r"floor(\d+)", name)
    return {GROUND: 0, VERTICAL: 1000}.get(name, int(floor[1]) if floor else 999)


def _check_names(path, columns, labels):
    if len(columns) != len(labels):
        raise RecordError(
            f"{path}: {len(labels)} columns after the time, but {len(columns)} are named"
        )
    floors = sorted(_height(name) for name in columns if name.startswith("floor"))
    strange = [
        label or name
        for name, label in zip(columns, labels, strict=True)
        if name not in (GROUND, VERTICAL) and not re.fullmatch(r"floor[1-9]\d?", name)
    ]
    if strange:
        raise RecordError(
            f"{path}: column {strange[0][:40]!r}; expected ground, floor1, floor2, … or vertical"
        )
    if len(set(columns)) != len(columns):
        twice = next(name for name in columns if columns.count(name) > 1)
        raise RecordError(f"{path}: column {twice} appears twice")
    if GROUND not in columns:
        raise RecordError(f"{path}: no column of the ground's acceleration")
    if floors != list(range(1, len(floors) + 1)):
        raise RecordError(
            f"{path}: floors {', '.join(map(str, floors))}; expected 1 to {len(floors)}, the "
            "lowest first"
        )


def _factors(path, labels, columns, units):
    """Factor to m/s² of every column; all are in one unit."""
    stated = unit_name(units) if units else None
    if units and stated is None:
        raise RecordError(f"{path}: units {units!r}; expected one of {', '.join(UNITS_M_S2)}")
    found = []
    for label, name in zip(labels, columns, strict=True):
        said = heading_unit(label)
        if said.against:
            raise RecordError(f"{path}: column {name}: {said.against}; expected an acceleration")
        if said.unit and stated and said.unit != stated:
            raise RecordError(f"{path}: column {name} is in {said.unit}, but {units!r} is stated")
        found.append(said.unit or stated)
    if None in found:
        known = ", ".join(UNITS_M_S2)
        name = columns[found.index(None)]
        raise RecordError(f"{path}: column {name}: no units; state units, one of {known}")
    if len(set(found)) > 1:
        raise RecordError(
            f"{path}: columns in {' and '.join(map(str, dict.fromkeys(found)))}; expected one"
        )
    return [UNITS_M_S2[str(unit)] for unit in found]


def _times(text, found):
    label, cells = found.time
    bracketed = re.search(r"[(\[]([^()\[\]]+)[)\]]|_(m?s)$", label)
    word = next(filter(None, bracketed.groups())).strip().lower() if bracketed else "s"
    if word not in TIME_UNITS:
        raise RecordError(f"{text.path}: time is in {word[:20]!r}; expected seconds")
    factor = TIME_UNITS[word]
    lines = found.block.lines
    first = lines.index(found.channels[0][2])
    at = min(len(lines) - 1, first)
    uniform_step(text, found.time_s, cells, lambda i: lines[min(at + i, len(lines) - 1)])
    return factor * np.array(found.time_s)


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
