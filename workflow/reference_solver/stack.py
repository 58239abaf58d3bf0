"""Several rigid blocks in the plane, solved apart from `rocking.solver`: what it is judged by.

It takes any planar scene of dry joints: one block, courses or pieces before return walls that are
driven or carry the masses of the chain, with ties, floors and vertical motion. Every joint keeps
its nodes (`stack_law`). A fixed step of the classical Runge–Kutta scheme divides each interval of
the motion. Across the jumps of contact forces its error falls with the first power of the step, so
the step is short: `STEP_S`, or of stiffer scenes what keeps it stable twice over. The works of all
forces that were applied are integrated beside the motion, so energy tells how well a history was
solved.

Nothing here is shared with the compiled solver but the helper that compiles, and the scene.
"""

import math
from dataclasses import dataclass

import numpy as np

from yade_scripts.model import floor_motions
from yade_scripts.model.scene import DRY
from yade_scripts.model.stiffness import assemble

from .stack_law import WORKS, Assembly
from .stack_march import COLUMNS, Driving, march

STEP_S = 4e-5
STABLE = 1.3  # longest step times the largest eigenvalue of the rates; the scheme allows 2.7
AFTER_S = 2.0  # at rest beyond the motion
FREEDOMS = "yzX"


@dataclass(frozen=True)
class StackHistory:
    """One history; arrays have a row a sample.

    Energies are those of the free blocks in the ground's frame. Input is the work of inertia forces
    and of driven supports; spent is what joints, links, ties and floors took of it. `closure_j` is
    stored + kinetic + spent − input, zero but for the error of integration.
    """

    time_s: np.ndarray
    d_m: np.ndarray
    place: np.ndarray  # (n, blocks, 3): y, z [m], rotation about x [rad]
    rates: np.ndarray
    input_j: np.ndarray
    kinetic_j: np.ndarray
    stored_j: np.ndarray
    spent_j: np.ndarray
    closure_j: np.ndarray
    peak_d_over_b: float
    status: str
    end_s: float


@dataclass(frozen=True)
class StackPeaks:
    """Largest |d|/b by factor, (cases,); "ok", "overturned" or "failed"; time simulated."""

    d_over_b: np.ndarray
    status: list
    end_s: np.ndarray


class StackSolver:
    """A planar scene under one set of motions.

    Parameters
    ----------
    scene : yade_scripts.model.scene.Scene
        Of `models.build_scene`: planar, every node dry.
    time_s : array_like, shape (nt,)
    columns : dict of str to array_like
        Accelerations [m/s²] by name, "ground" first, as `floor_motions.read` gives them.
    bounded : bool
        Spring and dashpot along a joint keep |T| ≤ μN together; False: the spring alone, as in
        YADE's own law.
    keeps : bool
        A node keeps its slip while it is open, as in OpenSees' sliders; False: it closes without.
    after_s : float
        Simulated beyond the motion.

    Raises
    ------
    ValueError
        One line for a scene that is not planar, bonds, links that are not along y, a mass that is
        damped by itself, blocks that are driven along z, or a motion without a column.
    """

    def __init__(self, scene, time_s, columns, *, bounded=True, keeps=False, after_s=AFTER_S):
        """Reduce the scene, and integrate its motions."""
        self.scene, given = floor_motions.shaken(scene, columns)
        names = [name for name in self.scene.motions if name in {b.motion for b in scene.blocks}]
        self.assembly = assembly_of(self.scene, names, bounded, keeps)
        self.driving = driving_of(time_s, given, names, self.scene.vertical, after_s)
        self.start = start_of(self.scene, self.assembly)
        self.thickness_m = float(scene.thickness_m)
        self.step_s = min(STEP_S, STABLE / fastest_rate(self.scene))

    def _run(self, factor, step_s, until_s, stop_d_over_b, rows, every):
        end = math.inf if until_s is None else float(until_s)
        control = float(step_s), end, float(stop_d_over_b * self.thickness_m), int(every)
        return march(self.assembly, self.driving, float(factor), self.start, control, rows)

    def history(self, factor, *, step_s=None, until_s=None, stop_d_over_b=1.0, sample_s=0.005):
        """One `StackHistory`; the factor is on all accelerations, its sign the direction."""
        step_s = step_s or self.step_s
        every = max(1, round(sample_s / step_s))
        length = len(self.start[: 6 * len(self.scene.blocks)]) + COLUMNS
        rows = np.zeros((4 * int(self.driving.time_s[-1] / (every * step_s)) + 2, length))
        outcome = self._run(factor, step_s, until_s, stop_d_over_b, rows, every)
        peak, end, last, written = outcome
        rows = rows[:written]
        time, d, inertia, joints, supports, kinetic, raised, stored = rows[:, :COLUMNS].T
        given = inertia + supports
        spent = -joints - (stored - stored[0])
        stored = stored + raised
        places = rows[:, COLUMNS:].reshape(written, 2, len(self.scene.blocks), 3)
        return StackHistory(
            time,
            d,
            places[:, 0],
            places[:, 1],
            given,
            kinetic,
            stored - stored[0],
            spent,
            kinetic - kinetic[0] + stored - stored[0] + spent - given,
            peak / self.thickness_m,
            _ended(last / self.thickness_m, stop_d_over_b),
            end,
        )

    def peaks(self, factors, *, step_s=None, until_s=None, stop_d_over_b=1.0):
        """`StackPeaks` at some factors."""
        none, step_s = np.zeros((0, COLUMNS)), step_s or self.step_s
        outcomes = [
            self._run(f, step_s, until_s, stop_d_over_b, none, 1) for f in np.ravel(factors)
        ]
        peak, end, last, _ = np.array(outcomes, float).T
        status = [_ended(d / self.thickness_m, stop_d_over_b) for d in last]
        return StackPeaks(np.minimum(peak / self.thickness_m, stop_d_over_b), status, end)


