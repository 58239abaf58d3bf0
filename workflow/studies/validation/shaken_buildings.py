"""Shaken masonry buildings by run and damage grade: a folder that waits for them.

    python -m studies.validation.shaken_buildings FOLDER

facades.csv has a row a run, with the façade that was damaged out of plane. The shipped formula
gives the probability that it falls at the run's PGA; where grades of damage are known they are set
beside it, grade 5 a fall. docs/evidence.md
"""

import argparse
import math
import sys
from pathlib import Path

from rocking import Case, estimate
from rocking.configuration.config import ConfigError
from rocking.configuration.study import as_in_the_study
from rocking.tables import read_frame

from yade_scripts.lists import listed

COLUMNS = (
    *("building", "run", "model", "height_m", "thickness_m"),
    *("first_period_s", "building_mass_kg", "pga_g", "grade"),
)
COLLAPSE = 5
FALLS = 0.5  # probability from which a fall is foreseen


def read(folder):
    """The runs; ConfigError of one line that names the file, the row and what was expected."""
    path = Path(folder) / "facades.csv"
    if not path.is_file():
        raise ConfigError(f"{path}: expected this file of the prediction")
    runs = read_frame(path, comment="#", numbers=["run"])
    if absent := [name for name in COLUMNS if name not in runs]:
        raise ConfigError(f"{path}: expected columns {listed(absent)}")
    if runs.empty:
        raise ConfigError(f"{path}: expected a row a run: nobody has filled it in yet")
    for number, row in enumerate(runs.to_dict("records"), 1):
        pga_g, grade = float(row["pga_g"]), float(row["grade"])
        if not pga_g > 0.0:
            raise ConfigError(f"{path}: row {number}: pga_g = {pga_g:g}: expected > 0 (g)")
        if not (math.isnan(grade) or grade in range(COLLAPSE + 1)):
            raise ConfigError(f"{path}: row {number}: grade = {grade:g}: expected 0 to 5 or blank")
    return runs


def predict(runs):
    """The runs with half_collapse_g and probability_of_fall of their façade by the formula."""
    medians, chances = [], []
    for row in runs.to_dict("records"):
        case = Case.configured(
            row["model"],
            as_in_the_study(
                {
                    "facade.height_m": float(row["height_m"]),
                    "facade.thickness_m": float(row["thickness_m"]),
                    "smdof.period_s": float(row["first_period_s"]),
                    "facade.base": "column",
                    "return_wall.building_mass_kg": float(row["building_mass_kg"]),
                }
            ),
        )
        curve = estimate(case)
        medians.append(curve.median)
        chances.append(float(curve.probability(row["pga_g"])))
    return runs.assign(half_collapse_g=medians, probability_of_fall=chances)


def score(table):
    """Brier score and share foreseen of the runs whose grade is known; None without any."""
    known = table[table["grade"].notna()]
    if known.empty:
        return None
    fell = (known["grade"] >= COLLAPSE).astype(float)
    chance = known["probability_of_fall"]
    return {
        "runs": len(known),
        "fell": int(fell.sum()),
        "correct": float(((chance > FALLS) == (fell > 0.0)).mean()),
        "brier": float(((chance - fell) ** 2).mean()),
    }


def main(words=None):
    """Predict and, where grades are known, score; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder")
    given = parser.parse_args(words)
    try:
        table = predict(read(given.folder))
    except (ConfigError, ValueError, OSError) as error:
        sys.stderr.write(f"shaken_buildings: {error}\n")
        return 1
    table.round(4).to_csv(Path(given.folder) / "predicted.csv", index=False)
    sys.stdout.write(table.round(3).to_string(index=False) + "\n")
    if scores := score(table):
        sys.stdout.write(", ".join(f"{key} {value:.3g}" for key, value in scores.items()) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
