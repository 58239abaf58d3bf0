"""Storeys of the chain that yield: their strengths, their law, and the floors at an amplitude.

A storey's shear force is V = k u − r with u its drift, and r what the yielding takes off the
elastic force, nothing until its largest drift exceeds u_y = V_y/k. Beyond it the backbone has the
stiffness α k; beyond a further drift its strength falls in a straight line to a share of it. What a
storey does between peaks is its law:

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

Here one history marches number by number, so that YADE's own Python needs no compiler. The compiled
solver has the laws for histories side by side, written apart.

A chain that yields is M ü + C u̇ + K u = −M 1 a_g + Bᵀ r with B u the drifts. Its modes move exactly
under loads that are straight within a step, and over a step r goes on as it did over the last one
(exponential Adams–Bashforth of second order; Cox and Matthews, 2002, J. Comput. Phys. 176, eq. 13).
So a chain that has not yielded is the elastic one, and one that rests beside where it stood rests:
its accelerations integrate to where it is.
"""

import math
from typing import NamedTuple

import numpy as np

from yade_scripts.model.bars import Floor
from yade_scripts.model.chain import chain_matrices, yields
from yade_scripts.model.facades import Facade
from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2

LAWS = ("bilinear", "peak_oriented", "origin_oriented", "flag")
BILINEAR, PEAK_ORIENTED, ORIGIN_ORIENTED, FLAG = range(4)
NEVER_M = 1e9  # a drift that no storey reaches
DRIFT, SHEAR, OUT, INWARD, PLACE, WORK, MEMORY = range(7)  # what a storey remembers, in a state
LEAST_SPAN = 1e-3  # of u_y: from where a peak-oriented storey crossed zero to its peak


class StoreyRules(NamedTuple):
    """Storeys from the bottom up; lengths in metres of drift."""

    law: int  # place in `LAWS`
    k_n_m: np.ndarray  # (n,) none: nothing yields
    yield_m: np.ndarray  # (n,)
    hardening: float
    unloading: float
    share: float  # of the bilinear law; the rest is a spring without memory
    loss_m: float  # from which strength falls
    fade_1_m: float  # one over the drift over which it falls
    residual: float  # share that is left


NO_STOREYS = StoreyRules(0, np.zeros(0), np.zeros(0), 0.0, 0.0, 1.0, NEVER_M, 0.0, 1.0)


def storey_height(case):
    """Height of a storey of the chain, from one mass to the next [m]."""
    return Facade.of(case["facade"]).building_top_m / case["smdof"]["n_dof"]


def storeys_of(case, mass_kg=1.0):
    """`StoreyRules` of a case whose chain has that mass in all, see `rules_of`."""
    return rules_of(case["smdof"], storey_height(case), mass_kg)


def rules_of(chain, height_m, mass_kg):
    """`StoreyRules` of section smdof, its storeys so high; `NO_STOREYS` where it is elastic.

    V_y,i = (V/W) W Σ_{j ≥ i} z_j / Σ_j z_j for equal masses at heights z_j: the horizontal forces
    of the linear static analysis (NTC 2018 eq. 7.3.7, EN 1998-1 eq. 4.11).
    """
    if not yields(chain):
        return NO_STOREYS
    n = chain["n_dof"]
    _, stiffness, _ = chain_matrices(chain, mass_kg)
    k = np.full(n, float(stiffness[-1, -1]))
    z = np.arange(1.0, n + 1.0)
    above = np.cumsum(z[::-1])[::-1] / z.sum()
    strength = chain["base_shear_ratio"] * mass_kg * STANDARD_GRAVITY_M_S2 * above
    law = LAWS.index(chain["loops"])
    loss, lost = chain["loss_drift_ratio"], chain["lost_drift_ratio"]
    falls = loss is not None
    return StoreyRules(
        law,
        k,
        strength / k,
        float(chain["hardening"]),
        float(chain["unloading"]),
        float(chain["flag_share"]) if law == FLAG else 1.0,
        loss * height_m if falls else NEVER_M,
        1.0 / max((lost - loss) * height_m, 1e-12) if falls else 0.0,
        float(chain["residual"]) if falls else 1.0,
    )


def sliders(chain, storey_m, mass_kg, masses, heights_m):
    """What yields of the storeys between masses of a scene: bilinear loops, as `bars.Floor`.

    `chain` is section smdof, its storeys `storey_m` high. A storey is a spring α k
    (`chain.chain_links`) and beside it one of (1 − α) k that slides at (1 − α) V_y. `masses` are
    indices of blocks from the lowest up; block 0 is the ground. None where the chain is elastic.

    Raises
    ------
    ValueError
        In one line, for other loops, and for strength that falls.
    """
    storeys = rules_of(chain, storey_m, mass_kg)
    if len(storeys.k_n_m) and not slides(chain):
        raise ValueError(
            f"smdof.loops = {LAWS[storeys.law]}, loss_drift_ratio = "
            f"{chain['loss_drift_ratio']}: expected bilinear and null, which sliders can do, where "
            "walls carry the building's mass"
        )
    soft, floors = 1.0 - storeys.hardening, []
    for i, (k, u_y) in enumerate(zip(storeys.k_n_m, storeys.yield_m, strict=True)):
        place, under = (0.0, 0.0, heights_m[i]), masses[i - 1] if i else 0
        name, slider = f"storey {i + 1}", (soft * k, soft * k * u_y)
        floors.append(Floor(name, masses[i], under, place, 0.0, *map(float, slider)))
    return floors


