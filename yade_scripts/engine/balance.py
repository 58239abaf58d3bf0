"""Full energy balance of a run: what the drive puts in, what is stored, what is lost and where.

At every whole step, with the mean v of the velocities half a step before and after it::

    W_in = ΔK + ΔU + ΔE + D_c + D_μ + D_f + residual

    W_in  work of whatever moves a support or guides a block, ∫ −F·v dt, F the contacts' force on
          it; in the frame of the ground also of the inertia forces, ∫ −m a_g v dt, and of those
          of a vertical motion
    K     ½ m v² + ½ ωᵀ R I Rᵀ ω of the free blocks, I about axes that turn with them by R; of
          guided ones without the motion imposed on them
    U     m g Δz of the free blocks, P Δz of the loads of floors
    E     ½ kn un² + ½ |Fs|²/ks of the contacts, for bonds and links without their preloads, which
          cancel
    D_c   dashpots, ∫ (Fn − kn un) vn + cs |vs|² dt, the second where the contact does not slip
    D_μ   friction, ∫ Fs·(dus − dFs/ks)
    D_f   energy stored in bonds and ties when they break, and what ties took by yielding

Each term follows from its own law, velocities and positions from the integrator, so the
residual is the error of the time integration and of this account. Python at every step makes such
a run some ten times slower; for a run's own check see `energy_check`.
"""

from dataclasses import dataclass

import numpy as np

from yade_scripts.engine import adapter, floors, loop
from yade_scripts.engine.bonds import FACE_OFFSET_M, PRELOAD_M
from yade_scripts.engine.links import REACH_M
from yade_scripts.engine.poses import rotation

COLUMNS = (
    "time_s",
    "input_j",
    "kinetic_j",
    "potential_j",
    "elastic_j",
    "dashpots_j",
    "friction_j",
    "fracture_j",
    "residual_j",
)
NEXT, LAST = [1, 2, 0], [2, 0, 1]  # axes after each of x, y, z
SLIPPING = 1.0 - 1e-9  # of μ Fn
PRELOAD_DEPTH_M = PRELOAD_M + FACE_OFFSET_M  # of both spheres of a bond at rest


@dataclass
class Contacts:
    """Contacts of one step as arrays, one row a contact; force on `b`, and back on `a`."""

    keys: list
    a: np.ndarray  # index of the moving block or support, by contact
    b: np.ndarray
    point: np.ndarray
    normal: np.ndarray
    depth: np.ndarray
    normal_force: np.ndarray
    shear_force: np.ndarray
    kn: np.ndarray
    ks: np.ndarray
    cs: np.ndarray
    friction: np.ndarray
    pressed: np.ndarray  # energy of the normal springs
    yielded: np.ndarray  # plastic part of a tie's lengthening, negative

    @property
    def force(self):
        """Force on the second body of each contact, without the dashpots' shear, (n, 3) [N]."""
        return self.normal_force[:, None] * self.normal + self.shear_force

    @property
    def elastic(self):
        """Energy of the springs of each contact, without preloads [J]."""
        return self.pressed + 0.5 * (self.shear_force**2).sum(axis=1) / self.ks


