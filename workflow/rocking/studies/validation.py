"""Experiments: walls that others tested, run by both solvers and set against what they measured.

An experiment is a folder of three files: `specimen.yaml` (the wall, and how its parameters follow
from it), `runs.csv` (what it went through, in order) and `measured.csv`; another model of the same
test states `like: folder` and what it changes. docs/validation.md says what stands in them.
"""

import copy
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import yaml

from rocking.configuration.config import ConfigError, resolve
from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2

SECTIONAL = {"sections", "facade", "numerics", "observed"}  # keys whose mappings are merged
SECTIONS = ("facade", "return_wall", "smdof", "numerics")
KINDS = ("shake_table", "free_rocking")
KEYS = ("title", "source", "kind", "model", "sections", "damping", "observed", "variants")
UNITS = {"m/s": None, "m/s2": 1.0, "g": STANDARD_GRAVITY_M_S2}  # of motions; m/s is differentiated
E_KEY = "facade.e_mpa"
FITTED = {E_KEY: (1.0, 1e7), "floors.stiffness_kn_m": (1.0, 1e9)}  # what a period may set, within
QUIET_S = 2.0  # between runs that follow each other on the same wall
NUDGE = 1e-4  # of amplitude: a peak that it moves by more than ten times as much does not repeat
STILL = 10.0 * NUDGE
ALONE, SEQUENCE = "alone", "in sequence"
PERCENTILES = (10, 50, 90)


@dataclass(frozen=True)
class Experiment:
    """What the three files say.

    Attributes
    ----------
    name : str
        Of the folder.
    specimen : dict
    runs, measured : DataFrame
        Both with a column `run`; `measured` has `measured_<unit>` and maybe `another_<unit>`.
    """

    name: str
    specimen: dict
    runs: pd.DataFrame
    measured: pd.DataFrame

    @property
    def unit(self):
        """Unit of what was measured, as in the columns' names."""
        return self.specimen["observed"]["unit"]


def files(folder, below=()):
    """Files of an experiment: its own, then those of the experiment that it is `like`.

    Raises
    ------
    ConfigError
        If it is like itself in the end; `below` holds those that are like it.
    """
    folder = Path(folder)
    path = folder / "specimen.yaml"
    if folder.name in below:
        raise ConfigError(f"{path}: like: expected another experiment, not {below[-1]} again")
    tables = [folder / name for name in ("runs.csv", "measured.csv")]
    found = [path, *(table for table in tables if table.is_file())]
    like = yaml.safe_load(path.read_text("utf-8")).get("like")
    return found + (files(folder.parent / like, (*below, folder.name)) if like else [])


def over(under, own):
    """Mappings, one over the other, section by section; but variants and damping as a whole."""
    both = {k: over(under[k], own[k]) for k in SECTIONAL & under.keys() & own.keys()}
    return {**under, **own, **both}


def read(folder):
    """Read an experiment.

    Raises
    ------
    ConfigError
        One line with the file, its key and what was expected.
    """
    folder = Path(folder)
    given = files(folder)
    path = folder / "specimen.yaml"
    specimen: dict[str, Any] = {}
    for file in reversed([file for file in given if file.name == path.name]):
        specimen = over(specimen, yaml.safe_load(file.read_text("utf-8")))
    missing = [key for key in KEYS if key not in specimen]
    if missing:
        raise ConfigError(f"{path}: expected {', '.join(missing)}")
    if specimen["kind"] not in KINDS:
        raise ConfigError(f"{path}: kind = {specimen['kind']}: expected {' or '.join(KINDS)}")
    tables = []
    own = {"shake_table": ("record", "pga_g"), "free_rocking": ("height_m",)}[specimen["kind"]]
    for name, columns in (
        ("runs", own),
        ("measured", (f"measured_{specimen['observed']['unit']}",)),
    ):
        file = next((file for file in given if file.stem == name), folder / f"{name}.csv")
        table = pd.read_csv(file, comment="#")
        absent = [column for column in ("run", *columns) if column not in table]
        if absent:
            raise ConfigError(f"{file}: expected columns {', '.join(absent)}")
        tables.append(table)
    strangers = sorted({*tables[1]["run"]} - {*tables[0]["run"]})
    if strangers:
        raise ConfigError(f"{folder}/measured.csv: run {strangers[0]}: expected one of runs.csv")
    return Experiment(folder.name, specimen, *tables)