def slides(smdof):
    """Whether springs and sliders can stand for the storeys of section smdof."""
    if not yields(smdof):
        return True
    return smdof["loops"] == LAWS[BILINEAR] and smdof["loss_drift_ratio"] is None


def sliding(scene):
    """Indices of a scene's floors that are `sliders`: they hold no piece of the façade."""
    pieces = {scene.index(name) for name, _ in scene.watched}
    return [k for k, floor in enumerate(scene.floors) if floor.a not in pieces]


class SteppedChain(NamedTuple):
    """Modes of a chain at a step, φᵀMφ = 1, and its storeys."""

    step_s: float
    shape: np.ndarray  # (n, n) φ: floors by modes
    drift: np.ndarray  # (n, n) Bφ: storeys by modes
    damping_1_s: np.ndarray  # (n,) 2ζω
    square_1_s2: np.ndarray  # (n,) ω²
    flow: np.ndarray  # (n, 4) from place and speed to those a step later
    load: np.ndarray  # (n, 4) of a load before and after on place and speed
    inertia: np.ndarray  # (n,) load by the ground's acceleration, −φᵀM1
    storeys: StoreyRules


def chain_of(case, step_s):
    """`SteppedChain` of a case of one kilogram, at a step."""
    mass, stiffness, damping = chain_matrices(case["smdof"], 1.0)
    each_kg = mass[0, 0]
    values, vectors = np.linalg.eigh(stiffness / each_kg)
    phi = vectors / math.sqrt(each_kg)
    damping = np.diag(phi.T @ damping @ phi)
    exact = [_exact(square, rate, step_s) for square, rate in zip(values, damping, strict=True)]
    flows, loads = zip(*exact, strict=True)
    drift = np.diff(phi, axis=0, prepend=0.0)
    return SteppedChain(
        step_s,
        np.ascontiguousarray(phi),
        np.ascontiguousarray(drift),
        np.ascontiguousarray(damping),
        values,
        np.array(flows),
        np.array(loads),
        -phi.T @ np.diag(mass),
        storeys_of(case),
    )


def _exact(square, rate, step_s):
    """Flow and load of q̈ + c q̇ + ω² q = f over a step, f straight: by a matrix exponential.

    State (q, q̇, f, f's change over the step); shape (4,) each, see `SteppedChain`.
    """
    whole = np.zeros((4, 4))
    whole[0, 1], whole[1, :3], whole[2, 3] = 1.0, (-square, -rate, 1.0), 1.0 / step_s
    moved = _exponential(whole * step_s)
    flow = moved[:2, :2].ravel()
    old, change = moved[:2, 2], moved[:2, 3]
    return flow, np.array([*(old - change), *change])


def _exponential(matrix):
    """Exponential of a small matrix, by its series on a 2⁻ᵏth of it."""
    halvings = max(0, math.ceil(math.log2(max(np.abs(matrix).sum(axis=1).max(), 1e-300))) + 4)
    part = matrix / 2.0**halvings
    term = total = np.eye(len(matrix))
    for k in range(1, 16):
        term = term @ part / k
        total = total + term
    for _ in range(halvings):
        total = total @ total
    return total


