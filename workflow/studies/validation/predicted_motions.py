"""Motions of predicted tests: of a shake table, of a gable's foot and top, and stand-ins."""

import math
from pathlib import Path

import numpy as np
from rocking.configuration.config import ConfigError

from studies.validation.study import stand_in

SUITE = Path(__file__).resolve().parents[3] / "config" / "suites" / "recorded_suite.tsv"
SLOWEST_HZ = 0.25  # of motions that are shifted: slower ones would drift apart
PAUSE_S = 5.0  # before and behind a motion that is shifted, for what the shift spreads


def motion_file(path, heading=0):
    """Times and values of a file of two columns with a comma between, below lines of heading.

    ConfigError of one line that names the file, if it is no such table or its times do not grow.
    """
    with open(path, encoding="utf-8") as lines:
        try:
            time_s, values = np.loadtxt(lines, delimiter=",", skiprows=heading, unpack=True)
            good = time_s.size > 1 and bool(np.all(np.diff(time_s) > 0.0))
        except ValueError:
            good = False
    if not good or not np.all(np.isfinite(values)):
        above = f" below {heading} lines of heading" if heading else " and no heading"
        raise ConfigError(f"{path}: expected rows of a growing time [s],value with a comma{above}")
    return time_s, values


def velocity_file(path):
    """Times and accelerations of a file of time and velocity, two lines of heading before them."""
    time_s, velocity = motion_file(path, heading=2)
    return time_s - time_s[0], np.gradient(velocity - velocity[0], time_s)


def foot_and_top_files(row, folder):
    """Times and accelerations of a gable's foot and top in one run, from the files that it names.

    ConfigError of one line if no folder was named or the two do not have the same times.
    """
    if folder is None:
        raise ConfigError("--motions: expected the folder of the files that runs.csv names")
    foot, top = (Path(folder) / str(row[key]) for key in ("foot", "top"))
    (time_s, below), (other_s, above) = motion_file(foot), motion_file(top)
    if not np.array_equal(time_s, other_s):
        raise ConfigError(f"{top}: expected the times of {foot}")
    return time_s, below, above


def table_motion(specimen, row, folder):
    """Motion of a run: its file, its motion's strongest one scaled, or without a folder a stand-in.

    Times, acceleration [m/s²] and source: "file", "scaled" or the stand-in's name. None where the
    folder has neither.
    """
    about = specimen["motions"]
    strongest = about["strongest"][row["motion"]]
    for record, scale, source in (
        (row["record"], 1.0, "file"),
        (strongest, row["scale"], "scaled"),
    ):
        path = Path(folder or "") / about["files"].format(record=record)
        if folder and path.is_file():
            time_s, ground = velocity_file(path)
            return time_s, scale * ground, source
    if folder:
        return None
    name, peak_g = about["stand_in"][row["motion"]]
    return stand_in(name, str(SUITE), row["scale"] * peak_g)


def shifted(time_s, acceleration, amplification, phase_deg):
    """A motion with a pause on either side, and it amplified with all its phases shifted.

    Times, foot and top, without what is slower than SLOWEST_HZ, so that they do not drift apart.
    """
    step = time_s[1] - time_s[0]
    pause = np.zeros(round(PAUSE_S / step))
    whole = np.concatenate([pause, acceleration, pause])
    spectrum = np.fft.rfft(whole)
    slow = np.fft.rfftfreq(whole.size, step) < SLOWEST_HZ
    spectrum[slow] = 0.0
    turn = np.exp(-1j * math.radians(phase_deg))
    foot, top = (np.fft.irfft(s * spectrum, whole.size) for s in (1.0, amplification * turn))
    return step * np.arange(whole.size), foot, top
