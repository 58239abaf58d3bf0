"""What the tests with a known outcome teach: measures of intensity, and where errors sit.

A measure is held against fell or stood by logistic regression on its logarithm, of which each
motion is foretold by the others alone.
"""

import math

import numpy as np
import pandas as pd
from rocking.records.intensity_measures import incremental_velocity
from scipy.optimize import minimize
from scipy.signal import lfilter

from studies.overturning import table
from studies.overturning.score import CERTAIN, joined, known
from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2

FLAT = 1e-3  # weight of the square of the slope: finite where a measure parts all tests
LIFTS_M_S2 = 0.1 * STANDARD_GRAVITY_M_S2
PASS_HZ = 0.2  # slower than that a velocity is drift of the sensor


def of_motion(samples):
    """Measures of a test's table motion.

    pga_g, pgv_m_s; miv_m_s, the largest change of velocity of one sign; strong_s, from the first to
    the last acceleration beyond 0.1 g; vsi_m, the integral of the velocity √(ẏ²) of oscillators of
    5 % over periods of 0.1 to 2.5 s (Housner's intensity); cav_m_s, ∫|a| dt.
    """
    a, dt = table.acceleration(samples), table.STEP_S
    pole = math.exp(-2.0 * math.pi * PASS_HZ * dt)
    velocity = lfilter([dt], [1.0, -pole], a)
    beyond = np.flatnonzero(np.abs(a) > LIFTS_M_S2)
    spectrum = [_pseudo_velocity(a, dt, period) for period in np.arange(0.1, 2.51, 0.1)]
    return {
        "pga_g": float(np.abs(a).max()) / STANDARD_GRAVITY_M_S2,
        "pgv_m_s": float(np.abs(velocity).max()),
        "miv_m_s": incremental_velocity(a, dt),
        "strong_s": dt * float(np.ptp(beyond)) if beyond.size else 0.0,
        "vsi_m": 0.1 * float(np.sum(spectrum)),
        "cav_m_s": dt * float(np.abs(a).sum()),
    }


def _pseudo_velocity(a, dt, period_s, damping=0.05):
    """Spectral displacement times ω, by the exact recursion for accelerations held over a step."""
    omega = 2.0 * math.pi / period_s
    damped = omega * math.sqrt(1.0 - damping**2)
    decay = math.exp(-damping * omega * dt)
    c, s = decay * math.cos(damped * dt), decay * math.sin(damped * dt)
    ratio = damping / math.sqrt(1.0 - damping**2)
    # x(k+1) = 2c x(k) − decay² x(k−1) − g1 a(k) − g0 a(k−1)
    g1 = (1.0 - c - ratio * s) / omega**2
    g0 = (decay**2 - c + ratio * s) / omega**2
    x = lfilter([0.0, -g1, -g0], [1.0, -2.0 * c, decay**2], a)
    return omega * float(np.abs(x).max())


def of_tests(folder):
    """Table of the measures by test."""
    with table.archive(folder, table.MOTIONS) as stored:
        rows = {int(name[1:]): of_motion(stored[name]) for name in stored}
    return pd.DataFrame.from_dict(rows, orient="index").rename_axis("test")


def logistic(x, y):
    """Intercept and slope of the likeliest ln p/(1 − p) = c0 + c1 x."""
    middle, width = float(np.mean(x)), float(np.std(x)) or 1.0
    z = (np.asarray(x, float) - middle) / width

    def loss(c):
        log_odds = c[0] + c[1] * z
        value = np.logaddexp(0.0, log_odds).sum() - y @ log_odds + FLAT * c[1] ** 2
        wrong = 1.0 / (1.0 + np.exp(-log_odds)) - y
        return value, np.array([wrong.sum(), wrong @ z + 2.0 * FLAT * c[1]])

    c0, c1 = minimize(loss, [0.0, 1.0], jac=True).x
    return c0 - c1 * middle / width, c1 / width


def left_out(x, y, motion):
    """Probability of a fall of each test by the tests of the other motions."""
    p = np.zeros(len(y))
    for number in np.unique(motion):
        mine = motion == number
        c0, c1 = logistic(x[~mine], y[~mine])
        p[mine] = 1.0 / (1.0 + np.exp(-(c0 + c1 * x[mine])))
    return p


def by_measure(folder):
    """Rows by specimen and measure: correct, Brier score, and the measure at which half fall."""
    tests, measures = table.tests(folder), of_tests(folder)
    rows = []
    for specimen in (1, 2):
        y = known(tests, specimen)
        motion = tests.loc[y.index, "motion"].to_numpy()
        for name in measures:
            x = np.log(np.maximum(measures.loc[y.index, name].to_numpy(), 1e-3))
            p = left_out(x, y.to_numpy(), motion)
            c0, c1 = logistic(x, y.to_numpy())
            row = {"specimen": specimen, "measure": name, "half_fall_at": math.exp(-c0 / c1)}
            row |= {"log_deviation": 1.7 / c1}  # of the normal law nearest the logistic one
            row["correct"] = float(np.mean((p > CERTAIN) == (y.to_numpy() > 0.0)))
            rows.append(row | {"brier": float(np.mean((p - y.to_numpy()) ** 2))})
    return pd.DataFrame(rows)


def errors(folder, data, model):
    """Wrong tests and mean p − y by what tests have in common, both specimens."""
    tests = table.tests(data)
    compared = joined(folder, tests, model).merge(of_tests(data), left_on="test", right_index=True)
    compared["wrong"] = (compared["probability_of_fall"] > CERTAIN) != (compared["y"] > 0.0)
    compared["bias"] = compared["probability_of_fall"] - compared["y"]
    rows = []
    for name in ("pga_g", "pgv_m_s", "strong_s"):
        group = pd.qcut(compared[name], 4)
        for span, quarter in compared.groupby(group, observed=True):
            row = {"by": name, "from": span.left, "to": span.right, "tests": len(quarter)}
            row |= {"fell": int(quarter["y"].sum()), "wrong": int(quarter["wrong"].sum())}
            rows.append(row | {"mean p - y": quarter["bias"].mean()})
    return pd.DataFrame(rows)
