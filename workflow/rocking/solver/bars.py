"""Ties and floors in the compiled solvers: what joins a block to its supports apart from nodes."""

import math
from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import compiled, inlined


class Bars(NamedTuple):
    """Ties and floors of a plane; lengths from the reference centroid of their block.

    Attributes
    ----------
    tie_body, floor_body : ndarray of int, shape (ties,), (floors,)
        Which of the free blocks.
    tie_arm_m, tie_end_m : ndarray, shape (ties, 2)
        Ends on the block and on the support (y, z).
    tie_support : ndarray of int, shape (ties,)
        Column of the motion of the support; −1: it stands still.
    tie_taut_m : ndarray, shape (ties,)
        Length, slack included, beyond which a tie pulls.
    tie_k_n_m, tie_capacity_n, tie_snap_m : ndarray, shape (ties,)
    floor_arm_m : ndarray, shape (floors, 2)
    floor_support : ndarray of int, shape (floors,)
    floor_load_n, floor_k_n_m, floor_capacity_n : ndarray, shape (floors,)
    mass_kg, spring_n_m, dashpot_ns_m : ndarray, shape (floors,)
        Of a floor between façade and support; without mass it moves with the support.
    """

    tie_body: np.ndarray
    tie_arm_m: np.ndarray
    tie_end_m: np.ndarray
    tie_support: np.ndarray
    tie_taut_m: np.ndarray
    tie_k_n_m: np.ndarray
    tie_capacity_n: np.ndarray
    tie_snap_m: np.ndarray
    floor_body: np.ndarray
    floor_arm_m: np.ndarray
    floor_support: np.ndarray
    floor_load_n: np.ndarray
    floor_k_n_m: np.ndarray
    floor_capacity_n: np.ndarray
    mass_kg: np.ndarray
    spring_n_m: np.ndarray
    dashpot_ns_m: np.ndarray


class Memory(NamedTuple):
    """What ties and floors remember of a history.

    Attributes
    ----------
    yielded_m, snapped : ndarray, shape (ties,)
    slid_m : ndarray, shape (floors,)
    place_m, speed_m_s, rate_m_s2 : ndarray, shape (floors,)
        Of floors with a mass, relative to the ground; velocity half a step back.
    """

    yielded_m: np.ndarray
    snapped: np.ndarray
    slid_m: np.ndarray
    place_m: np.ndarray
    speed_m_s: np.ndarray
    rate_m_s2: np.ndarray


@compiled
def at_rest(bars):
    """Memory of a history that begins."""
    ties, floors = bars.tie_k_n_m.size, bars.floor_k_n_m.size
    return Memory(
        np.zeros(ties),
        np.zeros(ties, np.bool_),
        np.zeros(floors),
        np.zeros(floors),
        np.zeros(floors),
        np.zeros(floors),
    )


