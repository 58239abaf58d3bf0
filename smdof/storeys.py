"""Storeys that yield: shear force against drift, with memory, of many histories side by side.

A storey's backbone is elastic up to its yield strength V_y at u_y = V_y/k, then has the stiffness
α k. Beyond a drift its strength falls in a straight line to a share of it. What it does between
peaks is its law:

elastic
    V = k u, whatever the drift.
bilinear
    Kinematic hardening: V = α k u + (1 − α) k w, the elastic part w of the drift within ±u_y.
peak_oriented
    Clough and Johnston (1966): unloads with k (u_y/u_m)^γ, u_m the largest drift so far to that
    side, and loads again from where it crossed V = 0 straight to the other side's largest drift.
origin_oriented
    Loads and unloads along the line from the origin to the largest drift of that side: no energy
    is spent in a repeated cycle.
flag
    Of a rocking pier: a share b of the bilinear law beside 1 − b of its backbone as a spring
    without memory. It comes back to where it stood for b up to a half, and spends b times as much.
"""

import math
from dataclasses import dataclass

import numpy as np
import scipy

from .oscillator import checked_motion, refine_linear, step_integrals

LAWS = ("elastic", "bilinear", "peak_oriented", "origin_oriented", "flag")


@dataclass(frozen=True)
class Storeys:
    """How the storeys of a chain yield.

    Parameters
    ----------
    law : str
        One of `LAWS`.
    yield_n : tuple of n floats
        Strength of each storey V_y, from the bottom up [N]; see `strengths`.
    hardening : float
        α, stiffness beyond yield over the elastic one.
    unloading : float
        γ of the peak-oriented law.
    flag_share : float
        b of the law "flag".
    loss_drift_m, lost_drift_m : float
        Drift from which strength falls and at which it has fallen [m]; infinite: never.
    residual : float
        Share of the strength that is left then.

    Raises
    ------
    ValueError
        If the law is unknown or a value is not physical; the message names it.
    """

    law: str
    yield_n: tuple
    hardening: float = 0.02
    unloading: float = 0.0
    flag_share: float = 0.3
    loss_drift_m: float = math.inf
    lost_drift_m: float = math.inf
    residual: float = 0.2

    def __post_init__(self):
        """Check values."""
        if self.law not in LAWS:
            raise ValueError(f"law: expected one of {', '.join(LAWS)}, got '{self.law}'")
        if not self.yield_n or not all(v > 0.0 for v in self.yield_n):
            raise ValueError(f"yield_n: expected positive strengths, got {self.yield_n}")
        within = (
            ("hardening", 0.0, 1.0),
            ("unloading", 0.0, 1.0),
            ("flag_share", 0.0, 0.5),
            ("residual", 0.0, 1.0),
        )
        for name, low, high in within:
            if not low <= getattr(self, name) <= high:
                raise ValueError(f"{name}: expected {low:g} to {high:g}, got {getattr(self, name)}")
        if not 0.0 < self.loss_drift_m <= self.lost_drift_m:
            raise ValueError(
                "loss_drift_m, lost_drift_m: expected two ascending drifts above 0, got "
                f"{self.loss_drift_m}, {self.lost_drift_m}"
            )


def strengths(coefficient, weight_n, height_m):
    """Strength of each storey from a base-shear coefficient.

    V_y,i = (V/W) W Σ_{j ≥ i} W_j z_j / Σ_j W_j z_j: horizontal forces in proportion to weight and
    height, the linear static analysis of NTC 2018 (eq. 7.3.7) and EN 1998-1 (eq. 4.11).

    Parameters
    ----------
    coefficient : float
        V/W, base shear at yield over the weight.
    weight_n, height_m : array_like, shape (n,)
        Of the floors, from the bottom up; heights above the ground.

    Returns
    -------
    tuple of n floats
        From the bottom up [N].

    Raises
    ------
    ValueError
        If the coefficient is not positive, or the heights do not ascend.
    """
    weight, height = np.asarray(weight_n, float), np.asarray(height_m, float)
    if not coefficient > 0.0:
        raise ValueError(f"coefficient: expected V/W above 0, got {coefficient}")
    if weight.shape != height.shape or np.any(np.diff(height, prepend=0.0) <= 0.0):
        raise ValueError(f"height_m: expected ascending heights, one a weight, got {height_m}")
    above = np.cumsum((weight * height)[::-1])[::-1] / np.sum(weight * height)
    return tuple(float(v) for v in coefficient * weight.sum() * above)


