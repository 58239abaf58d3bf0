"""Space-filling samples of the uncertain parameters, and variants of a case that have them."""

import math

import numpy as np
import pandas as pd
from rocking.collapse.case import Variant
from scipy.special import ndtri

MEDIAN = 0  # number of the sample in which every factor is 1
PLACES = {  # dotted key of a case, for parameters that are one value of it
    "beta_s": "beta_s",
    "e_mpa": "facade.e_mpa",
    "density_kg_m3": "facade.density_kg_m3",
    "thickness_m": "facade.thickness_m",
    "period_s": "smdof.period_s",
    "damping_ratio": "smdof.damping_ratio",
    "base_shear_ratio": "smdof.base_shear_ratio",
}


def scores(settings):
    """Standardised values of a sample, shape (samples, parameters), without the medians' row.

    Mean 0 and standard deviation 1, by section uncertainty. A ValueError for fewer points than two
    for every slope, or Sobol' points that are no power of two.
    """
    from scipy.stats import qmc  # slow to load, and a plan needs none

    count, rows = settings["samples"], settings["parameters"]
    if count < 2 * len(rows):
        raise ValueError(
            f"uncertainty.samples = {count}: expected at least {2 * len(rows)}, two for each of "
            f"uncertainty.parameters"
        )
    if settings["sampling"] == "sobol":
        if count & (count - 1):
            raise ValueError(f"uncertainty.samples = {count}: expected a power of two for sobol")
        drawn = qmc.Sobol(len(rows), rng=np.random.default_rng(settings["seed"])).random(count)
    else:
        maker = qmc.LatinHypercube(len(rows), rng=np.random.default_rng(settings["seed"]))
        drawn = maker.random(count)
    uniform = np.array([row["distribution"] == "uniform" for row in rows])
    return np.where(uniform, math.sqrt(3.0) * (2.0 * drawn - 1.0), ndtri(drawn))


def factors(settings):
    """Factor on every parameter (columns) by sample; row MEDIAN has ones.

    exp(σ z) for a lognormal one, 1 + r z/√3 for a uniform one, with z the score and σ or r the
    spread.
    """
    z = scores(settings)
    columns = {}
    for row, score in zip(settings["parameters"], z.T, strict=True):
        spread = row["spread"]
        if row["distribution"] == "lognormal":
            factor = np.exp(spread * score)
        else:
            factor = 1.0 + spread * score / math.sqrt(3.0)
        columns[row["parameter"]] = np.concatenate(([1.0], factor))
    return pd.DataFrame(columns)


def variant(case, factor):
    """Variant of a case with the parameters times their factors, by parameter.

    Friction is the coefficient tan φ of base and back joints; a length of return wall that is null
    is h/2 before it is multiplied.
    """
    changes, factors = {}, {}
    for name, value in factor.items():
        if name == "friction":
            for key in ("facade.friction_deg", "return_wall.friction_deg"):
                tangent = value * math.tan(math.radians(case.get(key)))
                changes[key] = math.degrees(math.atan(tangent))
        elif name == "length_m":
            length = case["return_wall"]["length_m"] or 0.5 * case["facade"]["height_m"]
            changes["return_wall.length_m"] = value * length
        else:
            factors[PLACES[name]] = value
    return Variant("sample", changes=changes, factors=factors)


def motions(names, directions, settings):
    """Direction by record of the design: records drawn without replacement, one direction each."""
    rng = np.random.default_rng(settings["seed"])
    count = min(settings["motions"], len(names))
    chosen = sorted(rng.choice(len(names), count, replace=False))
    return {names[i]: str(rng.choice(list(directions))) for i in chosen}
