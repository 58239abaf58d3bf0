"""Restitution of a rocking history: impacts, rebounds, e_exp of eq. 4, and what it should be.

Rotations are relative to the rest position and positive outward. One-sided rocking
lives at θ > 0; θ ≤ 0 is contact with the return walls. Two-sided rocking counts
the excursions on both sides.
"""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from rocking.mechanics import closed_forms

IMPACTS = 3  # of the study's criterion
SMALLEST = 1e-4  # θ/α below which a rebound is rattling on the contacts, not rocking
# e_exp over |e_1SR| on the first three impacts (Sorrentino et al., 2011, as used by the study)
TARGETS = ((0.64, 0.72), (0.74, 0.86), (1.0, 1.0))


@dataclass(frozen=True)
class Rebounds:
    """Impacts of a history and the rotation reached after each.

    The release is |θ0|/α, the first maximum; impacts are when θ = 0 was passed, by linear
    interpolation; peaks are the maximum |θn|/α after each, with its time.
    """

    release: float
    impact_time_s: np.ndarray
    peak_time_s: np.ndarray
    peak: np.ndarray

    def __len__(self):
        """Return the number of impacts that were followed by a rebound."""
        return len(self.peak)


def _vertex(time, value, i):
    """Time and height of the parabola through sample i and its neighbours."""
    if i == 0 or i == len(value) - 1:
        return time[i], value[i]
    (t0, t1, t2), (y0, y1, y2) = time[i - 1 : i + 2], value[i - 1 : i + 2]
    left, right = (y1 - y0) / (t1 - t0), (y2 - y1) / (t2 - t1)
    curvature = (right - left) / (t2 - t0)
    if curvature >= 0.0:
        return t1, y1
    middle = 0.5 * (t0 + t1) - 0.5 * left / curvature
    return middle, y1 + (middle - t1) * (left + curvature * (middle - t0))


def rebounds(time_s, theta_over_alpha, *, sides="one", smallest=SMALLEST):
    """Find the impacts of a free-rocking history and the rebound after each.

    An excursion is a run of samples of θ > 0 (two-sided: of one sign). An impact lies between two
    excursions that both reach `smallest`, of |θ|/α; lower ones belong to the impact, being the
    contact's own rattling. The last excursion counts only if its maximum has been passed: a history
    that ends while still rising has no rebound there. A ValueError for one that is too short (3
    samples), not finite, not ascending in time, or does not start from a released position.
    """
    t, theta = np.asarray(time_s, float), np.asarray(theta_over_alpha, float)
    if sides not in ("one", "two"):
        raise ValueError(f"sides: expected 'one' or 'two', got '{sides}'")
    if t.shape != theta.shape or t.ndim != 1 or len(t) < 3:
        raise ValueError("history: expected time and rotation of equal length, at least 3 samples")
    if not (np.all(np.isfinite(t)) and np.all(np.isfinite(theta))):
        raise ValueError("history: expected finite times and rotations")
    if np.any(np.diff(t) <= 0.0):
        raise ValueError("history: expected ascending times")
    if not abs(theta[0]) >= smallest or (sides == "one" and theta[0] < 0.0):
        raise ValueError(f"history: expected a release at |θ|/α ≥ {smallest}, got {theta[0]:.3g}")
    sign = np.sign(theta)
    edges = np.flatnonzero(sign[1:] != sign[:-1]) + 1
    runs = np.split(np.arange(len(t)), edges)
    excursions = []
    for run in runs:
        outward = sign[run[0]] > 0 or (sides == "two" and sign[run[0]] < 0)
        top = run[np.argmax(np.abs(theta[run]))]
        if not outward or abs(theta[top]) < smallest:
            continue
        if top == len(t) - 1:
            break
        excursions.append((*_vertex(t, np.abs(theta), top), run))
    if not excursions:
        return Rebounds(float(abs(theta[0])), np.zeros(0), np.zeros(0), np.zeros(0))
    last_positive = [entry[2][-1] for entry in excursions[:-1]]
    impacts = [
        t[i] + (t[i + 1] - t[i]) * theta[i] / (theta[i] - theta[i + 1]) for i in last_positive
    ]
    return Rebounds(
        release=float(excursions[0][1]),
        impact_time_s=np.array(impacts, float),
        peak_time_s=np.array([entry[0] for entry in excursions[1:]], float),
        peak=np.array([entry[1] for entry in excursions[1:]], float),
    )


def e_exp(observed):
    """Experimental restitution after the first `IMPACTS` (eq. 4); nan where there was no impact.

    e_n = {[1 − (1 − |θn|/α)²]/[1 − (1 − |θ0|/α)²]}^{1/2n}
    """
    out = np.full(IMPACTS, np.nan)
    n = np.arange(1, min(IMPACTS, len(observed)) + 1)
    out[: len(n)] = closed_forms.restitution_observed(observed.peak[: len(n)], observed.release, n)
    return out


def misfit(e_measured, e_target, targets=TARGETS):
    """Root mean square distance of e_exp/e_target, shape (..., n), from the criterion's n ranges.

    Zero when every impact lies in its range; nan when an impact is missing, for then there is
    nothing to compare. e_target is |e_1SR|, of which the ranges are fractions.
    """
    low, high = np.transpose(np.asarray(targets, float))
    ratio = np.asarray(e_measured, float) / e_target
    distance = np.maximum(np.maximum(low - ratio, ratio - high), 0.0)
    distance = np.where(np.isnan(ratio), np.nan, distance)
    return np.sqrt(np.mean(distance**2, axis=-1))


def e_one_sided(h_m, b_m):
    """|e_1SR| of a wall (eq. 3 in magnitude)."""
    return abs(float(closed_forms.restitution_one_sided(closed_forms.block(h_m, b_m).alpha_rad)))


def read_archive(path):
    """Histories that the study `walls` wrote in YADE, with what the archive says of each.

    That is id, status, reason, dt_s, steps, …, and the columns time_s, d_m and theta_over_alpha.
    """
    with np.load(Path(path), allow_pickle=False) as data:
        runs = json.loads(str(data["runs"]))
        ends = np.cumsum(data["length"])[:-1]
        columns = {
            key: np.split(data[key], ends) for key in data.files if key not in ("runs", "length")
        }
    return [
        {**run, **{key: parts[i] for key, parts in columns.items()}} for i, run in enumerate(runs)
    ]