class Response:
    """Shear forces of storeys that are moved step by step; arrays of shape (histories, n).

    `drift_m` and `shear_n` are those of now, `peak_m` (2, histories, n) the largest drift so far
    outward and inward (≥ 0), `spent_j` the energy that the hysteresis has taken: the work of the
    shear force less what is stored elastically, V²/(2 k).
    """

    def __init__(self, storeys, stiffness_n_m, histories):
        """Storeys at rest."""
        self.storeys = storeys
        self.k = np.asarray(stiffness_n_m, float)
        self.v_y = np.asarray(storeys.yield_n, float)
        if self.k.shape != self.v_y.shape:
            raise ValueError(
                f"yield_n: expected one strength a storey, got {self.v_y.size} for {self.k.size}"
            )
        self.u_y = self.v_y / self.k
        shape = (histories, self.k.size)
        self.drift_m, self.shear_n, self.work_j = np.zeros(shape), np.zeros(shape), np.zeros(shape)
        self.peak_m = np.zeros((2, *shape))
        self.plastic_m = np.zeros(shape)  # of the bilinear law: where its elastic part is at rest
        self.crossed_m = np.zeros(shape)  # of the peak-oriented law: where it last crossed V = 0

    @property
    def spent_j(self):
        """Energy that the hysteresis has taken [J]."""
        return self.work_j - 0.5 * self.shear_n**2 / self.k

    def backbone(self, drift_m):
        """Shear of the first loading to a drift ≥ 0 [N]; strength falls beyond `loss_drift_m`."""
        s = self.storeys
        force = np.where(
            drift_m < self.u_y,
            self.k * drift_m,
            self.v_y + s.hardening * self.k * (drift_m - self.u_y),
        )
        return force * self.left(drift_m)

    def left(self, drift_m):
        """Share of the strength that is left once a drift ≥ 0 has been reached."""
        s = self.storeys
        if math.isinf(s.loss_drift_m):
            return 1.0
        span = max(s.lost_drift_m - s.loss_drift_m, 1e-12)
        gone = np.clip((drift_m - s.loss_drift_m) / span, 0.0, 1.0)
        return 1.0 - (1.0 - s.residual) * gone

    def move(self, drift_m):
        """Move all storeys to a drift [m]; return their shear force [N], opposing the drift."""
        before, was = self.drift_m, self.shear_n
        self.peak_m[0] = np.maximum(self.peak_m[0], drift_m)
        self.peak_m[1] = np.maximum(self.peak_m[1], -drift_m)
        self.shear_n = getattr(self, f"_{self.storeys.law}")(drift_m, drift_m - before)
        self.work_j = self.work_j + 0.5 * (was + self.shear_n) * (drift_m - before)
        self.drift_m = drift_m
        return self.shear_n

    def _elastic(self, u, du):
        return self.k * u

    def _bilinear(self, u, du):
        alpha = self.storeys.hardening
        elastic = np.clip(u - self.plastic_m, -self.u_y, self.u_y)
        self.plastic_m = u - elastic
        left = self.left(np.maximum(self.peak_m[0], self.peak_m[1]))
        return left * self.k * (alpha * u + (1.0 - alpha) * elastic)

    def _flag(self, u, du):
        share = self.storeys.flag_share
        spring = np.sign(u) * self.backbone(np.abs(u))
        if not math.isinf(self.storeys.loss_drift_m):  # what was lost does not come back
            worst = self.left(np.maximum(self.peak_m[0], self.peak_m[1]))
            spring = spring / self.left(np.abs(u)) * worst
        return share * self._bilinear(u, du) + (1.0 - share) * spring

    def _origin_oriented(self, u, du):
        peak = np.maximum(np.where(u >= 0.0, *self.peak_m), self.u_y)
        return u * self.backbone(peak) / peak

    def _peak_oriented(self, u, du):
        out, inward = np.maximum(self.peak_m, self.u_y)
        held = np.where(self.shear_n >= 0.0, out, inward)  # the side that is unloaded
        unload = self.k * (self.u_y / held) ** self.storeys.unloading
        trial = self.shear_n + unload * du
        crosses = (trial * self.shear_n < 0.0) | ((self.shear_n == 0.0) & (trial != 0.0))
        zero = self.drift_m - self.shear_n / unload
        self.crossed_m = np.where(crosses, zero, self.crossed_m)
        side = np.where(trial >= 0.0, 1.0, -1.0)
        along, start = side * u, side * self.crossed_m
        peak = np.where(side > 0.0, out, inward)
        span = np.maximum(peak - start, 1e-3 * self.u_y)
        line = self.backbone(peak) * np.clip((along - start) / span, 0.0, 1.0)
        most = np.where(along >= peak, self.backbone(np.maximum(along, 0.0)), line)
        return side * np.minimum(np.abs(trial), most)