@inlined
def act(bars, memory, pose, half_s, supports, ground_m_s2, weight_ratio, push):
    """Forces of ties and floors at a whole step.

    Parameters
    ----------
    bars : Bars
    memory : Memory
        Brought up to date.
    pose : ndarray, shape (blocks, 4)
        y [m], z [m], cosine and sine of the rotation about x of each block.
    half_s : float
        Half a step, by which speeds lag.
    supports : tuple of three ndarrays
        Displacement and velocity of each, and the force on it [N], to which theirs are added.
    ground_m_s2, weight_ratio : float
        Acceleration of the ground, and gravity with it over gravity at rest.
    push : ndarray, shape (blocks, 3)
        Gets force along y and z [N] and moment about x [N·m] on each block.

    Returns
    -------
    elastic_j, spent_j, lost : float, float, int
        Energy stored, loads' included; taken in this step; ties that were lost in it.
    """
    su, sv, sf = supports
    push[:] = 0.0
    elastic = spent = 0.0
    lost = 0
    for i in range(bars.tie_k_n_m.size):
        if memory.snapped[i]:
            continue
        j, own = bars.tie_support[i], bars.tie_body[i]
        y, z, cos, sin = pose[own]
        ry = cos * bars.tie_arm_m[i, 0] - sin * bars.tie_arm_m[i, 1]
        rz = sin * bars.tie_arm_m[i, 0] + cos * bars.tie_arm_m[i, 1]
        ey, ez = y + ry - bars.tie_end_m[i, 0] - su[j], z + rz - bars.tie_end_m[i, 1]
        length = math.hypot(ey, ez)
        longer = length - bars.tie_taut_m[i]
        pull = bars.tie_k_n_m[i] * (longer - memory.yielded_m[i])
        if pull <= 0.0:
            continue
        if longer > bars.tie_snap_m[i]:
            spent += 0.5 * min(pull, bars.tie_capacity_n[i]) ** 2 / bars.tie_k_n_m[i]
            memory.snapped[i] = True
            lost += 1
            continue
        if pull > bars.tie_capacity_n[i]:
            pull = bars.tie_capacity_n[i]
            spent += pull * (longer - pull / bars.tie_k_n_m[i] - memory.yielded_m[i])
            memory.yielded_m[i] = longer - pull / bars.tie_k_n_m[i]
        elastic += 0.5 * pull * pull / bars.tie_k_n_m[i]
        gy, gz = -pull * ey / length, -pull * ez / length
        push[own, 0] += gy
        push[own, 1] += gz
        push[own, 2] += ry * gz - rz * gy
        sf[j] -= gy
    for i in range(bars.floor_k_n_m.size):
        j, mass = bars.floor_support[i], bars.mass_kg[i]
        own = bars.floor_body[i]
        y, z, cos, sin = pose[own]
        ay, az = bars.floor_arm_m[i]
        ry, rz = cos * ay - sin * az, sin * ay + cos * az
        past = y + ry - ay - (memory.place_m[i] if mass > 0.0 else su[j])
        k, most = bars.floor_k_n_m[i], bars.floor_capacity_n[i]
        held = k * (past - memory.slid_m[i])
        if abs(held) > most:
            held = math.copysign(most, held)
            spent += held * (past - held / k - memory.slid_m[i])
            memory.slid_m[i] = past - held / k
        load = weight_ratio * bars.floor_load_n[i]
        elastic += 0.5 * held * held / k + bars.floor_load_n[i] * (z + rz - az)
        push[own, 0] -= held
        push[own, 1] -= load
        push[own, 2] += rz * held - ry * load
        if mass > 0.0:
            speed = memory.speed_m_s[i] + half_s * memory.rate_m_s2[i]
            stretch, rate = memory.place_m[i] - su[j], speed - sv[j]
            back = bars.spring_n_m[i] * stretch + bars.dashpot_ns_m[i] * rate
            elastic += 0.5 * bars.spring_n_m[i] * stretch * stretch + 0.5 * mass * speed * speed
            spent += 2.0 * half_s * bars.dashpot_ns_m[i] * rate * rate
            memory.rate_m_s2[i] = (held - back) / mass - ground_m_s2
            held = back
        sf[j] += held
    return elastic, spent, lost


@inlined
def advance(bars, memory, ahead_s, step_s):
    """Move the floors that have a mass on by a step; `ahead_s` is half of it at the first."""
    for i in range(bars.mass_kg.size):
        if bars.mass_kg[i] > 0.0:
            memory.speed_m_s[i] += ahead_s * memory.rate_m_s2[i]
            memory.place_m[i] += step_s * memory.speed_m_s[i]