class Loops:
    """What one history of storeys remembers, number by number; `less` moves a storey."""

    def __init__(self, storeys, state):
        """Storeys as a state, shape (n, MEMORY), has them."""
        self.s, self.k, self.u_y = storeys, storeys.k_n_m.tolist(), storeys.yield_m.tolist()
        rows = state.T.tolist()
        self.drift, self.shear, self.out, self.inward, self.place, self.work = rows

    @property
    def state(self):
        """What they remember, shape (n, MEMORY)."""
        rows = (self.drift, self.shear, self.out, self.inward, self.place, self.work)
        return np.array(rows).T

    def _left(self, drift):
        gone = (drift - self.s.loss_m) * self.s.fade_1_m
        return 1.0 - (1.0 - self.s.residual) * min(1.0, max(0.0, gone))

    def _backbone(self, i, drift):
        k, u_y = self.k[i], self.u_y[i]
        force = k * drift if drift < u_y else k * (u_y + self.s.hardening * (drift - u_y))
        return force * self._left(drift)

    def less(self, i, u):
        """What yielding takes off the elastic force of storey i at a drift, r = k u − V [N]."""
        self.out[i], self.inward[i] = max(self.out[i], u), max(self.inward[i], -u)
        k, u_y, worst = self.k[i], self.u_y[i], max(self.out[i], self.inward[i])
        if worst <= u_y:
            taken_n = 0.0
        elif self.s.law == PEAK_ORIENTED:
            taken_n = k * u - self._peak_oriented(i, u)
        elif self.s.law == ORIGIN_ORIENTED:
            peak = max(self.out[i] if u >= 0.0 else self.inward[i], u_y)
            secant = 1.0 - (1.0 - self.s.hardening) * (1.0 - u_y / peak)
            taken_n = k * u * (1.0 - self._left(peak) * secant)
        else:
            self.place[i] = plastic = u - min(max(u - self.place[i], -u_y), u_y)
            beyond = math.copysign(max(abs(u) - u_y, 0.0), u)
            slid = self.s.share * plastic + (1.0 - self.s.share) * beyond
            left = self._left(worst)
            taken_n = (1.0 - left) * k * u + left * (1.0 - self.s.hardening) * k * slid
        shear = k * u - taken_n
        self.work[i] += 0.5 * (self.shear[i] + shear) * (u - self.drift[i])
        self.drift[i], self.shear[i] = u, shear
        return taken_n

    def _peak_oriented(self, i, u):
        k, u_y, was = self.k[i], self.u_y[i], self.shear[i]
        out, inward = max(self.out[i], u_y), max(self.inward[i], u_y)
        unload = k * (u_y / (out if was >= 0.0 else inward)) ** self.s.unloading
        trial = was + unload * (u - self.drift[i])
        if trial * was < 0.0 or (was == 0.0 and trial != 0.0):
            self.place[i] = self.drift[i] - was / unload
        side, peak = (1.0, out) if trial >= 0.0 else (-1.0, inward)
        along, start = side * u, side * self.place[i]
        if along >= peak:
            most = self._backbone(i, max(along, 0.0))
        else:
            share = (along - start) / max(peak - start, LEAST_SPAN * u_y)
            most = self._backbone(i, peak) * min(1.0, max(0.0, share))
        return side * min(abs(trial), most)


def at_rest(chain):
    """State of a chain that has not moved: place and speed of each mode, MEMORY of each storey."""
    return np.zeros((2 + MEMORY) * len(chain.square_1_s2))


def largest_drift(state):
    """Largest drift of each storey so far, without sign, of states (…, rows) [m]."""
    n = state.shape[-1] // (2 + MEMORY)
    memory = state[..., 2 * n :].reshape(*state.shape[:-1], n, MEMORY)
    return np.maximum(memory[..., OUT], memory[..., INWARD])


def march(chain, ground_m_s2, factors, start=None, floors=True):
    """Floors of a chain, and what it ends in, under a ground motion times each factor.

    Parameters
    ----------
    chain : SteppedChain
    ground_m_s2 : ndarray, shape (nt,)
        At the chain's step.
    factors : sequence of m floats
        With sign.
    start : ndarray, optional
        State in which all begin; see `at_rest`.
    floors : bool
        Whether they are wanted; else None takes their place.

    Returns
    -------
    floors_m_s2 : ndarray, shape (m, n, nt)
        Absolute accelerations, bottom to top.
    states : ndarray, shape (m, rows)
        At the end.
    """
    start = at_rest(chain) if start is None else start
    histories = [_one(chain, (factor * ground_m_s2).tolist(), start) for factor in factors]
    rows, states = zip(*histories, strict=True)
    return np.array(rows) if floors else None, np.array(states)


def _one(chain, ground, start):
    """Floors and end of one history, see `march`."""
    n = len(chain.square_1_s2)
    loops = Loops(chain.storeys, start[2 * n :].reshape(n, MEMORY))
    modes, last = range(n), len(ground) - 1
    flow, load = chain.flow.tolist(), chain.load.tolist()
    drift, across = chain.drift.tolist(), chain.drift.T.tolist()
    y, v = start[: 2 * n].reshape(n, 2).T.tolist()
    rows = np.empty((len(ground), n))  # of each mode: 2ζω q̇ + ω² q − what the storeys push
    damping, square, none = chain.damping_1_s.tolist(), chain.square_1_s2.tolist(), [0.0] * n
    inertia, before = chain.inertia.tolist(), None
    for k, now in enumerate(ground):
        less = [loops.less(i, sum(map(float.__mul__, drift[i], y))) for i in modes]
        push = [sum(map(float.__mul__, row, less)) for row in across] if any(less) else none
        rows[k] = [damping[j] * v[j] + square[j] * y[j] - push[j] for j in modes]
        if k == last:
            break
        after, before = ground[k + 1], push if before is None else before
        for j in modes:
            (a, b, c, d), (e, f, g, h) = flow[j], load[j]
            place, speed, mass = y[j], v[j], inertia[j]
            old, new = mass * now + push[j], mass * after + 2.0 * push[j] - before[j]
            y[j] = a * place + b * speed + e * old + g * new
            v[j] = c * place + d * speed + f * old + h * new
        before = push
    state = np.concatenate((np.array([y, v]).T.ravel(), loops.state.ravel()))
    return -(chain.shape @ rows.T), state