@dataclass(frozen=True)
class YieldingMotions:
    """Response of a chain that yields, one history a factor.

    Attributes
    ----------
    time_s : ndarray, shape (nt,)
    ground_m_s2 : ndarray, shape (nt,)
        Before the factors.
    floors_m_s2 : ndarray, shape (histories, n, nt)
        Absolute accelerations, bottom to top.
    drift_m : ndarray, shape (histories, n)
        Largest drift of each storey, without sign.
    energy_j : dict of ndarrays, shape (histories,)
        input, stored (kinetic and elastic at the end), viscous, hysteretic: input = the others.
    """

    time_s: np.ndarray
    ground_m_s2: np.ndarray
    floors_m_s2: np.ndarray
    drift_m: np.ndarray
    energy_j: dict


STEPS_PER_PERIOD = 40  # of the shortest elastic period: its period is 0.4 % off, T1 by 1e-4 or less


def yielding_motions(
    ground_m_s2,
    dt_s,
    chain,
    storeys,
    factors,
    damping_ratio=0.05,
    steps_per_period=STEPS_PER_PERIOD,
    every=1,
):
    """Floor accelerations of a chain whose storeys yield, at several amplitudes side by side.

    M ü + C u̇ + K u = −M 1 a_g + Bᵀ r, with B u the drifts and r = K B u − V what yielding takes off
    the elastic shear. The modes move exactly under loads that are straight within a step (Nigam and
    Jennings, 1969); over a step r goes on as it did over the last one (exponential Adams–Bashforth
    of second order; Cox and Matthews, 2002, J. Comput. Phys. 176, eq. 13). So a chain that rests
    beside where it stood rests, and one that does not yield is exact. C is that of the elastic
    chain, a ratio in every mode.

    Parameters
    ----------
    ground_m_s2 : array_like, shape (nt,)
        Straight between samples.
    dt_s : float
    chain : Chain
    storeys : Storeys
    factors : array_like, shape (histories,)
        On the ground motion, with sign.
    damping_ratio : float
    steps_per_period : int
        Steps in the shortest period of the elastic chain, at least 8.
    every : int
        Every so many steps a sample is kept.

    Returns
    -------
    YieldingMotions

    Raises
    ------
    ValueError
        If the motion, the chain, the storeys or a number is unusable.
    """
    ground = checked_motion(ground_m_s2, dt_s)
    if steps_per_period < 8 or every < 1:
        raise ValueError(f"steps_per_period: expected at least 8, got {steps_per_period}")
    factors = np.atleast_1d(np.asarray(factors, float))
    shortest = float(chain.periods_s()[-1])
    parts = max(1, math.ceil(dt_s * steps_per_period / shortest - 1e-9))
    ground = refine_linear(ground, parts)
    h = dt_s / parts
    modes = _Modes(chain, chain.damping_ratios(damping_ratio), h)
    storeys_of = Response(storeys, chain.stiffness_n_m, factors.size)
    floors, drift, energy = _marched(ground, h, modes, storeys_of, factors, every)
    time = h * np.arange(0, ground.size, every)
    return YieldingMotions(time, ground[::every], floors, drift, energy)


