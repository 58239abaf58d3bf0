"""Whether the solvers agree on fell or stood: the same draws under the same tests.

A test repeats where the compiled solver has one outcome at the stated amplitude, at a thousandth
more and less, and at half the step.
"""

import numpy as np
import pandas as pd

from rocking.solver import peaks, stable_step, to_plane
from rocking.studies.overturning import blocks, draws, others, predict, table

NUDGE = 1e-3
TOLERANCE = 1e-6  # of the reference solver


def repeated(stated, standing, motions):
    """Falls by the compiled solver, and where they repeat: bool arrays, one value a motion."""
    plane = to_plane(blocks.scene(standing))
    step, ones = stated["step_fraction"] * stable_step(plane), np.ones(len(motions))
    runs = [(1.0, step), (1.0 + NUDGE, step), (1.0 - NUDGE, step), (1.0, 0.5 * step)]
    found = np.array(
        [
            peaks(plane, motions, blocks.NUMERICS, factor * ones, step_s=h).overturned
            for factor, h in runs
        ]
    )
    return found[0], np.all(found == found[0], axis=0)


def compare(stated, folder, numbers, every, in_space=0):
    """Table of outcomes, a row a draw and test: planar, repeats, reference; of some YADE's.

    Parameters
    ----------
    numbers : sequence of int
        Draws of each specimen.
    every : int
        Each so many-th test is run, from the middle of the first stride on.
    in_space : int
        Of these each so many-th is run by YADE in three dimensions; 0: none.
    """
    tests = list(table.tests(folder).index)[every // 2 :: every]
    motions = table.motions(folder, tests)
    spatial = tests[in_space // 2 :: in_space] if in_space else []
    rows = []
    for specimen, (solid, mass) in draws.solids(stated, folder).items():
        weakest = draws.weakest(solid)
        for number in numbers:
            one = draws.draw(stated, solid, mass, weakest, number, specimen)
            standing = one.standing
            fell, same = repeated(stated, standing, list(motions.values()))
            other = others.fell_by_reference(standing, list(motions.values()), TOLERANCE)
            space = {}
            if spatial:
                few = {test: motions[test] for test in spatial}
                space = {n: found for (_, n), found in others.by_yade({"a": one}, few).items()}
            for k, test in enumerate(tests):
                row = {"test": test, "specimen": specimen, "draw": number}
                row |= {"planar": int(fell[k]), "repeats": int(same[k]), "reference": int(other[k])}
                row |= dict.fromkeys(("yade", "tilt_deg", "twist_deg", "slid_mm"), np.nan)
                if found := space.get(test):
                    row["yade"] = {"fell": 1, "stood": 0}.get(found["status"], np.nan)
                    row["tilt_deg"] = round(float(np.degrees(found["tilt_rad"])), 2)
                    row["twist_deg"] = round(float(np.degrees(found["twist_rad"])), 2)
                    row["slid_mm"] = round(1e3 * found["slid_m"], 2)
                rows.append(row)
    return pd.DataFrame(rows).astype({"yade": "Int64"})


def agreement(found):
    """How many rows repeat, in how many of these the reference agrees, and YADE of those it ran."""
    steady = found[found["repeats"] == 1]
    spatial = found[found["yade"].notna()]
    calm = spatial[spatial["repeats"] == 1]
    counts = {
        "histories": len(found),
        "repeat": len(steady),
        "reference agrees": int((steady["planar"] == steady["reference"]).sum()),
        "of all": int((found["planar"] == found["reference"]).sum()),
        "in space": len(spatial),
        "of these repeat": len(calm),
        "space agrees": int((calm["planar"] == calm["yade"]).sum()),
        "falls in the plane": int(spatial["planar"].sum()),
        "falls in space": int(spatial["yade"].sum()),
    }
    return pd.Series(counts)


def run(folder, data, model="geometry", numbers=(0, 1), every=7, in_space=14):
    """Write solvers.csv into the folder of a prediction and return what it says."""
    found = compare(predict.read(folder, model), data, numbers, every, in_space)
    found.to_csv(f"{folder}/solvers.csv", index=False)
    return agreement(found)