def fastest_rate(scene):
    """Largest eigenvalue in size of the rates, every joint closed and every tie taut [1/s]."""
    matrices = assemble(scene)
    k, c = (matrix / matrices.mass[:, None] for matrix in matrices.dense())
    none = np.zeros(k.shape)
    return float(np.abs(np.linalg.eigvals(np.block([[none, np.eye(len(k))], [-k, -c]]))).max())


def _ended(d_over_b, stop_d_over_b):
    if not math.isfinite(d_over_b):
        return "failed"
    return "overturned" if abs(d_over_b) > stop_d_over_b else "ok"


def _check(scene):
    """Refuse what the law has not."""
    nodes, blocks = scene.nodes, scene.blocks
    wrong = [b.name for b in blocks if not set(b.free) <= set(FREEDOMS) or b.motion_x]
    if wrong or np.any(np.abs(nodes.normal[:, 0]) > 1e-12):
        raise ValueError(f"stack solver: expected a planar scene, got block {(wrong or ['?'])[0]}")
    if np.any(nodes.kind != DRY):
        raise ValueError("stack solver: expected dry joints, got bonds, ties or welds")
    if any(tuple(link.direction) != (0.0, 1.0, 0.0) for link in scene.links):
        raise ValueError("stack solver: expected links along y")
    if any(b.drag_1_s or b.weightless for b in blocks):
        raise ValueError("stack solver: expected blocks with their weight and without drag")
    if scene.notes.get("rims"):
        raise ValueError("stack solver: expected planes without rims")


def assembly_of(scene, names, bounded, keeps):
    """`stack_law.Assembly` of a scene; `names` are those of its motions, a column each."""
    _check(scene)
    blocks, ground = scene.blocks, scene.shaking or scene.blocks[0].motion
    column = {name: k for k, name in enumerate(names)}
    centre = np.array([b.centre_m[1:] for b in blocks], float)
    driven = [b.motion if "y" not in b.free else None for b in blocks]
    ties, floors, links = scene.ties, scene.floors, scene.links
    still = [i for i, b in enumerate(blocks) if not b.free and b.motion in (None, ground)]

    def integers(rows, width=2):
        return np.array(rows, np.int64).reshape(-1, width)

    def numbers(rows, width):
        return np.array(rows, float).reshape(-1, width)

    def arm(block, point):
        return (np.array(point[1:], float) - centre[block]).tolist()

    return Assembly(
        mass_kg=np.array([b.mass_kg for b in blocks], float),
        inertia_kg_m2=np.array([b.inertia_kg_m2[0] for b in blocks], float),
        centre_m=centre,
        moves=np.array([[float(f in b.free) for f in FREEDOMS] for b in blocks]),
        column=np.array([column.get(name, -1) for name in driven], np.int64),
        **_lines(scene.nodes, centre),
        link=integers([(x.a, -1 if x.b in still else x.b) for x in links]),
        link_n_m=numbers([(x.stiffness_n_m, x.dashpot_ns_m) for x in links], 2),
        tie=integers([(t.a, t.b) for t in ties]),
        tie_end_m=numbers([arm(t.a, t.end_a_m) + arm(t.b, t.end_b_m) for t in ties], 4),
        tie_law=numbers(
            [(t.stiffness_n_m, t.capacity_n, t.length_m + t.slack_m, t.elongation_m) for t in ties],
            4,
        ),
        floor=integers([(f.a, f.b) for f in floors]),
        floor_end_m=numbers([arm(f.a, f.position_m) for f in floors], 2),
        floor_law=numbers([(f.stiffness_n_m, f.capacity_n, f.load_n, f.from_m) for f in floors], 4),
        watched=np.array([scene.index(name) for name, _ in scene.watched], np.int64),
        watched_m=numbers([arm(scene.index(name), at) for name, at in scene.watched], 2),
        foot=scene.index(scene.reference),
        gravity_m_s2=float(scene.gravity_m_s2),
        bounded=bool(bounded),
        keeps=bool(keeps),
    )


