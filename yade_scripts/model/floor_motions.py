"""Floor motions: their file, and what is done with their columns before they shake a scene.

The file has time_s, ground_m_s2, floor1_m_s2 … of absolute accelerations. A last column
vertical_m_s2, where there is one, is the vertical acceleration of ground and walls alike, positive
upward: the building is taken as rigid along its height.

Floors that another program computed at several intensities (`yielding.TabulatedFloors`) have more
columns, floor1@1.25_m_s2 … of the ground 1.25 times as strong; the ground itself is that of the
lowest intensity.

Written by the workflow, read by it and inside YADE: `smdof/{record}_{n}dof.csv`, and with the
ground alone the motions of a shake table.
"""

import math
import warnings
from dataclasses import replace

import numpy as np

from yade_scripts.lists import listed
from yade_scripts.model.motion import GROUND, VERTICAL, along
from yade_scripts.model.yielding import ByAmplitude, TabulatedFloors

UNIT, TIMES = "_m_s2", "@"


def read(path):
    """Read a floor-motion file: times, and accelerations [m/s²] by name, from the ground up.

    The names are "ground", "floor1", …, and last "vertical", if it is there. ValueError of one line
    that names the file if a column is missing, a value is not finite or time does not rise. Floors
    at several intensities are `yielding.TabulatedFloors`.
    """
    with open(path, encoding="utf-8", newline="") as handle:
        header = handle.readline().strip().split(",")
    if header[:2] != ["time_s", GROUND + UNIT]:
        raise ValueError(f"{path}: expected columns time_s, {GROUND}{UNIT}, …, got {header[:3]}")
    try:
        with warnings.catch_warnings(action="ignore", category=UserWarning):  # of no rows
            data = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    if len(data) < 2 or data.shape[1] != len(header) or not np.all(np.isfinite(data)):
        raise ValueError(f"{path}: expected at least two complete rows of finite numbers")
    if len(down := np.flatnonzero(np.diff(data[:, 0]) <= 0.0)):
        raise ValueError(f"{path}, row {down[0] + 2}: expected time_s to rise")
    columns = {name.replace(UNIT, ""): data[:, i] for i, name in enumerate(header) if i}
    if not any(TIMES in name for name in columns):
        return data[:, 0], columns
    try:
        return data[:, 0], _tabulated(columns)
    except (KeyError, ValueError) as error:
        raise ValueError(f"{path}: floors at several intensities: {error}") from None


def _tabulated(columns):
    """`TabulatedFloors` of the columns of a file."""
    lowest = {name: values for name, values in columns.items() if TIMES not in name}
    sizes = dict.fromkeys(name.partition(TIMES)[2] for name in columns if TIMES in name)
    levels = [lowest]
    for size in sizes:
        scaled = {name: float(size) * lowest[name] for name in (GROUND, VERTICAL) if name in lowest}
        floors = {name: columns[name + TIMES + size] for name in lowest if name not in scaled}
        levels.append({name: {**scaled, **floors}[name] for name in lowest})
    return TabulatedFloors(levels)


def write_tabulated(path, time_s, floors, *, digits=9):
    """Write a file of `yielding.TabulatedFloors`, which `read` gives back."""
    columns = dict(floors)
    for size, level in zip(floors.sizes[1:], floors.levels[1:], strict=True):
        of_floors = {name: level[name] for name in floors if name not in (GROUND, VERTICAL)}
        columns |= {f"{name}{TIMES}{size:.12g}": values for name, values in of_floors.items()}
    write_columns(path, time_s, columns, digits=digits)


def write_columns(path, time_s, columns, *, digits=9):
    """Write a floor-motion file from columns as `read` returns them, to so many digits."""
    header = ",".join(["time_s", *(name + UNIT for name in columns)])
    table, how = np.column_stack([time_s, *columns.values()]), f"%.{digits}g"
    np.savetxt(path, table, fmt=how, delimiter=",", header=header, comments="")