def case(specimen, changes=(), height_m=None):
    """A variant of a specimen as a scene file, its parameters found.

    Parameters
    ----------
    specimen : dict
    changes : mapping
        By dotted key of a section ("facade.friction_deg"), of every floor ("floors.load_kn"), or
        "damping".
    height_m : float or None
        Of a block, where they differ from run to run.

    Returns
    -------
    dict
        Sections, model, beta_s and observed_m, see `models.build_scene`.
    """
    from rocking.assessment.code_checks import weakest_hinge

    given, changes = copy.deepcopy(specimen["sections"]), dict(changes)
    damping = changes.pop("damping", specimen["damping"])
    for path, value in changes.items():
        section, _, key = path.partition(".")
        rows = given["facade"]["floors"] if section == "floors" else [given.setdefault(section, {})]
        for row in rows:
            row[key] = value
    if height_m is not None:
        given["facade"]["height_m"] = height_m
    resolved = resolve({**given, "models": ["W1"]})
    found = {key: resolved[key] for key in SECTIONS}
    facade = found["facade"]
    if facade["hinges_m"] == "weakest":
        facade["hinges_m"] = [weakest_hinge(facade)]
    found |= {"model": specimen["model"], "beta_s": 0.0}
    found["observed_m"] = specimen["observed"].get("height_m")
    if period := specimen.get("first_period_s"):
        fit_period(found, period, specimen.get("fitted", E_KEY))
    found["beta_s"] = beta_for(found, damping)
    return found


def planar_step(planar, numerics):
    """Time step [s] that a specimen states, for the planar solver; None if it states none.

    A fraction is one of the largest step at which that solver is stable, as YADE's is of its own.
    """
    from rocking.solver import stable_step

    if numerics["step_s"] or not numerics["step_fraction"]:
        return numerics["step_s"]
    return numerics["step_fraction"] * stable_step(planar)


def first_frequency(job):
    """Lowest circular frequency of an assembled case, every joint closed [rad/s]."""
    from yade_scripts.model.models import build_scene
    from yade_scripts.model.stiffness import modes

    return float(modes(build_scene(job))[0][0])


def fit_period(job, period_s, path=E_KEY):
    """Set what one key says so that the assembled case has a first period.

    Parameters
    ----------
    job : dict
        Changed in place.
    period_s : float
    path : str
        A key of FITTED.

    Raises
    ------
    ConfigError
        If no value of it has that period, as where another part alone is too soft.
    """
    from scipy.optimize import brentq

    if path not in FITTED:
        raise ConfigError(f"fitted = {path}: expected {' or '.join(FITTED)}")
    rows = [job["facade"]] if path == E_KEY else [job["facade"]["floors"][0]]
    key = path.rpartition(".")[2]

    def excess(log_value):
        rows[0][key] = math.exp(log_value)
        return math.log(2.0 * math.pi / first_frequency(job) / period_s)

    low, high = (math.log(value) for value in FITTED[path])
    if not excess(low) > 0.0 > excess(high):
        raise ConfigError(f"first_period_s = {period_s:g}: expected one that some {path} gives (s)")
    rows[0][key] = math.exp(brentq(excess, low, high, xtol=1e-10))


def bounce_frequency(job):
    """Circular frequency √(jkn/(ρh)) of the wall's bounce on its base [rad/s]."""
    from yade_scripts.model.facade import joint_stiffness

    facade = job["facade"]
    return math.sqrt(joint_stiffness(job)[0] / (facade["density_kg_m3"] * facade["height_m"]))


def beta_for(job, damping):
    """β [s]: stated, 2ζ/ω of the first mode or of the bounce on the base, or by a law of β.

    The laws describe impacts on return walls, which two-sided walls do not have; they refuse those.

    Parameters
    ----------
    job : dict
    damping : dict
        One of `beta_s`, `first_mode`, `bounce` and `law`; the middle two are ζ.
    """
    from rocking.calibration.beta import beta_for as beta_by_law

    ((key, value),) = damping.items()
    if key == "beta_s":
        return float(value)
    if key == "law":
        return beta_by_law({**job, "damping": {"law": value}})
    omega = {"first_mode": first_frequency, "bounce": bounce_frequency}
    if key not in omega:
        raise ConfigError(f"damping.{key}: expected beta_s, first_mode, bounce or law")
    return 2.0 * float(value) / omega[key](job)


def cases(experiment):
    """Cases of an experiment by variant; of free rocking by variant and height."""
    variants = experiment.specimen["variants"].items()
    if experiment.specimen["kind"] == "shake_table":
        return {name: case(experiment.specimen, changes) for name, changes in variants}
    return {
        f"{name}|{height_m:g}": case(experiment.specimen, changes, float(height_m))
        for name, changes in variants
        for height_m in experiment.runs["height_m"].unique()
    }


def quartiles(experiment):
    """Quartiles of what was measured by run, or the range that was stated, and how many trials.

    Returns
    -------
    DataFrame
        By run: p25, median, p75, trials.
    """
    unit, table = experiment.unit, experiment.measured.set_index("run")
    trials = table[f"measured_{unit}"].groupby(level=0)
    found = trials.quantile([0.25, 0.5, 0.75]).unstack()
    found.columns = ["p25", "median", "p75"]
    if f"low_{unit}" in table:
        found["p25"], found["p75"] = table[f"low_{unit}"], table[f"high_{unit}"]
    return found.assign(trials=trials.size())


