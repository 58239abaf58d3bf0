"""The tests: table motions and outcomes, in files that may not be passed on."""

from pathlib import Path

import numpy as np
from rocking.configuration.config import ConfigError
from rocking.solver import Motions
from rocking.tables import read_frame

from yade_scripts.lists import listed
from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2

TESTS, MOTIONS, SPECIMENS = "tests.csv", "table_motions.npz", "specimens.npz"
UNIT_M_S2 = 1e-4 * STANDARD_GRAVITY_M_S2
STEP_S = 0.005
STILL_M_S2 = 0.03 * STANDARD_GRAVITY_M_S2  # of a table: no block lifts under it
BEFORE_S, BEHIND_S = 0.2, 1.0


def archive(folder, name):
    """Arrays of a file of the tests; ConfigError of one line if there is none."""
    path = Path(folder) / name
    if not path.is_file():
        raise ConfigError(f"{path}: expected this file of the tests")
    return np.load(path)


def tests(folder):
    """Table of the tests, a row each, indexed by number.

    Columns motion, type, pga_g, pgv_over_pga_s and overturned_specimen1, …2: 1 fell, 0 stood, NaN
    where the outcome is not known.
    """
    path = Path(folder)
    path = path / TESTS if path.is_dir() else path
    if not path.is_file():
        raise ConfigError(f"{path}: expected this file of the tests")
    table = read_frame(path)
    absent = [name for name in ("test", "motion", "pga_g") if name not in table]
    if absent:
        raise ConfigError(f"{path}: expected columns {listed(absent)}")
    table["motion"] = table["motion"].str.strip()
    if table["test"].duplicated().any():
        number = table.loc[table["test"].duplicated(), "test"].iloc[0]
        raise ConfigError(f"{path}: test = {number}: expected each test once")
    return table.set_index("test")


def acceleration(samples):
    """Acceleration of the table [m/s²] from its samples, without what the sensor is off by.

    The table stands still at either end, so that the mean of what it did is nothing; in the files
    it is 0.009 to 0.021 g, as much before a test as behind it.
    """
    values = np.asarray(samples, float) * UNIT_M_S2
    return values - values.mean()


def motion(samples):
    """`Motions` of a test from when the table begins to move until it has stopped."""
    values = acceleration(samples)
    moving = np.flatnonzero(np.abs(values) > STILL_M_S2)
    if moving.size:
        first = max(moving[0] - round(BEFORE_S / STEP_S), 0)
        values = values[first : moving[-1] + 1 + round(BEHIND_S / STEP_S)]
    else:
        values = values[: round(1.0 / STEP_S)]
    return Motions(STEP_S * np.arange(values.size), values)


def motions(folder, numbers):
    """`Motions` of some tests by their number."""
    with archive(folder, MOTIONS) as stored:
        names = {number: f"t{int(number):03d}" for number in numbers}
        for number, name in names.items():
            if name not in stored:
                raise ConfigError(f"{folder}/{MOTIONS}: no {name}: expected one of test {number}")
        return {number: motion(stored[name]) for number, name in names.items()}
