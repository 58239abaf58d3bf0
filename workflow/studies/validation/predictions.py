"""Predictions: what tested walls will be found to have done, written down before it is known.

A prediction is a folder: `specimen.yaml` as of an experiment (`validation`), `runs.csv`, and
`outcomes.csv` for whoever knows. Its kinds are

    shake_table    falls by run, fresh and in sequence, where foot and top move alike
    foot_and_top   falls by amplification and phase of the top's motion against the foot's

    python -m studies.validation.predictions run FOLDER [--motions FOLDER] [--yade]
    python -m studies.validation.predictions score FOLDER

`run` writes predicted.csv and digest.txt into the folder: SHA-256 of what was stated, of the tables
and the commit of the former. `score` sets them against outcomes.csv. docs/evidence.md
"""

import argparse
import math
import multiprocessing
import os
import sys
import tempfile
from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
import yaml
from rocking.collapse.scan import driving
from rocking.collapse.yade import run_yade
from rocking.configuration.config import ConfigError
from rocking.records import load
from rocking.solver import Motions, history, peaks, to_plane
from rocking.tables import read_frame, write_json

from studies.shared.digests import commit_of, digest
from studies.shared.restitution import read_archive
from studies.validation import specimens
from studies.validation.predicted_motions import SUITE, foot_and_top_files, shifted, table_motion
from studies.validation.study import (
    ALONE,
    PERCENTILES,
    SEQUENCE,
    check_damping,
    one_after_another,
    peaks_of_spans,
)
from yade_scripts.lists import listed
from yade_scripts.model.floor_motions import write
from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2
from yade_scripts.model.models import build_scene

STATED = ("specimen.yaml", "runs.csv")
TABLE, DIGEST, OUTCOMES = "predicted.csv", "digest.txt", "outcomes.csv"
KINDS = {
    "shake_table": ("run", "record", "motion", "scale"),
    "foot_and_top": ("run", "foot", "top"),
}
SEED = 1976
IN_YADE = 4  # of the variants the first so many have a band, and run in YADE at its middle
FELL, STOOD = "fell", "stood"


def read(folder):
    """Specimen and runs of a prediction; ConfigError of one line names file and key."""
    path = Path(folder) / "specimen.yaml"
    specimen = yaml.safe_load(path.read_text("utf-8"))
    missing = [key for key in ("title", "source", "kind", "variants") if key not in specimen]
    if missing or specimen["kind"] not in KINDS:
        raise ConfigError(f"{path}: expected {listed(missing) or 'kind: ' + ' or '.join(KINDS)}")
    check_damping(path, specimen)
    runs = read_frame(Path(folder) / "runs.csv", comment="#", numbers=["run"])
    absent = [name for name in KINDS[specimen["kind"]] if name not in runs]
    if absent:
        raise ConfigError(f"{folder}/runs.csv: expected columns {listed(absent)}")
    return specimen, runs


def shake_table(specimen, runs, folder, in_yade, cores):
    """Table of a wall whose foot and top the table moves alike; see `run`."""
    rng = np.random.default_rng(SEED)
    count, band = specimen["members"], specimen["band"]
    drawn = rng.uniform(1.0 - band, 1.0 + band, (len(runs), count))
    motions = [table_motion(specimen, row, folder) for _, row in runs.iterrows()]
    had = [motion is not None for motion in motions]
    if not any(had):
        raise ConfigError(f"{folder}: expected files named {specimen['motions']['files']}")
    runs, drawn = runs[had], drawn[had]
    motions = [motion for motion in motions if motion is not None]
    cases = {
        name: specimens.case(specimen, changes) for name, changes in specimen["variants"].items()
    }
    main = dict(list(cases.items())[:IN_YADE])
    with ProcessPoolExecutor(cores, multiprocessing.get_context("fork")) as pool:
        tests = [
            specimens.walls_test(case, f"{variant}|{number}", f"{number}.csv")
            for number in (runs["run"] if in_yade else ())
            for variant, case in main.items()
        ]
        parts = [tests[k::cores] for k in range(cores)]  # the longest first
        shaken = [pool.submit(_by_yade, part, runs, motions) for part in parts if part]
        planar = [
            pool.submit(_planar_rows, name, case, runs, motions, drawn if name in main else None)
            for name, case in cases.items()
        ]
        rows = [row for part in planar for row in part.result()]
        done = {outcome["id"]: outcome for part in shaken for outcome in part.result()}
    rows += [_yade_row(test, done[test["id"]], runs, motions) for test in tests]
    return pd.DataFrame(rows)