class EnergyBalance:
    """Adds up the energies of a run; pass `attach` to `simulate.run` as `setup`.

    `rows` are COLUMNS at the samples: time [s] and energies since the start [J].
    """

    def __init__(self, scene, sample_s=0.01, motions=None):
        """Prepare for a run with a row every `sample_s`; inertia forces need the run's motions."""
        names = {1: scene.shaking, 2: scene.vertical}
        self.inertial = {axis: motions[name] for axis, name in names.items() if name and motions}
        self.scene, self.sample_s, self.rows = scene, sample_s, []
        self.work = np.zeros(4)  # input, dashpots, friction, fracture
        self.before: dict = {}
        self.start = None

    def hold(self, built):
        """Take hold of the built scene, so that `contacts` can be asked."""
        self.omega = built.omega
        self._follow_bodies(built)
        spheres = built.bonds.spheres.values() if built.bonds else ()
        self.preload = {body: PRELOAD_DEPTH_M for trio in spheres for body in trio[:2]}
        self.bond_of = {body: number for number, trio in enumerate(spheres) for body in trio}
        self.ties = set(built.ties)
        self.floors = {pair for pair in built.floors if pair[1] is not None}
        self.raised = floors.Raised(self.scene, built)
        for bodies in built.linked.values():
            self.preload.update(dict.fromkeys(bodies, REACH_M))

    def attach(self, built):
        """Place one runner before and one after the integrator."""
        self.hold(built)
        wrapper, omega = adapter.load_yade(), built.omega
        self.period = max(1, round(self.sample_s / omega.dt))
        engines = list(omega.engines)
        at = next(i for i, e in enumerate(engines) if isinstance(e, wrapper.NewtonIntegrator))
        before, after = loop.runner(self._before, 1), loop.runner(self._after, 1)
        omega.engines = [*engines[:at], before, engines[at], after, *engines[at + 1 :]]

    def _follow_bodies(self, built):
        """Number blocks and supports; a clump's members move with their clump."""
        bodies, scene = self.omega.bodies, self.scene
        self.slot: dict[int, int] = {}
        self.states: list = []
        for body in bodies:
            if body.isClumpMember:
                continue
            self.slot[body.id] = len(self.states)
            self.states.append(body.state)
        for body in bodies:
            if body.isClumpMember:
                self.slot[body.id] = self.slot[body.clumpId]
        n = len(self.states)
        self.mass, self.inertia = np.zeros((n, 3)), np.zeros((n, 3))
        self.weight, self.driven = np.zeros(n), np.ones((n, 3), bool)
        for index, block in enumerate(scene.blocks):
            if block.free:
                k = self.slot[built.body[index]]
                self.mass[k], self.inertia[k] = block.mass_kg, block.inertia_kg_m2
                self.weight[k] = block.mass_kg * scene.gravity_m_s2
                self.driven[k] = block.motion_x is not None, block.motion is not None, False
                self.mass[k, self.driven[k]] = 0.0
        self.height = np.array([s.pos[2] for s in self.states])

    def _speeds(self):
        """Velocity and spin of every block and support, shape (n, 6)."""
        rows = []
        for state in self.states:
            v, w = state.vel, state.angVel
            rows.append((v[0], v[1], v[2], w[0], w[1], w[2]))
        return np.array(rows)

    def contacts(self):
        """Contacts of the present step."""
        keys, ends, rows = [], [], []
        for contact in self.omega.interactions:
            if not contact.isReal:
                continue
            g, p = contact.geom, contact.phys
            x, n, f, s = g.contactPoint, g.normal, p.normalForce, p.shearForce
            held = f[0] * n[0] + f[1] * n[1] + f[2] * n[2]
            key = contact.id1, contact.id2
            if key in self.ties:  # its spheres overlap whatever it does
                law = held / p.kn, p.kn, 1.0, 0.0, 0.0, 0.0, p.plastD
            elif key in self.floors:
                law = 0.0, p.kn, p.ks, 0.0, 0.0, 0.0, 0.0
            else:
                preload = self.preload.get(contact.id1, self.preload.get(contact.id2, 0.0))
                friction = p.tangensOfFrictionAngle
                law = g.penetrationDepth, p.kn, p.ks, p.cs, friction, preload, 0.0
            keys.append(key)
            ends.append((self.slot[contact.id1], self.slot[contact.id2]))
            # indices: unpacking YADE's vectors is many times slower
            arms = x[0], x[1], x[2], n[0], n[1], n[2], s[0], s[1], s[2]
            rows.append((*arms, held, *law))
        table = np.array(rows, float).reshape(-1, 17)
        a, b = np.array(ends, int).reshape(-1, 2).T
        point, normal, shear = table[:, 0:3], table[:, 3:6], table[:, 6:9]
        force, depth, kn, ks, cs, friction, preload, yielded = table[:, 9:].T
        pressed = 0.5 * kn * (depth**2 - preload**2)
        return Contacts(
            keys, a, b, point, normal, depth, force, shear, kn, ks, cs, friction, pressed, yielded
        )

    def _before(self):
        """Forces and contacts at the step, and the velocities half a step before it."""
        self.speed, self.now = self._speeds(), self.contacts()
        self.place = np.array([[float(v) for v in s.pos] for s in self.states])
        if self.omega.iter % self.period == 0:
            self.turn = np.array([rotation(s.ori) for s in self.states]).reshape(-1, 3, 3)
        self.lifted, self.carried = self.raised(), self.raised.momentum()

    def _after(self):
        """Add up the works of the step; keep a row at every sample."""
        dt, c = self.omega.dt, self.now
        mean = 0.5 * (self.speed + self._speeds())
        relative = self._relative(mean)
        closing = (relative * c.normal).sum(axis=1)
        sliding = relative - closing[:, None] * c.normal
        capacity = c.friction * c.normal_force
        size = np.sqrt((c.shear_force**2).sum(axis=1))
        sticks = size < SLIPPING * capacity
        earlier = self._relative(self.speed)
        earlier -= (earlier * c.normal).sum(axis=1)[:, None] * c.normal
        viscous = np.where(sticks, c.cs, 0.0)[:, None] * earlier
        force = c.force + viscous
        # a contact pushes its first body back and its second on
        driven_a = (force * mean[c.a, :3] * self.driven[c.a]).sum()
        driven_b = (force * mean[c.b, :3] * self.driven[c.b]).sum()
        dashpots = (c.normal_force - c.kn * c.depth) @ closing + (viscous * sliding).sum()
        power = np.array([driven_a - driven_b, dashpots])
        for axis, motion in self.inertial.items():
            pull = np.interp(self.omega.time, motion.time_s, motion.acceleration_m_s2)
            power[0] -= pull * (self.mass[:, axis] @ mean[:, axis])
            if axis == 2:  # loads of floors too
                power[0] -= pull * 0.5 * (self.carried + self.raised.momentum())
        friction, fracture = self._losses(earlier * dt, sticks)
        self.work[:2] += 0.5 * dt * power
        self.work[2] += friction
        self.work[3] += fracture
        if self.omega.iter % self.period == 0:
            self._row(mean)
        self.work[:2] += 0.5 * dt * power

    def _relative(self, speed):
        """Velocity of the first body past the second at every contact, shape (n, 3) [m/s]."""
        c = self.now
        arm_a, arm_b = c.point - self.place[c.a], c.point - self.place[c.b]
        return (
            speed[c.a, :3]
            + _cross(speed[c.a, 3:], arm_a)
            - speed[c.b, :3]
            - _cross(speed[c.b, 3:], arm_b)
        )

    def _losses(self, travel, sticks):
        """Friction and fracture since the last step [J]; keeps what the next one needs."""
        c, kept = self.now, {}
        friction = fracture = 0.0
        met, broken = [], set()
        for i, key in enumerate(c.keys):
            ks, shear = c.ks[i], c.shear_force[i]
            kept[key] = ks, shear, c.pressed[i], c.yielded[i]
            last = np.zeros(3)
            if key in self.before:
                _, last, _, yielded = self.before.pop(key)
                fracture += c.normal_force[i] * (c.yielded[i] - yielded)
            else:
                met.append(i)
            if not sticks[i]:
                friction += 0.5 * (last + shear) @ (travel[i] - (shear - last) / ks)
        for key, (ks, shear, pressed, _) in self.before.items():  # contacts that are no more
            stored = 0.5 * (shear @ shear) / ks
            if key in self.ties:
                fracture += pressed
                continue
            bonds = {
                self.bond_of[body] for body in key if body in self.preload and body in self.bond_of
            }
            if bonds:  # press or hook of a bond that has broken
                broken |= bonds
                fracture += pressed + stored
            else:
                friction += stored
        for i in met:  # what presses the plain nodes of broken bonds has passed on to them
            if broken.intersection(self.bond_of.get(body) for body in c.keys[i]):
                fracture -= c.pressed[i]
        self.before = kept
        return friction, fracture

    def _row(self, mean):
        """Keep the energies of the present step."""
        c = self.now
        spin = np.einsum("nij,ni->nj", self.turn, mean[:, 3:])
        kinetic = 0.5 * (self.mass * mean[:, :3] ** 2 + self.inertia * spin**2).sum()
        potential = self.weight @ (self.place[:, 2] - self.height) + self.lifted
        stored = np.array([kinetic, potential, c.elastic.sum()])
        if self.start is None:
            self.start = stored
            self.work[:] = 0.0
        done, lost = self.work[0], self.work[1:4]
        residual = done - (stored - self.start).sum() - lost.sum()
        self.rows.append((self.omega.time, done, *(stored - self.start), *lost, residual))


def _cross(a, b):
    """Products a × b row by row, shape (n, 3): `np.cross` takes ten times as long for few rows."""
    return a[:, NEXT] * b[:, LAST] - a[:, LAST] * b[:, NEXT]
