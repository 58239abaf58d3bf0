"""Ties and floors in the compiled solvers: what joins a block to its supports apart from nodes."""

import math
from typing import NamedTuple

import numpy as np

from rocking.runtime.compiled import inlined

from .dashpots import push, turned
from .vectors import choose, like, put, put_where, some, take


class Bars(NamedTuple):
    """Ties and floors of a plane; lengths from the reference centroid of their block."""

    tie_body: np.ndarray  # (ties,), int: which of the free blocks
    tie_arm_m: np.ndarray  # (ties, 2) end on the block (y, z)
    tie_end_m: np.ndarray  # (ties, 2) end on the support
    tie_support: np.ndarray  # (ties,), int: column of its motion; −1: it stands still
    tie_taut_m: np.ndarray  # length, slack included, beyond which a tie pulls
    tie_k_n_m: np.ndarray
    tie_capacity_n: np.ndarray
    tie_snap_m: np.ndarray
    floor_body: np.ndarray  # (floors,), int
    floor_arm_m: np.ndarray  # (floors, 2)
    floor_support: np.ndarray
    floor_load_n: np.ndarray
    floor_k_n_m: np.ndarray
    floor_capacity_n: np.ndarray
    floor_from_m: np.ndarray  # displacement from which it counts
    mass_kg: np.ndarray  # of a floor between façade and support; 0: it moves with the support
    spring_n_m: np.ndarray  # from that mass to the support
    dashpot_ns_m: np.ndarray


class Memory(NamedTuple):
    """What ties and floors remember of a history, in rows."""

    yielded_m: np.ndarray  # by how much a tie has yielded
    snapped: np.ndarray  # 1 where a tie is lost
    slid_m: np.ndarray  # of floors
    place_m: np.ndarray  # of floors with a mass, relative to the ground
    speed_m_s: np.ndarray  # half a step back
    rate_m_s2: np.ndarray


@inlined
def remembered(bars, rows):
    """`Memory` in rows: two a tie, four a floor."""
    ties, floors = bars.tie_k_n_m.size, bars.floor_k_n_m.size
    rest = rows[2 * ties :]
    return Memory(
        rows[:ties],
        rows[ties : 2 * ties],
        *(rest[:floors], rest[floors : 2 * floors]),
        *(rest[2 * floors : 3 * floors], rest[3 * floors :]),
    )


@inlined
def _arm(place, turn, body, arm):
    """Where a body is, and an arm that turns with it."""
    return take(place, 3 * body), take(place, 3 * body + 1), *turned(turn, body, arm)


@inlined
def _tie(bars, memory, i, place, turn, supports, pushed):
    """Force of a tie; energy stored, taken in this step, and whether it was lost in it."""
    j, body, k = bars.tie_support[i], bars.tie_body[i], bars.tie_k_n_m[i]
    most, taut, yielded = bars.tie_capacity_n[i], bars.tie_taut_m[i], take(memory.yielded_m, i)
    y, z, ry, rz = _arm(place, turn, body, bars.tie_arm_m[i])
    at = j if j >= 0 else len(supports.y) - 1
    ey, ez = y + ry - bars.tie_end_m[i, 0] - take(supports.y, at), z + rz - bars.tie_end_m[i, 1]
    # what pulls is longer than `taut`; the rounding of a square cannot hide it
    pulls = (take(memory.snapped, i) <= 0.0) & ~(ey * ey + ez * ez < 0.999 * (taut * taut))
    none = like(0.0, ey)
    if not some(pulls):
        return none, none, none
    length = math.sqrt(ey * ey + ez * ez)
    longer = length - taut
    pull = k * (longer - yielded)
    pulls = pulls & ~(pull <= 0.0)
    snaps = pulls & (longer > bars.tie_snap_m[i])
    pulls = pulls & ~snaps
    most_held = min(pull, most)
    spent = choose(snaps, 0.5 * (most_held * most_held) / k, 0.0)
    lost = choose(snaps, 1.0, none)
    put_where(memory.snapped, i, snaps, 1.0)
    yields = pulls & (pull > most)
    if some(yields):
        pull = choose(yields, most, pull)
        spent = choose(yields, pull * (longer - pull / k - yielded), spent)
        put_where(memory.yielded_m, i, yields, longer - pull / k)
    gy, gz = choose(pulls, -pull * ey / length, 0.0), choose(pulls, -pull * ez / length, 0.0)
    push(pushed, body, 1.0, (gy, gz), (ry, rz))
    put(supports.fy, at, take(supports.fy, at) - gy)
    return choose(pulls, 0.5 * pull * pull / k, 0.0), spent, lost


