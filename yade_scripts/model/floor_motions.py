"""The floor-motion file: columns time_s, ground_m_s2, floor1_m_s2 … of absolute accelerations.

A last column vertical_m_s2, where there is one, is the vertical acceleration of ground and walls
alike, positive upward: the building is taken as rigid along its height.

Written by the workflow, read by it and inside YADE: `smdof/{record}_{n}dof.csv`, and with the
ground alone the motions of a shake table.
"""

import numpy as np

GROUND = "ground"
VERTICAL = "vertical"
UNIT = "_m_s2"


def read(path):
    """Read a floor-motion file.

    Returns
    -------
    time_s : ndarray, shape (nt,)
    accelerations : dict of str to ndarray
        "ground", "floor1", … [m/s²], from the ground up; "vertical" last, if it is there.

    Raises
    ------
    ValueError
        One line that names the file if a column is missing or a value is not finite.
    """
    with open(path, newline="") as handle:
        header = handle.readline().strip().split(",")
    if header[:2] != ["time_s", GROUND + UNIT]:
        raise ValueError(f"{path}: expected columns time_s, {GROUND}{UNIT}, …, got {header[:3]}")
    data = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    if len(data) < 2 or data.shape[1] != len(header) or not np.all(np.isfinite(data)):
        raise ValueError(f"{path}: expected at least two complete rows of finite numbers")
    columns = {name.replace(UNIT, ""): data[:, i] for i, name in enumerate(header) if i}
    return data[:, 0], columns


def write(path, time_s, ground_m_s2, floors_m_s2=(), vertical_m_s2=None):
    """Write a floor-motion file.

    Parameters
    ----------
    time_s, ground_m_s2 : ndarray, shape (nt,)
    floors_m_s2 : array_like, shape (n, nt)
        From the lowest floor up.
    vertical_m_s2 : ndarray, shape (nt,), or None
    """
    names = ["time_s", GROUND + UNIT, *(f"floor{j + 1}{UNIT}" for j in range(len(floors_m_s2)))]
    rows = [time_s, ground_m_s2, *floors_m_s2]
    if vertical_m_s2 is not None:
        names, rows = [*names, VERTICAL + UNIT], [*rows, vertical_m_s2]
    columns = np.column_stack(rows)
    np.savetxt(path, columns, fmt="%.9g", delimiter=",", header=",".join(names), comments="")
