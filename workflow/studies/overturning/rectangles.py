"""Rectangular blocks on a shake table: a folder that waits for tests that others have.

A block of width b and height h stands on two corners. What varies from draw to draw is stated in
blocks.yaml; tests.csv has a row a test.
"""

import math
from pathlib import Path

import numpy as np
import yaml
from rocking.configuration.config import ConfigError
from rocking.solver import Motions
from rocking.tables import read_frame

from studies.overturning import blocks, predict
from studies.overturning.score import measures
from yade_scripts.lists import listed

COLUMNS = ("test", "width_m", "height_m", "mass_kg", "motion", "factor", "outcome")
FELL, STOOD = "fell", "stood"


def read(folder):
    """What blocks.yaml states, and the tests; ConfigError of one line if a file is not as said."""
    folder = Path(folder)
    for name in ("blocks.yaml", "tests.csv"):
        if not (folder / name).is_file():
            raise ConfigError(f"{folder / name}: expected this file of the prediction")
    stated = yaml.safe_load((folder / "blocks.yaml").read_text("utf-8"))
    tests = read_frame(folder / "tests.csv", comment="#")
    if absent := [name for name in COLUMNS if name not in tests]:
        raise ConfigError(f"{folder}/tests.csv: expected columns {listed(absent)}")
    if tests.empty:
        raise ConfigError(f"{folder}/tests.csv: expected a row a test: nobody has filled it in yet")
    for name in ("width_m", "height_m", "mass_kg"):
        for test, given in tests.loc[~(tests[name] > 0.0), ["test", name]].to_numpy():
            raise ConfigError(f"{folder}/tests.csv: test {test}: {name} = {given}: expected > 0")
    wrong = tests["outcome"].notna() & ~tests["outcome"].isin([FELL, STOOD])
    for test, given in tests.loc[wrong, ["test", "outcome"]].to_numpy():
        raise ConfigError(
            f"{folder}/tests.csv: test {test}: outcome = {given}: expected {FELL}, {STOOD} or blank"
        )
    return stated, tests


def standing(stated, width_m, height_m, mass_kg, number):
    """`Standing` of a rectangular block in one draw."""
    rng = np.random.default_rng([stated["seed"], number])
    half = 0.5 * width_m * math.exp(stated["width_log_deviation"] * rng.normal())
    contact = stated["contact_n_m"] * math.exp(stated["contact_log_deviation"] * rng.normal())
    friction = math.radians(rng.uniform(*stated["friction_deg"]))
    damping = rng.uniform(*stated["damping"])
    corners = np.array([[-half, -0.5 * height_m], [half, -0.5 * height_m]])
    inertia = mass_kg * (width_m**2 + height_m**2) / 12.0
    beta = blocks.beta(mass_kg, contact, damping)
    fallen = blocks.fallen_tilt(corners)
    return blocks.Standing(corners, mass_kg, (inertia,) * 3, friction, contact, beta, fallen)


def motion(path, factor):
    """`Motions` of a file of times [s] and accelerations [m/s²]; ConfigError of one line."""
    try:
        time_s, values = np.loadtxt(path, delimiter=",", unpack=True, ndmin=2)
        return Motions(time_s - time_s[0], factor * values)
    except OSError:
        raise ConfigError(f"{path}: expected this file of a motion") from None
    except ValueError as error:
        raise ConfigError(f"{path}: expected rows of growing time [s],m/s²: {error}") from None


def run(folder, data):
    """Predict every test, write predicted.csv, and score the outcomes that are known.

    Returns the table and its scores, None where no outcome is known. Each draw takes a factor on
    the amplitude too.
    """
    stated, tests = read(folder)
    falls = np.zeros((stated["draws"], len(tests)), bool)
    rng = np.random.default_rng(stated["seed"])
    amplitudes = np.exp(stated["amplitude_log_deviation"] * rng.normal(size=falls.shape))
    for k, row in enumerate(tests.itertuples()):
        for number in range(stated["draws"]):
            drawn = standing(stated, row.width_m, row.height_m, row.mass_kg, number)
            shaken = motion(Path(data or folder) / row.motion, row.factor * amplitudes[number, k])
            falls[number, k] = predict.fell(stated, drawn, [shaken])[0]
    members = stated["draws"]
    result = tests[["test", "outcome"]].assign(members=members, fell=falls.sum(axis=0))
    result["probability_of_fall"] = (result["fell"] / members).round(5)
    result.to_csv(Path(folder) / "predicted.csv", index=False)
    known = result[result["outcome"].notna()]
    if known.empty:
        return result, None
    return result, measures(known["probability_of_fall"], known["outcome"] == FELL, members)