def _lines(nodes, centre):
    """Fields of an `Assembly` that are of nodes: those of a joint on one line before one plane."""
    places, normals = nodes.position_m[:, 1:], nodes.normal[:, 1:]
    level = np.einsum("ni,ni->n", normals, places - centre[nodes.b]) - nodes.gap_m
    laws = np.stack([nodes.beta_s, np.tan(nodes.friction_rad), nodes.drag], axis=1)
    alike: dict[tuple, list] = {}
    for i in range(len(nodes)):
        key = (nodes.joint[i], nodes.a[i], nodes.b[i], *normals[i], round(level[i], 9), *laws[i])
        alike.setdefault(key, []).append(i)
    rows, order, place = [], [], []
    for mine in alike.values():
        points = places[mine]
        apart = points - points[0]
        along = apart[np.argmax(np.abs(apart).sum(axis=1))]
        long = np.hypot(*along)
        along = along / long if long > 0.0 else np.array([1.0, 0.0])
        on = apart @ along
        parts = [np.arange(len(mine))]
        if np.abs(apart - on[:, None] * along).max() > 1e-9:  # no line: each for itself
            parts = [np.array([k]) for k in parts[0]]
        for part in parts:
            part = part[np.argsort(on[part], kind="stable")]
            i = mine[part[0]]
            rows.append((i, points[part[0]] - centre[nodes.a[i]], along))
            order.append(np.array(mine)[part])
            place.append(on[part] - on[part[0]])
    heads = [row[0] for row in rows]
    every = np.concatenate(order)
    return {
        "first": np.cumsum([0, *map(len, order)]).astype(np.int64),
        "body": np.stack([nodes.a[heads], nodes.b[heads]], axis=1).astype(np.int64),
        "origin_m": np.array([row[1] for row in rows]),
        "along": np.array([row[2] for row in rows]),
        "normal": np.ascontiguousarray(normals[heads]),
        "level_m": level[heads],
        "law": laws[heads],
        "place_m": np.concatenate(place),
        "kn_n_m": nodes.kn_n_m[every].astype(float),
        "ks_n_m": nodes.ks_n_m[every].astype(float),
    }


def start_of(scene, assembly):
    """State in which a scene starts."""
    blocks, n = scene.blocks, len(scene.blocks)
    more = WORKS + assembly.place_m.size + len(assembly.tie) + len(assembly.floor)
    state = np.zeros(6 * n + more)
    for i, b in enumerate(blocks):
        state[3 * i : 3 * i + 3] = *b.displacement_m[1:], b.rotation_rad[0]
        at = 3 * (n + i)
        state[at : at + 3] = *b.velocity_m_s[1:], b.angular_velocity_rad_s[0]
    return state


def driving_of(time_s, columns, names, vertical, after_s):
    """`stack_march.Driving` of motions by name; they end at zero, and what then moves coasts."""
    time = np.asarray(time_s, float)
    end = 2.0 * time[-1] - time[-2]
    time = np.concatenate((time, [end, end + after_s]))
    dt = np.diff(time)

    def ended(name):
        if name is None:
            return np.zeros(time.size)
        return np.concatenate((np.asarray(columns[name], float), [0.0, 0.0]))

    ground = ended(floor_motions.GROUND)
    relative = np.array([ended(name) - ground for name in names]).reshape(-1, time.size)
    a0, a1 = relative[:, :-1], relative[:, 1:]
    start = np.zeros((len(relative), 1))
    speed = np.concatenate((start, np.cumsum(0.5 * dt * (a0 + a1), axis=1)), axis=1)
    way = speed[:, :-1] * dt + (2.0 * a0 + a1) * dt**2 / 6.0
    place = np.concatenate((start, np.cumsum(way, axis=1)), axis=1)
    return Driving(time, ground, ended(vertical), relative, speed, place)
