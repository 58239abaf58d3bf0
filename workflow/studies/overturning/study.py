"""How often blocks fell to which a model gave a probability, beside how often they should have."""

from pathlib import Path

import numpy as np
import pandas as pd
from rocking.configuration.config import ConfigError
from rocking.tables import read_frame

from studies.overturning import score, table
from studies.overturning.predict import MODELS

HALVES = ("handed out", "kept back")
HANDED_OUT = Path(__file__).with_name("handed_out.txt")


def handed_out():
    """Motions whose outcomes were known to who fitted, a set of names."""
    lines = HANDED_OUT.read_text("utf-8").splitlines()
    return {line for line in lines if line and not line.startswith("#")}


def predicted(folder, model):
    """Prediction of a model without any outcome: column `y` is NaN, `half` is empty."""
    return read_frame(Path(folder) / f"{model}.csv").assign(y=np.nan, half="")


def known(folder, tests, model):
    """Prediction of a model where the outcome is known, with the half of its motion."""
    compared = score.joined(folder, tests, model)
    mine = handed_out()
    return compared.assign(half=[HALVES[motion not in mine] for motion in compared["motion"]])


def calibration(folder, tests=None):
    """Rows by model, half and bin of probability: tests, foreseen, least, fell, most, within.

    Parameters
    ----------
    folder : path
        Of the prediction; ConfigError of one line where its digest tells of a change.
    tests : path, optional
        Table of the tests, or its folder; without one, or without a known outcome, `fell` is NaN.

    Returns
    -------
    DataFrame
        `least` to `most` is the range of how many fall of tests with these probabilities, 90 %.
    """
    outcomes = None if tests is None else table.tests(tests)
    parts = []
    for model in MODELS:
        score.unchanged(folder, model)
        compared = predicted(folder, model) if outcomes is None else known(folder, outcomes, model)
        if compared.empty:
            raise ConfigError(f"{tests}: expected outcomes of tests: none is known")
        for half, of_half in compared.groupby("half"):
            rows = score.calibration(of_half["probability_of_fall"], of_half["y"].fillna(0.0))
            if outcomes is None:
                rows[["fell", "within"]] = np.nan, ""
            parts.append(rows.assign(model=model, half=half))
    rows = pd.concat(parts, ignore_index=True)
    return rows[["model", "half", *[n for n in rows if n not in ("model", "half")]]]
