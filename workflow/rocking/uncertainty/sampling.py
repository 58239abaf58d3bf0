"""Space-filling samples of the uncertain parameters, and scene files that have them."""

import copy
import math

import numpy as np
import pandas as pd
from scipy.special import ndtri

MEDIAN = 0  # number of the sample in which every factor is 1
PLACES = {  # dotted key of a scene file, for parameters that are one value of it
    "e_mpa": "facade.e_mpa",
    "density_kg_m3": "facade.density_kg_m3",
    "thickness_m": "facade.thickness_m",
    "period_s": "smdof.period_s",
    "damping_ratio": "smdof.damping_ratio",
}


def scores(settings):
    """Standardised values of a sample, mean 0 and standard deviation 1, without the medians' row.

    Parameters
    ----------
    settings : dict
        Section uncertainty: samples, sampling, seed, parameters.

    Returns
    -------
    ndarray, shape (samples, parameters)

    Raises
    ------
    ValueError
        One line for fewer points than two for every slope, or Sobol' points that are no power of
        two.
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
    """Factor on every parameter by sample; row MEDIAN has ones.

    exp(σ z) for a lognormal one, 1 + r z/√3 for a uniform one, with z the score and σ or r the
    spread.

    Returns
    -------
    DataFrame
        One column a parameter.
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


def varied(job, factor):
    """A scene file with the parameters times their factors.

    Friction is the coefficient tan φ of base and back joints; a length of return wall that is null
    is h/2 before it is multiplied.

    Parameters
    ----------
    job : dict
        A scene file.
    factor : mapping of str to float
    """
    new = copy.deepcopy(job)
    for name, value in factor.items():
        if name == "beta_s":
            new["beta_s"] *= value
        elif name == "friction":
            for section in ("facade", "return_wall"):
                tangent = value * math.tan(math.radians(new[section]["friction_deg"]))
                new[section]["friction_deg"] = math.degrees(math.atan(tangent))
        elif name == "length_m":
            length = job["return_wall"]["length_m"] or 0.5 * job["facade"]["height_m"]
            new["return_wall"]["length_m"] = value * length
        else:
            section, key = PLACES[name].split(".")
            new[section][key] *= value
    return new


def motions(names, directions, settings):
    """Records and directions of the design: drawn without replacement, one direction each.

    Parameters
    ----------
    names : sequence of str
        Records that may be drawn.
    directions : sequence of str
    settings : dict
        motions, seed.

    Returns
    -------
    dict of str to str
        Direction by record, in the order of `names`.
    """
    rng = np.random.default_rng(settings["seed"])
    count = min(settings["motions"], len(names))
    chosen = sorted(rng.choice(len(names), count, replace=False))
    return {names[i]: str(rng.choice(list(directions))) for i in chosen}
