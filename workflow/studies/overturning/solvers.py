"""Whether the solvers agree on fell or stood: the same draws under the same tests.

A test repeats where the compiled solver has one outcome at the stated amplitude, at a thousandth
more and less, and at half the step.
"""

import numpy as np
import pandas as pd
from rocking.solver import peaks, stable_step, to_plane
from rocking.tables import read_frame

from studies.overturning import blocks, draws, others, predict, table

NUDGE = 1e-3
TOLERANCE = 1e-6  # of the reference solver
DOUBT = 0.1, 0.95  # probabilities of a fall


def repeated(stated, standing, motions):
    """Falls by the compiled solver, and where they repeat: bool arrays, one value a motion."""
    plane = to_plane(blocks.scene(standing))
    step, ones = stated["step_fraction"] * stable_step(plane), np.ones(len(motions))
    runs = [(1.0, step), (1.0 + NUDGE, step), (1.0 - NUDGE, step), (1.0, 0.5 * step)]
    falls = np.array(
        [
            peaks(plane, motions, blocks.NUMERICS, factor * ones, step_s=h).overturned
            for factor, h in runs
        ]
    )
    return falls[0], np.all(falls == falls[0], axis=0)


def compare(stated, folder, numbers, every, in_space=None):
    """Table of outcomes, a row a draw and test: planar, repeats, reference; of some YADE's.

    Parameters
    ----------
    numbers : sequence of int
        Draws of each specimen.
    every : int
        Each so many-th test is run, from the middle of the first stride on.
    in_space : dict or None
        By specimen the tests that the first draw goes through in three dimensions too, by YADE.
    """
    strided = list(table.tests(folder).index)[every // 2 :: every]
    rows = []
    for specimen, (solid, mass) in draws.solids(stated, folder).items():
        weakest = draws.weakest(solid)
        for number in numbers:
            drawn = draws.draw(stated, solid, mass, weakest, number, specimen)
            spatial = (in_space or {}).get(specimen, []) if number == numbers[0] else []
            motions = table.motions(folder, sorted({*strided, *spatial}))
            rows += _rows(stated, drawn, (specimen, number), motions, spatial)
    return pd.DataFrame(rows).astype({"yade": "Int64"})


def _rows(stated, drawn, names, motions, spatial):
    """Rows of one draw; `names` are the specimen and the number of the draw."""
    shaken = list(motions.values())
    fell, same = repeated(stated, drawn.standing, shaken)
    other = others.fell_by_reference(drawn.standing, shaken, TOLERANCE)
    space = {}
    if spatial:
        outcomes = others.by_yade({"a": drawn}, {test: motions[test] for test in spatial})
        space = {test: outcome for (_, test), outcome in outcomes.items()}
    rows = []
    for k, test in enumerate(motions):
        row = {"test": test, "specimen": names[0], "draw": names[1], "planar": int(fell[k])}
        row |= {"repeats": int(same[k]), "reference": int(other[k])}
        row |= dict.fromkeys(("yade", "tilt_deg", "twist_deg", "moved_mm"), np.nan)
        if outcome := space.get(test):
            row["yade"] = {"fell": 1, "stood": 0}.get(outcome["status"], np.nan)
            row["tilt_deg"] = round(float(np.degrees(outcome["tilt_rad"])), 2)
            row["twist_deg"] = round(float(np.degrees(outcome["twist_rad"])), 2)
            row["moved_mm"] = round(1e3 * outcome["moved_m"], 2)
        rows.append(row)
    return rows


def doubtful(folder, model, count):
    """By specimen so many tests, evenly among those to which a model gives DOUBT."""
    predicted = read_frame(f"{folder}/{model}.csv")
    chosen = {}
    for specimen, part in predicted.groupby("specimen"):
        tests = part.loc[part["probability_of_fall"].between(*DOUBT), "test"].to_numpy()
        chosen[specimen] = sorted(tests[np.linspace(0, len(tests) - 1, count).round().astype(int)])
    return chosen


def agreement(rows):
    """How many rows repeat, in how many of these the reference agrees, and YADE of those it ran."""
    steady = rows[rows["repeats"] == 1]
    spatial = rows[rows["yade"].notna()]
    calm = spatial[spatial["repeats"] == 1]
    counts = {
        "histories": len(rows),
        "repeat": len(steady),
        "reference agrees": int((steady["planar"] == steady["reference"]).sum()),
        "of all": int((rows["planar"] == rows["reference"]).sum()),
        "in space": len(spatial),
        "of these repeat": len(calm),
        "space agrees": int((calm["planar"] == calm["yade"]).sum()),
        "falls in the plane": int(spatial["planar"].sum()),
        "falls in space": int(spatial["yade"].sum()),
    }
    return pd.Series(counts)


def run(folder, data, model="fitted", numbers=(0, 1, 2, 3), every=7, in_space=10):
    """Write solvers.csv into the folder of a prediction and return what it says.

    YADE runs `in_space` doubtful tests of each specimen, and none for 0.
    """
    spatial = doubtful(folder, model, in_space) if in_space else None
    rows = compare(predict.read(folder, model), data, numbers, every, spatial)
    rows.to_csv(f"{folder}/solvers.csv", index=False)
    return agreement(rows)
