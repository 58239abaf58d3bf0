"""Experiments: walls that others tested, run by both solvers and set against what they measured.

An experiment is a folder of three files: `specimen.yaml` (the wall; `specimens` says how its
parameters follow), `runs.csv` (what it went through, in order) and `measured.csv`. Another model of
the same test states `like: folder` and what it changes. docs/evidence.md has what stands
in them.
"""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import yaml
from rocking.collapse.ratios import Ratios
from rocking.configuration.config import ConfigError
from rocking.tables import read_frame

from yade_scripts.lists import listed
from yade_scripts.model import registry
from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2

SECTIONAL = {"sections", "facade", "numerics", "observed"}  # keys whose mappings are merged
KINDS = {"shake_table": ("record", "pga_g"), "free_rocking": ("height_m",)}  # columns of runs.csv
KEYS = ("title", "source", "kind", "model", "sections", "damping", "observed", "variants")
DAMPING = ("beta_s", "first_mode", "bounce", "law")
UNITS = {"m/s": None, "m/s2": 1.0, "g": STANDARD_GRAVITY_M_S2}  # of motions; m/s is differentiated
QUIET_S = 2.0  # between runs that follow each other on the same wall
NUDGE = 1e-4  # of amplitude: a peak that it moves by more than ten times as much does not repeat
STILL = 10.0 * NUDGE
ALONE, SEQUENCE = "alone", "in sequence"
PERCENTILES = (10, 50, 90)
APART = 3.0  # two solvers' peaks, from which no mean rests on the run
TURNING = ", the top may turn"  # what ends the name of a variant with the other bearing


@dataclass(frozen=True)
class Experiment:
    """What the three files of a folder say; `runs` and `measured` have a column `run`.

    `measured` has `measured_<unit>` and maybe `another_<unit>`.
    """

    specimen: dict
    runs: pd.DataFrame
    measured: pd.DataFrame

    @property
    def unit(self):
        """Unit of what was measured, as in the columns' names."""
        return self.specimen["observed"]["unit"]


def files(folder, below=()):
    """Files of an experiment: its own, then those of the experiment that it is `like`.

    ConfigError if it is like itself in the end; `below` holds those that are like it.
    """
    folder = Path(folder)
    path = folder / "specimen.yaml"
    if folder.name in below:
        raise ConfigError(f"{path}: like: expected another experiment, not {below[-1]} again")
    tables = [folder / name for name in ("runs.csv", "measured.csv")]
    paths = [path, *(table for table in tables if table.is_file())]
    like = yaml.safe_load(path.read_text("utf-8")).get("like")
    return paths + (files(folder.parent / like, (*below, folder.name)) if like else [])


def over(under, above):
    """Mappings, one over the other, section by section; but variants and damping as a whole."""
    both = {k: over(under[k], above[k]) for k in SECTIONAL & under.keys() & above.keys()}
    return {**under, **above, **both}


def read(folder):
    """Read an experiment; ConfigError of one line with the file, its key and what was expected."""
    folder = Path(folder)
    given = files(folder)
    path = folder / "specimen.yaml"
    specimen: dict[str, Any] = {}
    for file in reversed([file for file in given if file.name == path.name]):
        specimen = over(specimen, yaml.safe_load(file.read_text("utf-8")))
    missing = [key for key in KEYS if key not in specimen]
    if missing:
        raise ConfigError(f"{path}: expected {listed(missing)}")
    for key, known in (("kind", KINDS), ("model", registry.MODELS)):
        if specimen[key] not in known:
            raise ConfigError(f"{path}: {key} = {specimen[key]}: expected {' or '.join(known)}")
    check_damping(path, specimen)
    tables = []
    measured = (f"measured_{specimen['observed']['unit']}",)
    for name, columns in (("runs", KINDS[specimen["kind"]]), ("measured", measured)):
        file = next((file for file in given if file.stem == name), folder / f"{name}.csv")
        table = read_frame(file, comment="#", numbers=["run"])
        absent = [column for column in ("run", *columns) if column not in table]
        if absent:
            raise ConfigError(f"{file}: expected columns {listed(absent)}")
        tables.append(table)
    strangers = sorted({*tables[1]["run"]} - {*tables[0]["run"]})
    if strangers:
        raise ConfigError(f"{folder}/measured.csv: run {strangers[0]}: expected one of runs.csv")
    return Experiment(specimen, *tables)


def check_damping(path, specimen):
    """Refuse what is no damping, and a law of β where a variant has no return walls to strike.

    ConfigError of one line with the file, the variant, its key and what was expected.
    """
    free, facade = registry.model(specimen["model"]).walls == "none", specimen["sections"]["facade"]
    for name, changes in specimen["variants"].items():
        damping = changes.get("damping", specimen["damping"])
        where = f"{path}: variants.{name}: damping"
        if len(damping) != 1 or not set(damping) <= set(DAMPING):
            raise ConfigError(f"{where}.{'.'.join(damping)}: expected one of {', '.join(DAMPING)}")
        sides = changes.get("facade.sides", facade.get("sides", "one"))
        if "law" in damping and (free or sides == "two"):
            raise ConfigError(
                f"{where}.law = {damping['law']}: expected {', '.join(DAMPING[:-1])} with "
                f"facade.sides = {sides} and model {specimen['model']}, since both laws describe "
                "impacts against return walls"
            )