def _planar_rows(variant, case, runs, motions, drawn):
    """Rows of one reading by the compiled solver; `drawn` are the amplitudes of its band, if any.

    Each run on a wall as new, then all of them in sequence.
    """
    plane, numerics = to_plane(build_scene(case)), case["numerics"]
    mm, step = 1e3 * plane.thickness_m, specimens.planar_step(plane, numerics)
    main, rows = drawn is not None, []
    for place, motion in enumerate(motions):
        factors = np.array([1.0, *(drawn[place] if main else ())])
        out = peaks(plane, Motions(*motion[:2]), numerics, factors, step_s=step)
        values = np.where(out.overturned, np.inf, mm * out.d_over_b)
        several = slice(1, None) if main else slice(None)
        band_mm = np.percentile(values[several], PERCENTILES, method="nearest")
        band = {f"p{p}_mm": v for p, v in zip(PERCENTILES, band_mm, strict=True)}
        members, fell = values[several].size, int(out.overturned[several].sum())
        about = _About(variant, runs.iloc[place], ALONE, motion[2])
        rows.append(_row(about, values[0], members, fell, band))
    whole, ground, spans = one_after_another([motion[:2] for motion in motions])
    still = {**numerics, "quiet_ratio": 0.0}
    parts: list = []
    sequences = [1.0, *drawn[0, : drawn.shape[1] // 2]] if main else [1.0]
    for factor in sequences:
        d = history(plane, Motions(whole, ground), still, factor, step_s=step, sample_s=2e-3)
        parts.append(1e3 * np.array(peaks_of_spans(d.time_s, d.d_m, spans, d.status)))
    fallen = np.sum(~np.isfinite(parts), axis=0)
    for place, (motion, peak, lost) in enumerate(zip(motions, parts[0], fallen, strict=True)):
        about = _About(variant, runs.iloc[place], SEQUENCE, motion[2])
        rows.append(_row(about, peak, len(sequences), int(lost)))
    return rows


class _About(NamedTuple):
    """What a row of the table is of: reading, run (a row of runs.csv), order, motion, solver."""

    variant: str
    row: Mapping
    how: str
    source: str
    solver: str = "planar"


def _row(about, peak_mm, members, fell, band=()):
    """Row of the table: of so many members of a run so many fell; the band in columns p10_mm, …"""
    line = {"variant": about.variant, "run": about.row["run"], "record": about.row["record"]}
    line |= {"how": about.how, "source": about.source, "solver": about.solver}
    line |= {"peak_mm": peak_mm, **dict(band)}
    return line | {"members": members, "fell": fell, "probability": fell / members}


def _by_yade(tests, runs, motions):
    """What YADE says of some tests, see `read_archive`."""
    with tempfile.TemporaryDirectory() as room:
        for number, motion in zip(runs["run"], motions, strict=True):
            write(f"{room}/{number}.csv", *motion[:2])
        write_json(
            f"{room}/walls.json",
            [{**test, "motion": f"{room}/{test['motion']}"} for test in tests],
        )
        run_yade("walls", "--list", f"{room}/walls.json", "--output", f"{room}/w.npz", folder=room)
        return read_archive(f"{room}/w.npz")


def _yade_row(test, done, runs, motions):
    """Row of one test in YADE."""
    variant, _, number = test["id"].rpartition("|")
    place = list(runs["run"]).index(int(number))
    fell = int(done["status"] == "overturned")
    mm = 1e3 * test["config"]["facade"]["thickness_m"]
    peak_mm = np.inf if fell else mm * done["peak_d_over_b"]
    about = _About(variant, runs.iloc[place], ALONE, motions[place][2], "YADE")
    return _row(about, peak_mm, 1, fell)


def foot_and_top(specimen, runs, folder, in_yade, cores):
    """Table of a gable by amplification and phase of its top's motion; see `run`.

    Where `runs` has rows, their own motions are run too: amplification and phase blank.
    """
    if in_yade:
        raise ConfigError("--yade: a prediction of foot_and_top is the compiled solver's alone")
    rows, levels = [], np.array(specimen["pga_g"], float)
    for variant, changes in specimen["variants"].items():
        case = specimens.case(specimen, changes)
        scene, numerics = build_scene(case), case["numerics"]
        plane = to_plane(scene)

        for _, row in runs.iterrows():
            t, foot, top = foot_and_top_files(row, folder)
            motion = driving(scene, t, {"ground": foot, "floor1": top})
            out = peaks(plane, motion, numerics, [1.0])
            pga = np.abs(foot).max() / STANDARD_GRAVITY_M_S2
            line = {"variant": variant, "run": row["run"], "record": row["foot"], "pga_g": pga}
            rows.append(line | {"members": 1, "fell": int(out.overturned[0])})
        for amplification in specimen["amplification"]:
            for phase in specimen["phase_deg"]:
                fell = np.zeros(levels.size, int)
                for name in specimen["records"]:
                    record = load(name, str(SUITE))
                    ground = record.acceleration_m_s2
                    t, foot, top = shifted(record.time_s, ground, amplification, phase)
                    size = levels * STANDARD_GRAVITY_M_S2 / np.abs(foot).max()
                    motion = driving(scene, t, {"ground": foot, "floor1": top})
                    fell += peaks(plane, motion, numerics, size).overturned
                for pga, count in zip(levels, fell, strict=True):
                    line = {"variant": variant, "amplification": amplification}
                    line |= {"phase_deg": phase, "pga_g": pga, "fell": int(count)}
                    rows.append(line | {"members": len(specimen["records"])})
    table = pd.DataFrame(rows)
    return table.assign(probability=table["fell"] / table["members"])


def run(folder, motions=None, in_yade=False, cores=1):
    """Write the tables of a prediction, and digests of what was stated and of them.

    `motions` is the folder of those that may not be passed on; `in_yade`, the first variants run in
    YADE too; `cores`, processes of `shake_table`. A row says of how many members how many fell.
    """
    folder = Path(folder)
    specimen, runs = read(folder)
    make = {"shake_table": shake_table, "foot_and_top": foot_and_top}[specimen["kind"]]
    table = make(specimen, runs, motions, in_yade, cores)
    table.round(6).to_csv(folder / TABLE, index=False, float_format="%.5g")
    stated = [folder / name for name in STATED]
    lines = [f"stated {digest(*stated)}", f"predicted {digest(folder / TABLE)}"]
    lines.append(f"stated_in {commit_of(*stated)}")
    (folder / DIGEST).write_text("\n".join(lines) + "\n", "utf-8")
    return table


def unchanged(folder):
    """Whether a prediction's files are those that its digests were made of, by their name."""
    folder = Path(folder)
    words = dict(line.split() for line in (folder / DIGEST).read_text("utf-8").splitlines())
    now = {"stated": digest(*(folder / n for n in STATED)), "predicted": digest(folder / TABLE)}
    return {name: words.get(name) == value for name, value in now.items()}


def outcomes_of(path, runs):
    """Rows of outcomes.csv that state an outcome.

    ConfigError of one line if it is no such table, or names a run twice, one that was not predicted
    (`runs`) or something else than a fall or a stand.
    """
    try:
        outcomes = read_frame(path, comment="#", numbers=["run"])
    except pd.errors.ParserError as error:
        raise ConfigError(f"{path}: {str(error).strip()}") from None
    except pd.errors.EmptyDataError:
        outcomes = pd.DataFrame()
    if not {"run", "outcome"} <= set(outcomes) or outcomes["outcome"].isna().all():
        raise ConfigError(f"{path}: expected rows of run,outcome,peak_mm with commas between")
    outcomes = outcomes.dropna(subset=["outcome"])
    for what, wrong, expected in (
        ("outcome", ~outcomes["outcome"].isin([FELL, STOOD]), f"{STOOD} or {FELL}"),
        ("run", ~outcomes["run"].isin(runs), f"a run of {TABLE}"),
        ("run", outcomes["run"].duplicated(), "each run once"),
    ):
        for given in outcomes.loc[wrong, what]:
            raise ConfigError(f"{path}: {what} = {given}: expected {expected}")
    return outcomes


def score(folder):
    """Set a prediction against outcomes.csv, by variant, how and solver.

    foreseen is the sum of probabilities; brier the mean of (probability − outcome)², 0.25 for a
    coin; likelihood the geometric mean of the probability of what happened, with one more stand and
    fall than was computed, so that a member less or more does not make it 0. ConfigError if the
    stated parameters or the table were changed, or an outcome is no number.
    """
    folder = Path(folder)
    for name, same in unchanged(folder).items():
        if not same:
            raise ConfigError(f"{folder}: what was {name} is not what {DIGEST} says")
    table = read_frame(folder / TABLE, numbers=["run"])
    if "run" not in table:
        raise ConfigError(
            f"{folder / TABLE}: no run is predicted; fill in runs.csv, and run it first"
        )
    outcomes = outcomes_of(folder / OUTCOMES, set(table["run"]))
    table = table.merge(outcomes, on="run", suffixes=("", "_measured"))
    keys = [key for key in ("variant", "how", "solver") if key in table]
    rows = []
    for key, part in table.groupby(keys, sort=False):
        happened = (part["outcome"] == FELL).to_numpy(float)
        share = part["probability"].to_numpy(float)
        careful = (part["fell"] + 1.0) / (part["members"] + 2.0)
        likely = np.where(happened > 0.0, careful, 1.0 - careful)
        brier, mean = np.mean((share - happened) ** 2), math.exp(np.mean(np.log(likely)))
        rows.append((*key, len(part), int(happened.sum()), share.sum(), brier, mean))
    return pd.DataFrame(rows, columns=[*keys, "runs", "fell", "foreseen", "brier", "likelihood"])


def main(words=None):
    """Run or score predictions from the command line; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("what", choices=["run", "score"])
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--motions", help="folder of motions that are not part of the project")
    parser.add_argument("--yade", action="store_true", help="the first variants by YADE too")
    cores = len(os.sched_getaffinity(0))
    parser.add_argument("--cores", type=int, default=cores, help="processes (default: every core)")
    given = parser.parse_args(words)
    try:
        for folder in given.folders:
            if not Path(folder).is_dir():
                raise ValueError(f"{folder}: no folder of a prediction")
            if given.what == "run":
                table = run(folder, given.motions, given.yade, max(1, given.cores))
            else:
                table = score(folder)
            sys.stdout.write(table.to_string(index=False) + "\n")
    except FileNotFoundError as error:
        missing = error.filename or error
        sys.stderr.write(f"predictions: {missing}: expected this file of the prediction\n")
        return 1
    except (ConfigError, OSError, ValueError) as error:
        sys.stderr.write(f"predictions: {error}\n")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
