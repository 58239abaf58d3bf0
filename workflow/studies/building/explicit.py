"""Explicit runs of a building in YADE compared with its modes."""

import numpy as np

import smdof
from studies.building.history import LOADS, modal_history

AFTER_S = 0.3  # by then a push is over, and short modes have died down
LOUD = 0.05  # of the largest displacement: what still tells a period
BENDING = 0.6  # of the first period: a longer one belongs to a twin of the first mode
FIRST_COLUMN = {"acceleration": 1, "displacement": 3}  # of all points, in an explicit history


def ringing_period(time_s, value):
    """Mean period of a free vibration [s], between its zero crossings, each linear in time.

    What comes before AFTER_S, and after the last loud half cycle, does not count.
    """
    kept = time_s >= AFTER_S
    t, v = time_s[kept], value[kept]
    i = np.flatnonzero(v[:-1] * v[1:] < 0.0)
    crossings = t[i] - v[i] * (t[i + 1] - t[i]) / (v[i + 1] - v[i])
    peaks = np.abs(np.interp(crossings + 0.25 * np.diff(crossings).mean(), t, v))
    loud = peaks > LOUD * np.abs(v).max()
    crossings = crossings[: int(np.argmin(loud)) or None] if not loud.all() else crossings
    return 2.0 * float(np.diff(crossings).mean())


def second_along_y(modes):
    """Index of the second mode along y: a bending mode, not a twin of the first."""
    first = modes.largest("y")
    second = first + 1 + int(modes.effective_ratio[first + 1 :, 1].argmax())
    if modes.period_s[second] > BENDING * modes.period_s[first]:
        second += 1 + int(modes.effective_ratio[second + 1 :, 1].argmax())
    return second


def differences(explicit, modal, points):
    """Weighted mean error of every explicit run by every modal one.

    Explicit runs have time, then accelerations and displacements of the points, as
    `commands.explicit_building` writes them; modal ones are `history.PointHistory`. Rows are
    explicit, modal, point, quantity, wme.
    """
    rows = []
    for name, run in explicit.items():
        for other, answer in modal.items():
            for i, point in enumerate(points):
                values = answer.acceleration_m_s2[i], answer.displacement_m[i]
                for (quantity, first), value in zip(FIRST_COLUMN.items(), values, strict=True):
                    grid = smdof.common_grid(answer.time_s, value, run[:, 0], run[:, first + i])
                    rows.append((name, other, point, quantity, smdof.weighted_mean_error(*grid)))
    return rows


def read_histories(plain, loaded):
    """Explicit histories of files, without dead load and with sudden gravity, by what acts."""
    files = {"without dead load": plain, "sudden gravity": loaded}
    return {name: np.loadtxt(path, delimiter=",", skiprows=1) for name, path in files.items()}


def modal_histories(modes, points, record, rate_1_s, until_s):
    """Modal superposition of the same motion up to a time, by what acts besides (`LOADS`).

    Histories (`history.PointHistory`) are of the points, blocks of the scene.
    """
    ground = record.acceleration_m_s2[record.time_s <= until_s + record.dt_s]
    given = modes, points, ground, record.dt_s, rate_1_s
    return {name: modal_history(*given, gravity_m_s2=g) for name, g in LOADS.items()}