def quartiles(experiment):
    """By run p25, median and p75 of what was measured, or the range stated, and how many trials."""
    unit, table = experiment.unit, experiment.measured.set_index("run")
    trials = table[f"measured_{unit}"].groupby(level=0)
    by_run = trials.quantile([0.25, 0.5, 0.75]).unstack()
    by_run.columns = ["p25", "median", "p75"]
    if f"low_{unit}" in table:
        by_run["p25"], by_run["p75"] = table[f"low_{unit}"], table[f"high_{unit}"]
    return by_run.assign(trials=trials.size())


def motion(experiment, run, folder, table):
    """Times, acceleration and source of a run's table motion: "file", or the stand-in's name.

    `run` is a row of `runs`, `folder` where the motions lie that are not part of the project,
    `table` the records of the stand-ins.
    """
    about = experiment.specimen["motions"]
    path = Path(folder or "") / about["files"].format(run=int(run["run"]))
    if folder and path.is_file():
        time_s, value = np.loadtxt(path, unpack=True)
        unit = UNITS[about["unit"]]
        return time_s, np.gradient(value, time_s) if unit is None else unit * value, "file"
    return stand_in(about["stand_in"][run["record"]], table, run["pga_g"])


def stand_in(name, table, pga_g):
    """Times and acceleration of a record of a table, scaled to a peak, and its name."""
    from rocking.records import load

    record = load(name, table)
    ground = record.acceleration_m_s2
    size = pga_g * STANDARD_GRAVITY_M_S2 / np.abs(ground).max()
    return record.time_s, size * ground, name


def motions_of(table):
    """What shook the runs of a table of peaks, with their number, for a figure."""
    sources = table.groupby("source", sort=False)["run"].nunique()
    names = {"file": "of the test"}
    return "; ".join(f"{names.get(n, n)} ({count} runs)" for n, count in sources.items())


def one_after_another(motions):
    """Motions (time_s, acceleration_m_s2) end to end, QUIET_S apart, and (begin, end) of each."""
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
    """Largest |d| of each span from where it begins; NaN from the one in which the wall fell on.

    A history that came to rest ("ok") may end before its last span does.
    """
    peaks = []
    for begin, end in spans:
        inside = (time_s >= begin) & (time_s < end)
        whole = inside.any() and (status == "ok" or time_s[-1] >= end)
        peaks.append(np.abs(d[inside] - d[inside][0]).max() if whole else math.nan)
    return peaks


def factors(seed, runs, members, band):
    """Amplitude factors: as it was, nudged, and `members` drawn evenly from 1 ± band, by run."""
    drawn = np.random.default_rng(seed).uniform(1.0 - band, 1.0 + band, (runs, members))
    return np.column_stack([np.ones(runs), np.full(runs, 1.0 + NUDGE), drawn])


def ratio(table, over, under):
    """Geometric mean of the ratio of two columns, and e to its standard deviation of ln ratio."""
    ratios = Ratios(table[over] / table[under])
    return ratios.mean, math.exp(ratios.scatter)


def steady(table):
    """Runs of each variant and how on which a mean may rest, by row of a table as of `summary`.

    They stand where nothing falls, by either solver and at any amplitude of its band (`fell`); they
    are apart where the solvers' peaks differ by a factor of APART or more.
    """
    members = table["fell"].fillna(0) if "fell" in table else 0
    peak = table[[name for name in table if name.startswith("peak_")][0]]
    runs = table.assign(falls=(table["status"] != "ok") | (members > 0), peak=peak)
    runs = runs.groupby(["variant", "how", "run"])
    high, low = runs["peak"].transform("max"), runs["peak"].transform("min")
    return ~runs["falls"].transform("any"), high >= APART * low


def summary(experiment, table):
    """Ratio of computed over measured by variant, solver and how, and the other code's.

    Means and scatters are of the runs in which nothing falls, in either solver or at an amplitude
    of the band, and the solvers do not part by APART. The table, of a shake table, has run,
    variant, how, solver, peak_<unit>, measured_<unit>, status.
    """
    goal, unit = experiment.specimen["goal"], experiment.unit
    late = table[table["run"] >= goal["from_run"]]
    rows, (stands, apart) = [], steady(late)
    late = late.assign(stands=stands, apart=stands & apart)
    for key, part in late.groupby(["variant", "how", "solver"], sort=False):
        counted = part[part["stands"] & ~part["apart"]]
        mean, scatter = ratio(counted, f"peak_{unit}", f"measured_{unit}")
        left = int((~part["stands"]).sum()), int(part["apart"].sum())
        low, high = goal["mean"]
        met = left == (0, 0) and low <= mean <= high and scatter <= goal["scatter"]
        rows.append((*key, len(part), *left, mean, scatter, int(met)))
    another = f"another_{unit}"
    if another in experiment.measured:
        part = experiment.measured
        part = part[(part["run"] >= goal["from_run"]) & part[another].notna()]
        mean, scatter = ratio(part, another, f"measured_{unit}")
        name = experiment.specimen["another"]
        rows.append((name, ALONE, name, len(part), 0, 0, mean, scatter, ""))
    names = ["variant", "how", "solver", "runs", "fell", "apart", "mean", "scatter", "goal_met"]
    return pd.DataFrame(rows, columns=names)