def write(path, time_s, ground_m_s2, floors_m_s2=(), vertical_m_s2=None):
    """Write a floor-motion file, floors from the lowest up, shape (n, nt)."""
    columns = {GROUND: ground_m_s2}
    columns |= {f"floor{j}": floor for j, floor in enumerate(floors_m_s2, 1)}
    if vertical_m_s2 is not None:
        columns[VERTICAL] = vertical_m_s2
    write_columns(path, time_s, columns)


def with_second(time_s, columns, second_time_s, second):
    """Floor motions of two components on one time axis: those along the façade as `along(name)`.

    Sampled as the first, to the end of the longer; linear between samples, zero after either's end.
    """
    step = time_s[1] - time_s[0]
    last = max(time_s[-1], second_time_s[-1])
    longer = time_s[0] + step * np.arange(math.ceil((last - time_s[0]) / step - 1e-6) + 1)

    def on(times, values):
        return np.interp(longer, times, values, right=0.0)

    return longer, {
        **{name: on(time_s, values) for name, values in columns.items()},
        **{along(name): on(second_time_s, values) for name, values in second.items()},
    }


def scaled(columns, factor):
    """Floor motions at a factor; its sign turns the horizontal ones, not the vertical one.

    Those that at every factor are others (`yielding.ByAmplitude`) are computed for it.
    """
    if isinstance(columns, ByAmplitude):
        return columns.at(factor)
    size = {VERTICAL: abs(factor)}
    return {name: size.get(name, factor) * values for name, values in columns.items()}


def shaking(scene, columns, factor):
    """Columns of a scene's motions at a factor, floors between two mixed; of `shaken`."""
    if isinstance(columns, ByAmplitude):
        columns, factor = motion_columns(scene, columns.at(factor)), 1.0
    return scaled({name: columns[name] for name in scene.motions}, factor)


def after(before, time_s, columns):
    """Floor motions of two shocks one after the other, on one time axis, both as they shake.

    `before` is (time_s, columns, pause_s), the pause from the first's last sample to the second's
    first. Times are the samples of both, and one where each rests, for motions are linear between
    samples; what one shock has not is zero there. ValueError if the pause is shorter than a step.
    """
    first_s, first, pause_s = before
    step, still = first_s[1] - first_s[0], time_s[1] - time_s[0]
    if not pause_s > step + still:
        raise ValueError(f"pause of {pause_s:g} s: expected more than {step + still:g} s")
    begin = first_s[-1] + pause_s
    times = np.concatenate((first_s, [first_s[-1] + step, begin - still], begin + time_s))
    names = dict.fromkeys((*first, *columns))
    none = [np.zeros(len(first_s)), np.zeros(len(time_s))]
    return times, {
        name: np.concatenate((first.get(name, none[0]), [0.0, 0.0], columns.get(name, none[1])))
        for name in names
    }


def shaken(scene, columns):
    """A scene, and the `motion_columns` it needs: shaken vertically too where the motions say how.

    ValueError if a motion is missing. Those that at every factor are others stay what they are:
    floors between two are mixed once they are `scaled`.
    """
    scene = replace(scene, vertical=VERTICAL if VERTICAL in columns else None)
    mixed = motion_columns(scene, columns)
    _refuse_missing(scene.motions, mixed)
    return scene, columns if isinstance(columns, ByAmplitude) else mixed


def motion_columns(scene, columns):
    """Add the motions between floors that a scene's note "motions" mixes, by name and weights.

    What is there already stays. ValueError if a floor is missing.
    """
    mixed = dict(columns)
    for name, weights in scene.notes.get("motions", {}).items():
        if name in columns:
            continue
        _refuse_missing(weights, columns)
        mixed[name] = sum(weight * columns[column] for column, weight in weights.items())
    return mixed


def _refuse_missing(names, columns):
    missing = [name for name in names if name not in columns]
    if missing:
        raise ValueError(f"the motion file has no column for {listed(missing)}")