@inlined
def _floor(bars, memory, i, place, turn, half_s, supports, ground_m_s2, weight_ratio, pushed):
    """Force of a floor; energy stored, its load's included, and taken in this step."""
    j, body, mass = bars.floor_support[i], bars.floor_body[i], bars.mass_kg[i]
    k, most, slid = bars.floor_k_n_m[i], bars.floor_capacity_n[i], take(memory.slid_m, i)
    y, z, ry, rz = _arm(place, turn, body, bars.floor_arm_m[i])
    ay, az = bars.floor_arm_m[i]
    at = j if j >= 0 else len(supports.y) - 1
    behind = take(supports.y, at)
    past = y + ry - ay - (take(memory.place_m, i) if mass > 0.0 else behind)
    past = past - bars.floor_from_m[i]
    held, spent = k * (past - slid), like(0.0, past)
    slides = abs(held) > most
    if some(slides):
        held = choose(slides, math.copysign(most, held), held)
        spent = choose(slides, held * (past - held / k - slid), 0.0)
        put_where(memory.slid_m, i, slides, past - held / k)
    load = weight_ratio * bars.floor_load_n[i]
    elastic = 0.5 * held * held / k + bars.floor_load_n[i] * (z + rz - az)
    push(pushed, body, 1.0, (-held, -load), (ry, rz))
    if mass > 0.0:
        speed = take(memory.speed_m_s, i) + half_s * take(memory.rate_m_s2, i)
        stretch, rate = take(memory.place_m, i) - behind, speed - take(supports.vy, at)
        back = bars.spring_n_m[i] * stretch + bars.dashpot_ns_m[i] * rate
        elastic += 0.5 * bars.spring_n_m[i] * stretch * stretch + 0.5 * mass * speed * speed
        spent += 2.0 * half_s * bars.dashpot_ns_m[i] * rate * rate
        put(memory.rate_m_s2, i, (held - back) / mass - ground_m_s2)
        held = back
    put(supports.fy, at, take(supports.fy, at) + held)
    return elastic, spent


@inlined
def act(bars, memory, place, turn, half_s, supports, ground_m_s2, weight_ratio, pushed):
    """Forces of ties and floors at a whole step.

    Parameters
    ----------
    bars : Bars
    memory : Memory
        Brought up to date.
    place, turn : rows
        y [m], z [m] and rotation about x of each block; its cosine and sine.
    half_s : float
        Half a step, by which speeds lag.
    supports : Supports
        To their forces those of ties and floors are added.
    ground_m_s2, weight_ratio : number
        Acceleration of the ground, and gravity with it over gravity at rest.
    pushed : rows
        Gets force along y and z [N] and moment about x [N·m] on each block.

    Returns
    -------
    elastic_j, spent_j, lost : number
        Energy stored, loads' included; taken in this step; ties that were lost in it.
    """
    for row in range(len(pushed)):
        put(pushed, row, 0.0)
    elastic = spent = lost = like(0.0, weight_ratio)
    for i in range(bars.tie_k_n_m.size):
        stored, taken, gone = _tie(bars, memory, i, place, turn, supports, pushed)
        elastic, spent, lost = elastic + stored, spent + taken, lost + gone
    for i in range(bars.floor_k_n_m.size):
        stored, taken = _floor(
            bars, memory, i, place, turn, half_s, supports, ground_m_s2, weight_ratio, pushed
        )
        elastic, spent = elastic + stored, spent + taken
    return elastic, spent, lost


