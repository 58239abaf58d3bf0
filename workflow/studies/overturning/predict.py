"""Probability that a block falls, test by test, by the compiled planar solver."""

import multiprocessing
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
import pandas as pd
import yaml
from rocking.configuration.config import ConfigError
from rocking.solver import peaks, stable_step, to_plane

from studies.overturning import blocks, draws, table
from studies.shared.digests import commit_of, digest
from yade_scripts.lists import listed

MODELS = ("geometry", "fitted")
KEYS = (
    *("title", "seed", "draws", "specimens", "direction", "contact"),
    *("centre_of_mass_deviation_mm", "friction_deg", "contact_n_m", "contact_log_deviation"),
    *("damping", "step_fraction"),
)


def read(folder, model):
    """What a model states; ConfigError of one line names the file and what is missing."""
    path = Path(folder) / f"{model}.yaml"
    if not path.is_file():
        raise ConfigError(f"{path}: expected this file of the prediction")
    stated = yaml.safe_load(path.read_text("utf-8"))
    if missing := [key for key in KEYS if key not in stated]:
        raise ConfigError(f"{path}: expected {listed(missing)}")
    return stated


def fell(stated, standing, motions):
    """Which of some motions overturn a block that stands like this, bool array."""
    plane = to_plane(blocks.scene(standing))
    step = stated["step_fraction"] * stable_step(plane)
    out = peaks(plane, motions, blocks.NUMERICS, np.ones(len(motions)), step_s=step)
    if out.failed.any():
        raise ValueError(f"{out.failed.sum()} histories failed: expected a smaller step_fraction")
    return out.overturned


_shared: dict = {}


def _one(job):
    specimen, number = job
    solid, mass_kg = _shared["solids"][specimen]
    weakest = _shared["weakest"][specimen]
    drawn = draws.draw(_shared["stated"], solid, mass_kg, weakest, number, specimen)
    return fell(_shared["stated"], drawn.standing, _shared["motions"])


def members(stated, folder, cores=1, numbers=None):
    """Falls by specimen, bool array of shape (draws, tests), and the tests' numbers."""
    numbers = list(table.tests(folder).index if numbers is None else numbers)
    solids = draws.solids(stated, folder)
    _shared.update(
        stated=stated,
        solids=solids,
        weakest={key: draws.weakest(solid) for key, (solid, _) in solids.items()},
        motions=list(table.motions(folder, numbers).values()),
    )
    jobs = [(specimen, k) for specimen in solids for k in range(stated["draws"])]
    with ProcessPoolExecutor(cores, multiprocessing.get_context("fork")) as pool:
        falls = list(pool.map(_one, jobs))
    every = np.array(falls).reshape(len(solids), stated["draws"], len(numbers))
    return dict(zip(solids, every, strict=True)), numbers


def rows(by_specimen, numbers):
    """Table of a prediction: a row a test and specimen."""
    parts = [
        pd.DataFrame(
            {
                "test": numbers,
                "specimen": specimen,
                "members": len(falls),
                "fell": falls.sum(axis=0),
                "probability_of_fall": falls.mean(axis=0).round(5),
            }
        )
        for specimen, falls in by_specimen.items()
    ]
    return pd.concat(parts).sort_values(["test", "specimen"], ignore_index=True)


def run(folder, data, model, cores=1):
    """Predict all tests by a model; write its table and its lines of the digest."""
    folder = Path(folder)
    stated = read(folder, model)
    result = rows(*members(stated, data, cores))
    path = folder / f"{model}.csv"
    result.to_csv(path, index=False)
    lines = digests(folder)
    lines[model] = {
        "stated": digest(folder / f"{model}.yaml"),
        "predicted": digest(path),
        "stated_in": commit_of(folder / f"{model}.yaml"),
    }
    text = [f"{name} {key} {value}" for name, said in lines.items() for key, value in said.items()]
    (folder / "digest.txt").write_text("\n".join(text) + "\n", "utf-8")
    return result


def digests(folder):
    """By model what digest.txt says: stated, predicted, stated_in."""
    path = Path(folder) / "digest.txt"
    by_model: dict[str, dict[str, str]] = {}
    if path.is_file():
        for line in path.read_text("utf-8").splitlines():
            model, key, value = line.split()
            by_model.setdefault(model, {})[key] = value
    return by_model