def _marched(ground, h, modes, storeys_of, factors, every):
    """Floor accelerations, largest drifts and energies of histories, in steps of h [s]."""
    shape = factors.size, modes.shape.shape[0]
    floors = np.zeros((*shape, len(range(0, ground.size, every))))
    place = np.zeros(shape)
    speed, drift, pushed = place.copy(), place.copy(), place.copy()
    spent = np.zeros((2, factors.size))
    for i, a_g in enumerate(ground):
        moved = place @ modes.drift.T
        less = storeys_of.k * moved - storeys_of.move(moved)
        whole = storeys_of.peak_m.max(axis=0) <= storeys_of.u_y  # nothing but rounding
        push = np.where(whole, 0.0, less) @ modes.drift  # on each mode
        viscous = modes.damping * speed
        inertia = -modes.gamma * (factors * a_g)[:, None]
        weight = h * (0.5 if i in (0, ground.size - 1) else 1.0)
        spent[0] += weight * np.sum(inertia * speed, axis=1)
        spent[1] += weight * np.sum(viscous * speed, axis=1)
        if i % every == 0:
            floors[:, :, i // every] = -(viscous + modes.square * place - push) @ modes.shape.T
        np.maximum(drift, np.abs(storeys_of.drift_m), out=drift)
        if i + 1 < ground.size:
            ahead = 2.0 * push - pushed
            after = -modes.gamma * (factors * ground[i + 1])[:, None]
            place, speed = modes.moved(place, speed, inertia + push, after + ahead)
            pushed = push
    energy = {
        "input": spent[0],
        "viscous": spent[1],
        "hysteretic": storeys_of.spent_j.sum(axis=1),
        "stored": 0.5 * np.sum(speed**2, axis=1)
        + np.sum(0.5 * storeys_of.shear_n**2 / storeys_of.k, axis=1),
    }
    return floors, drift, energy


class _Modes:
    """Modes of a chain, φᵀMφ = 1, and their exact flow over a step under a straight ground motion.

    `shape` φ (floors, modes), `drift` Bφ (storeys, modes), `gamma` φᵀM1, `damping` 2ζω, `square`
    ω².
    """

    def __init__(self, chain, ratios, step_s):
        mass, stiffness = chain.matrices()
        values, self.shape = scipy.linalg.eigh(stiffness, mass)
        omega = np.sqrt(values)
        self.drift = np.diff(self.shape, axis=0, prepend=0.0)
        self.gamma = self.shape.T @ np.diag(mass)
        self.damping, self.square = 2.0 * ratios * omega, values
        self.decay, self.swing = ratios * omega, omega * np.sqrt(1.0 - ratios**2)
        pole = -self.decay + 1j * self.swing
        self.turn = np.exp(pole * step_s)
        loads = [step_integrals(one, step_s) for one in pole]
        self.old, self.new = np.array(loads).T

    def moved(self, place, speed, before, after):
        """Place and speed of each mode a step on; z = q̇ − λ̄q obeys ż = λz + f."""
        z = speed + self.decay * place + 1j * self.swing * place
        z = self.turn * z + self.old * before + self.new * after
        q = z.imag / self.swing
        return q, z.real - self.decay * q
