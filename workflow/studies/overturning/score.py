"""Predictions of falls against what happened."""

import math
from pathlib import Path

import numpy as np
import pandas as pd
from rocking.configuration.config import ConfigError
from rocking.tables import read_frame

from studies.overturning import table
from studies.overturning.predict import MODELS, digest, digests

BINS = (0.0, 0.1, 0.3, 0.7, 0.9, 1.0)
CERTAIN = 0.5  # of a fall, from which a prediction says that the block falls


def known(tests, specimen):
    """Outcomes of a specimen by test, those that are known.

    ConfigError of one line names the test whose outcome is neither 0 nor 1, or the lacking column.
    """
    name = f"overturned_specimen{specimen}"
    if name not in tests:
        raise ConfigError(f"{table.TESTS}: expected a column {name}")
    values = pd.to_numeric(tests[name], errors="coerce")
    wrong = (values.isna() & tests[name].notna()) | ~(values.isna() | values.isin([0, 1]))
    for number, given in tests.loc[wrong, name].items():
        raise ConfigError(f"{table.TESTS}: test {number}: {name} = {given}: expected 0, 1 or blank")
    return values.dropna()


def unchanged(folder, model):
    """ConfigError of one line where what a model stated or predicted is not what was digested."""
    folder, said = Path(folder), digests(folder).get(model)
    if said is None:
        raise ConfigError(f"{folder}/digest.txt: no line of {model}: expected its prediction")
    for name, path in (("stated", f"{model}.yaml"), ("predicted", f"{model}.csv")):
        if not (folder / path).is_file() or digest(folder / path) != said.get(name):
            raise ConfigError(f"{folder / path}: not what digest.txt says: what was {name} changed")


def measures(probability, fell, members):
    """Scores of probabilities p against outcomes y (1 fell), both of shape (n,).

    Share of outcomes on the likelier side, Brier score mean (p − y)², and the geometric mean of the
    probability of what happened, of the share (k + 1)/(n + 2) of n draws, so that a draw less or
    more does not make it 0.
    """
    p, y = np.asarray(probability, float), np.asarray(fell, float)
    careful = (p * members + 1.0) / (members + 2.0)
    likely = np.where(y > 0.0, careful, 1.0 - careful)
    return {
        "tests": y.size,
        "fell": int(y.sum()),
        "foreseen": float(p.sum()),
        "correct": float(np.mean((p > CERTAIN) == (y > 0.0))),
        "brier": float(np.mean((p - y) ** 2)),
        "likelihood": math.exp(np.mean(np.log(likely))),
    }


def interval(probability, share=0.9):
    """Range of how many fall of independent tests with these probabilities (Poisson binomial)."""
    counts = np.ones(1)
    for p in np.asarray(probability, float):
        counts = np.convolve(counts, [1.0 - p, p])
    total = np.cumsum(counts)
    tail = 0.5 * (1.0 - share)
    return int(np.searchsorted(total, tail)), int(np.searchsorted(total, 1.0 - tail))


def calibration(probability, fell):
    """Rows by bin of probability: how many tests, how many fell, and between how many should."""
    p, y = np.asarray(probability, float), np.asarray(fell, float)
    place = np.digitize(p, BINS[1:-1], right=False)
    rows = []
    for k, (low, high) in enumerate(zip(BINS, BINS[1:], strict=False)):
        mine = place == k
        least, most = interval(p[mine])
        count = int(y[mine].sum())
        row = {"from": low, "to": high, "tests": int(mine.sum()), "foreseen": p[mine].sum()}
        rows.append(row | {"least": least, "fell": count, "most": most})
        rows[-1]["within"] = "yes" if least <= count <= most else "no"
    return pd.DataFrame(rows)


def joined(folder, tests, model):
    """Prediction of a model beside the known outcomes, column `y`, and motions, a row a test."""
    predicted = read_frame(Path(folder) / f"{model}.csv")
    parts = []
    for specimen, part in predicted.groupby("specimen"):
        outcome = known(tests, specimen)
        part = part[part["test"].isin(outcome.index)]
        parts.append(
            part.assign(
                y=outcome.loc[part["test"]].to_numpy(),
                motion=tests.loc[part["test"], "motion"].to_numpy(),
            )
        )
    return pd.concat(parts, ignore_index=True)


def score(folder, data, models=MODELS):
    """Scores by model and specimen; refuses what was changed.

    `data` is the folder of the tests or a table of them with outcomes. ConfigError if none of the
    outcomes is known.
    """
    tests, rows = table.tests(data), []
    for model in models:
        unchanged(folder, model)
        compared = joined(folder, tests, model)
        if compared.empty:
            raise ConfigError(f"{data}: expected outcomes of tests: none is known")
        for specimen, part in compared.groupby("specimen"):
            scores = measures(part["probability_of_fall"], part["y"], part["members"])
            rows.append({"model": model, "specimen": specimen, **scores})
    return pd.DataFrame(rows)