def motion(experiment, run, folder, table):
    """Table motion of a run.

    Parameters
    ----------
    experiment : Experiment
    run : Series
        Row of `runs`.
    folder : str or None
        Where the motions lie that are not part of the project.
    table : str
        Records table of the stand-ins.

    Returns
    -------
    time_s, acceleration_m_s2 : ndarray
    source : str
        "file" or the stand-in's name.
    """
    from rocking.records import load

    about = experiment.specimen["motions"]
    path = Path(folder or "") / about["files"].format(run=int(run["run"]))
    if folder and path.is_file():
        time_s, value = np.loadtxt(path, unpack=True)
        unit = UNITS[about["unit"]]
        return time_s, np.gradient(value, time_s) if unit is None else unit * value, "file"
    name = about["stand_in"][run["record"]]
    record = load(name, table)
    ground = record.acceleration_m_s2
    size = run["pga_g"] * STANDARD_GRAVITY_M_S2 / np.abs(ground).max()
    return record.time_s, size * ground, name


def motions_of(table):
    """What shook the runs of a table of peaks, with their number, for a figure."""
    sources = table.groupby("source", sort=False)["run"].nunique()
    names = {"file": "of the test"}
    return "; ".join(f"{names.get(n, n)} ({count} runs)" for n, count in sources.items())


def one_after_another(motions):
    """Motions end to end on one time axis, QUIET_S apart, and where each begins and ends.

    Parameters
    ----------
    motions : list of (time_s, acceleration_m_s2)

    Returns
    -------
    time_s, acceleration_m_s2 : ndarray
    spans : list of (float, float)
    """
    step = min(float(np.diff(t).min()) for t, _ in motions)
    parts, spans, begin = [], [], 0.0
    for t, a in motions:
        grid = np.arange(0.0, t[-1] - t[0] + QUIET_S, step)
        parts.append(np.interp(grid, t - t[0], a, right=0.0))
        spans.append((begin, begin + step * len(grid)))
        begin = spans[-1][1]
    whole = np.concatenate(parts)
    return step * np.arange(len(whole)), whole, spans


def peaks_of_spans(time_s, d, spans, status):
    """Largest |d| of each span from where it begins; nan from the one in which the wall fell on.

    Parameters
    ----------
    time_s, d : ndarray
        Of a history; one that came to rest ("ok") may end before its last span does.
    spans : list of (float, float)
    status : str
    """
    found = []
    for begin, end in spans:
        inside = (time_s >= begin) & (time_s < end)
        whole = inside.any() and (status == "ok" or time_s[-1] >= end)
        found.append(np.abs(d[inside] - d[inside][0]).max() if whole else math.nan)
    return found


def factors(seed, runs, members, band):
    """Amplitude factors: as it was, nudged, and `members` drawn evenly from 1 ± band, by run."""
    drawn = np.random.default_rng(seed).uniform(1.0 - band, 1.0 + band, (runs, members))
    return np.column_stack([np.ones(runs), np.full(runs, 1.0 + NUDGE), drawn])


def geometric(ratio):
    """Geometric mean of ratios and their scatter, e to the standard deviation of ln ratio."""
    logs = np.log(np.asarray(ratio, float))
    logs = logs[np.isfinite(logs)]
    scatter = np.exp(logs.std(ddof=1)) if len(logs) > 1 else math.nan
    return (np.exp(logs.mean()) if len(logs) else math.nan), scatter


def summary(experiment, table):
    """Ratio of computed over measured by variant, solver and how, and the other code's.

    Parameters
    ----------
    experiment : Experiment
        Of a shake table.
    table : DataFrame
        Columns run, variant, how, solver, peak_<unit>, measured_<unit>, status.

    Returns
    -------
    DataFrame
        variant, how, solver, runs, fell, mean, scatter, goal_met.
    """
    goal, unit = experiment.specimen["goal"], experiment.unit
    late = table[table["run"] >= goal["from_run"]]
    rows = []
    for key, part in late.groupby(["variant", "how", "solver"], sort=False):
        mean, scatter = geometric(part[f"peak_{unit}"] / part[f"measured_{unit}"])
        fell = int((part["status"] != "ok").sum())
        low, high = goal["mean"]
        met = fell == 0 and low <= mean <= high and scatter <= goal["scatter"]
        rows.append((*key, len(part), fell, mean, scatter, int(met)))
    another = f"another_{unit}"
    if another in experiment.measured:
        part = experiment.measured
        part = part[(part["run"] >= goal["from_run"]) & part[another].notna()]
        mean, scatter = geometric(part[another] / part[f"measured_{unit}"])
        name = experiment.specimen["another"]
        rows.append((name, ALONE, name, len(part), 0, mean, scatter, ""))
    names = ["variant", "how", "solver", "runs", "fell", "mean", "scatter", "goal_met"]
    return pd.DataFrame(rows, columns=names)