def of_scene(scene, own, column):
    """Ties and floors of a scene on its free blocks.

    Parameters
    ----------
    scene : Scene
    own : list of int
        The free blocks.
    column : dict of str to int
        Of each support's motion.

    Returns
    -------
    Bars

    Raises
    ------
    ValueError
        One line if one does not hold a free block to a support.
    """
    if any(bar.a not in own for bar in (*scene.ties, *scene.floors)):
        raise ValueError("planar solver: ties and floors must hold the free block to a support")
    spring = {link.a: link for link in scene.links}

    def support(block):
        return column.get(scene.blocks[block].motion, -1)

    def values(bars, pick, kind=float):
        return np.array([pick(bar) for bar in bars], kind)

    def places(bars, name):
        centre = np.array([scene.blocks[bar.a].centre_m[1:] for bar in bars]).reshape(-1, 2)
        return values(bars, lambda x: getattr(x, name)[1:]).reshape(-1, 2) - centre

    ties, floors = scene.ties, scene.floors
    sprung = [spring.get(floor.b) for floor in floors]
    return Bars(
        tie_body=values(ties, lambda x: own.index(x.a), np.int64),
        tie_arm_m=places(ties, "end_a_m"),
        tie_end_m=places(ties, "end_b_m"),
        tie_support=values(ties, lambda x: support(x.b), np.int64),
        tie_taut_m=values(ties, lambda x: x.length_m + x.slack_m),
        tie_k_n_m=values(ties, lambda x: x.stiffness_n_m),
        tie_capacity_n=values(ties, lambda x: x.capacity_n),
        tie_snap_m=values(ties, lambda x: x.elongation_m),
        floor_body=values(floors, lambda x: own.index(x.a), np.int64),
        floor_arm_m=places(floors, "position_m"),
        floor_support=np.array(
            [support(s.b if s else f.b) for f, s in zip(floors, sprung, strict=True)], np.int64
        ),
        floor_load_n=values(floors, lambda x: x.load_n),
        floor_k_n_m=values(floors, lambda x: x.stiffness_n_m),
        floor_capacity_n=values(floors, lambda x: x.capacity_n),
        mass_kg=values(sprung, lambda s: scene.blocks[s.a].mass_kg if s else 0.0),
        spring_n_m=values(sprung, lambda s: s.stiffness_n_m if s else 0.0),
        dashpot_ns_m=values(sprung, lambda s: s.dashpot_ns_m if s else 0.0),
    )


def elements(bars, supports, blocks=1):
    """Stiffness and dashpot of each bar with its row of coefficients, ties taut, floors stuck.

    Of two ties that pull one point opposite ways, as a free-standing façade's anchors do, one is.
    Freedoms: y, z and rotation of each block, the supports along y, the floors with a mass.

    Returns
    -------
    list of (stiffness_n_m, dashpot_ns_m, ndarray of shape (3·blocks + supports + masses,))
    """
    masses = np.flatnonzero(bars.mass_kg > 0.0)
    first = 3 * blocks
    size = first + supports + masses.size

    def row(body, arm, along, other):
        (ry, rz), (y, z) = arm, along
        found = np.zeros(size)
        found[3 * body : 3 * body + 3] = y, z, z * ry - y * rz
        if other >= 0:
            found[first + other] -= y
        return found

    def moving(j):
        return j if supports else -1

    found: list[tuple] = []
    for i, arm in enumerate(bars.tie_arm_m):
        along = arm - bars.tie_end_m[i]
        along = along / np.linalg.norm(along)
        other = moving(bars.tie_support[i])
        one = row(bars.tie_body[i], arm, along, other)
        if not any(np.array_equal(one, -before) for _, _, before in found):
            found.append((bars.tie_k_n_m[i], 0.0, one))
    for i, arm in enumerate(bars.floor_arm_m):
        behind = moving(bars.floor_support[i])
        other = behind
        if bars.mass_kg[i] > 0.0:
            other = supports + int(np.flatnonzero(masses == i)[0])
            spring = np.zeros(size)
            spring[first + other] = 1.0
            if behind >= 0:
                spring[first + behind] = -1.0
            found.append((bars.spring_n_m[i], bars.dashpot_ns_m[i], spring))
        if bars.floor_capacity_n[i] > 0.0:
            own = bars.floor_body[i]
            found.append((bars.floor_k_n_m[i], 0.0, row(own, arm, (1.0, 0.0), other)))
    return found
