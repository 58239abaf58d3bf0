"""Parts of the scatter of collapse: motion, material, model form, and what is numerical.

On a crossed design of motions r, points t of the sample and models m the logarithm of the collapse
intensity is split as

    y_rtm = μ + f_r + f_t + f_m + f_rt + f_rm + f_tm + f_rtm + e,

every term with mean zero over each of its own indices (Hoeffding's decomposition; Efron and Stein,
1981, Ann. Stat. 9, 586). Motions and points are draws from many, the models are all there are and
equally probable. By the law of total variance the parts add up to the whole. They are estimated
without bias from mean squares; e, the scatter of histories near collapse, from cells run twice.
"""

import numpy as np
import pandas as pd
from scipy.stats import t as student

MAIN = ("motion", "material", "model")
MIXED = ("motion x material", "motion x model", "material x model", "all three")
PARTS = (*MAIN, *MIXED, "numerical")


def two_way(table):
    """Mean, and variances by row, by column and of the rest, of a crossed table without repeats.

    E[MS_row] = rest + columns·V_row, and likewise for the columns (Scheffé, 1959, section 7.4).
    """
    rows, columns = table.shape
    mean = table.mean()
    row, column = table.mean(axis=1), table.mean(axis=0)
    left = table - row[:, None] - column[None, :] + mean
    rest = (left**2).sum() / ((rows - 1) * (columns - 1))
    by_row = np.var(row, ddof=1) - rest / columns
    by_column = np.var(column, ddof=1) - rest / rows
    return mean, by_row, by_column, rest


def components(y, numerical=0.0):
    """Variances of `PARTS`; they may be negative by chance where a part is nothing.

    `y` are logarithms of collapse intensities, shape (motions, points, models), `numerical` the
    variance of e.
    """
    motions, points, models = y.shape
    middle = y.mean(axis=2)
    _, motion, material, mixed = two_way(middle)
    by_model = [two_way(y[:, :, m] - middle) for m in range(models)]
    mean, by_motion, by_point, rest = (np.array(part) for part in zip(*by_model, strict=True))
    bias = by_motion / motions + by_point / points + rest / (motions * points)
    return {
        "motion": motion,
        "material": material,
        "model": np.mean(mean**2 - bias) if models > 1 else 0.0,
        "motion x material": mixed - numerical / models,
        "motion x model": by_motion.mean(),
        "material x model": by_point.mean(),
        "all three": rest.mean() - numerical * (1.0 - 1.0 / models),
        "numerical": numerical,
    }


def cube(table):
    """Logarithms of collapse, shape (motions, points, models), and complete motions and models.

    A motion under which some cell never collapsed is left out, and so is the medians' row.
    """
    mine = table[(table["replicate"] == 0) & (table["sample"] > 0)]
    wide = mine.pivot(index="record", columns=["sample", "model"], values="pga_median_g").dropna()
    models = list(dict.fromkeys(mine["model"]))
    points = sorted(set(mine["sample"]))
    y = np.stack([wide.xs(m, axis=1, level="model")[points].to_numpy() for m in models], axis=2)
    return np.log(y), list(wide.index), models


def numerical_variance(table):
    """Variance of e: half the mean square of what two runs of one cell differ by."""
    wide = table.pivot(
        index=["record", "sample", "model"], columns="replicate", values="pga_median_g"
    )
    return float(0.5 * np.mean(np.log(wide[1] / wide[0]).dropna() ** 2))


def interval(statistic, shape, confidence):
    """A statistic, of indices of motions and of points, with the ends of its interval.

    By leaving out one motion, then one point, at a time: the two jackknife variances add up, which
    errs to the wide side (Owen, 2007, Ann. Appl. Stat. 1, 386); Student's t with the smaller number
    of degrees of freedom. `shape` is (motions, points).
    """
    every = [np.arange(n) for n in shape[:2]]
    best, variance = statistic(*every), 0.0
    for axis, members in enumerate(every):
        without = [[np.delete(members, i), every[1 - axis]][:: 1 - 2 * axis] for i in members]
        values = np.array([statistic(*indices) for indices in without])
        spread = ((values - values.mean(axis=0)) ** 2).sum(axis=0)
        variance = variance + (members.size - 1) / members.size * spread
    half = student.ppf(0.5 + 0.5 * confidence, min(shape[:2]) - 1) * np.sqrt(variance)
    return best, best - half, best + half


def table_of_parts(y, numerical, confidence):
    """Dispersion and share of every part, and of the whole, with intervals (`interval`).

    part, beta, beta_low, beta_high, share, share_low, share_high; the last row is the total.
    """

    def variances(motions, points):
        of_parts = np.maximum(list(components(y[np.ix_(motions, points)], numerical).values()), 0.0)
        whole = of_parts.sum()
        return np.concatenate([of_parts, [whole], of_parts / whole, [1.0]])

    ends = [np.maximum(v, 0.0).reshape(2, -1) for v in interval(variances, y.shape, confidence)]
    ends = [(np.sqrt(variance), np.minimum(share, 1.0)) for variance, share in ends]
    return pd.DataFrame({"part": [*PARTS, "total"], **_with_ends(("beta", "share"), ends)})


def _with_ends(names, ends):
    """Columns of values and of the ends of their intervals (`interval`), by name."""
    return {
        name + ending: values[k]
        for k, name in enumerate(names)
        for ending, values in zip(("", "_low", "_high"), ends, strict=True)
    }


def first_order(scores, y):
    """Slopes of the mean over motions on the scores, first-order indices, and adjusted R².

    ln C = c_0 + Σ c_i z_i + rest with standardised, independent z, shape (points, parameters), and
    y of shape (motions, points); Sobol's first-order index of a linear answer is c_i²/V. The error
    of c_i is taken off its square, so an idle parameter has an index of zero on average.
    """
    answer = y.mean(axis=0)
    a = np.column_stack([np.ones(len(scores)), scores])
    inverse = np.linalg.pinv(a.T @ a)
    c = inverse @ a.T @ answer
    left = answer - a @ c
    freedom = max(len(answer) - a.shape[1], 1)
    noise = float(left @ left) / freedom
    total = np.var(answer, ddof=1)
    slope, error = c[1:], noise * np.diag(inverse)[1:]
    return slope, (slope**2 - error) / total, 1.0 - noise / total


def sensitivities(scores, y, confidence):
    """`first_order` with intervals (`interval`), by parameter.

    slope, slope_low, slope_high, index, index_low, index_high, r_squared.
    """

    def both(motions, points):
        return np.stack(first_order(scores[points], y[np.ix_(motions, points)])[:2])

    columns = _with_ends(("slope", "index"), interval(both, y.shape, confidence))
    return pd.DataFrame(columns).assign(r_squared=first_order(scores, y)[2])