@inlined
def advance(bars, memory, ahead_s, step_s):
    """Move the floors that have a mass on by a step; `ahead_s` is half of it at the first."""
    for i in range(bars.mass_kg.size):
        if bars.mass_kg[i] > 0.0:
            speed = take(memory.speed_m_s, i) + ahead_s * take(memory.rate_m_s2, i)
            put(memory.speed_m_s, i, speed)
            put(memory.place_m, i, take(memory.place_m, i) + step_s * speed)


def of_scene(scene, free, column):
    """Ties and floors of a scene on its free blocks.

    Parameters
    ----------
    scene : Scene
    free : list of int
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
    if any(bar.a not in free for bar in (*scene.ties, *scene.floors)):
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
        tie_body=values(ties, lambda x: free.index(x.a), np.int64),
        tie_arm_m=places(ties, "end_a_m"),
        tie_end_m=places(ties, "end_b_m"),
        tie_support=values(ties, lambda x: support(x.b), np.int64),
        tie_taut_m=values(ties, lambda x: x.length_m + x.slack_m),
        tie_k_n_m=values(ties, lambda x: x.stiffness_n_m),
        tie_capacity_n=values(ties, lambda x: x.capacity_n),
        tie_snap_m=values(ties, lambda x: x.elongation_m),
        floor_body=values(floors, lambda x: free.index(x.a), np.int64),
        floor_arm_m=places(floors, "position_m"),
        floor_support=np.array(
            [support(s.b if s else f.b) for f, s in zip(floors, sprung, strict=True)], np.int64
        ),
        floor_load_n=values(floors, lambda x: x.load_n),
        floor_k_n_m=values(floors, lambda x: x.stiffness_n_m),
        floor_capacity_n=values(floors, lambda x: x.capacity_n),
        floor_from_m=values(floors, lambda x: x.from_m),
        mass_kg=values(sprung, lambda s: scene.blocks[s.a].mass_kg if s else 0.0),
        spring_n_m=values(sprung, lambda s: s.stiffness_n_m if s else 0.0),
        dashpot_ns_m=values(sprung, lambda s: s.dashpot_ns_m if s else 0.0),
    )


def row_of(size, direction, ends):
    """How far each freedom opens a spring along a direction; `ends`: block, sign, its arm."""
    (y, z), row = direction, np.zeros(size)
    for body, sign, (ry, rz) in ends:
        row[3 * body : 3 * body + 3] = sign * np.array([y, z, z * ry - y * rz])
    return row


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
        coefficients = row_of(size, along, ((body, 1.0, arm),))
        if other >= 0:
            coefficients[first + other] -= along[0]
        return coefficients

    def moving(j):
        return j if supports else -1

    springs: list[tuple] = []
    for i, arm in enumerate(bars.tie_arm_m):
        along = arm - bars.tie_end_m[i]
        along = along / np.linalg.norm(along)
        other = moving(bars.tie_support[i])
        tie = row(bars.tie_body[i], arm, along, other)
        if not any(np.array_equal(tie, -before) for _, _, before in springs):
            springs.append((bars.tie_k_n_m[i], 0.0, tie))
    for i, arm in enumerate(bars.floor_arm_m):
        behind = moving(bars.floor_support[i])
        other = behind
        if bars.mass_kg[i] > 0.0:
            other = supports + int(np.flatnonzero(masses == i)[0])
            spring = np.zeros(size)
            spring[first + other] = 1.0
            if behind >= 0:
                spring[first + behind] = -1.0
            springs.append((bars.spring_n_m[i], bars.dashpot_ns_m[i], spring))
        if bars.floor_capacity_n[i] > 0.0:
            body = bars.floor_body[i]
            springs.append((bars.floor_k_n_m[i], 0.0, row(body, arm, (1.0, 0.0), other)))
    return springs
