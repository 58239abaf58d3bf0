"""Energy that comes from nowhere: the check that tells an unstable run from a collapse.

A time step that is too long for the contacts feeds energy into the façade until it
overturns, at speeds that look harmless. In the frame of the base the energy of the free
blocks

    E = Σ ½ m |v − v_g|² + ½ ωᵀ R I Rᵀ ω + m g Δz

changes by the work of three things only: the inertia forces −m a_g and, under a vertical motion,
−m a_z; whatever moves relative to the base (one-way coupled return walls, bricks guided along y);
and the contacts, which store and dissipate. Contacts cannot give more than they were given and
what they hold at the start under the blocks' weight, U(0) = Σ N²/2kn + T²/2ks, so at every sample

    E(t) − E(0) − ∫ Σ −m a_g (v − v_g) − m a_z v_z dt − ∫ Σ_j −F_j (v_j − v_g) dt ≤ U(0)

with F_j the contacts' force on what is moved, but for the integration of the samples. Masses
joined by links are moved too, as far as the façade is concerned: their own energy is many
times the façade's, and the samples' error on it would hide what is looked for. More
than TOLERANCE of the energy that overturns the façade, m g (R − h/2), is a numerical
failure. The check cannot see an instability whose gain is smaller than what the contacts
dissipate meanwhile, which is why the step is compared with the critical one before any run.
"""

import math
from bisect import bisect_left
from typing import Any

from yade_scripts.engine import floors, loop
from yade_scripts.engine.links import built_stiffness
from yade_scripts.model.motion import numbers
from yade_scripts.model.storeys import sliding

DRIVE = "InterpolatingDirectedForceEngine"  # moves the supports
TOLERANCE = 0.1  # of the energy that overturns the façade


class EnergyCheck:
    """Adds up the energy of a scene's free blocks; stops the run when it is too much.

    Pass it to `simulate.run` as `check`, then read `reason`, why the run was stopped, or empty.
    `excess` is the largest energy from nowhere over that which overturns the façade; `energy` and
    `work` are E(t) − E(0) and the work done on the free blocks since, `stored` U(0) [J].
    """

    def __init__(self, scene, motions):
        """Prepare the energy check of a run."""
        self.scene, self.motions = scene, motions
        self.reason, self.excess, self.energy, self.stored = "", 0.0, 0.0, 0.0

    def attach(self, built):
        """Take hold of the built scene."""
        scene, omega = self.scene, built.omega
        frame = scene.index(scene.reference)
        if scene.blocks[frame].free:  # it hangs on masses, in the frame of what they stand on
            frame = next(i for i, block in enumerate(scene.blocks) if not block.free)
        reference = scene.blocks[frame]
        self.omega, self.forces, self.links = omega, omega.forces, built.links
        self.sliders = []  # (block of id1, block of id2, physics)
        for k in sliding(scene) if scene.shaking else ():
            floor, pair = scene.floors[k], built.floors[k]
            blocks = dict(zip(pair, (floor.a, floor.b), strict=True))
            contact = omega.interactions[pair]
            self.sliders.append((blocks[contact.id1], blocks[contact.id2], contact.phys))
        self.nodes = set(built.node_body)
        self.base = omega.bodies[built.body[frame]].state
        names = sorted({(n, k) for b in scene.blocks if not b.free for k, n in b.drives})
        drives = [e for e in omega.engines if type(e).__name__ == DRIVE]
        curves = {name: _Curve(self.motions[name]) for name, _ in names}
        self.walls, self.masses = [], []
        if scene.shaking:
            self.ground: Any = _Curve(self.motions[scene.shaking])
            names, drives = [], []
        else:
            self.ground = curves.get(reference.motion, lambda t: 0.0)
        self.ground_x: Any = curves.get(reference.motion_x, lambda t: 0.0)
        self.lift = _Curve(self.motions[scene.vertical]) if scene.vertical else lambda t: 0.0
        # driven, a floor of its own mass is one more free block, whose springs only store
        links = scene.links if scene.shaking else ()
        linked = {i for link in links for i in (link.a, link.b) if scene.blocks[i].free}
        still = {reference.motion, reference.motion_x}
        driving = drives[: len(names)]  # inertia follows
        for (name, axis), drive in zip(names, driving, strict=True):
            # with one motion no support moves relative to the base, and nothing works
            if len(names) > 1 and name not in still:
                states = [(i, omega.bodies[i].state) for i in drive.ids]
                self.walls += [(i, axis, state, state.mass, curves[name]) for i, state in states]
        self.free, self.guided = [], []
        self.raised = floors.Raised(scene, built)
        for index, block in enumerate(scene.blocks):
            if block.free:
                body = built.body[index]
                turns = 3 if {"Y", "Z"} & set(block.free) else 1  # in its plane about x alone
                entry = (
                    omega.bodies[body].state,
                    block.mass_kg,
                    block.inertia_kg_m2[:turns],
                    0.0 if block.weightless else block.mass_kg * scene.gravity_m_s2,
                    block.centre_m[2],
                )
                if index in linked:
                    self.masses.append((index, body, *entry[:2], entry[0].pos[1]))
                elif block.motion:
                    self.guided.append((body, *entry))
                else:
                    self.free.append(entry)
        self.scale = scene.overturning_energy_j
        self.start, self.before, self.work = None, (0.0, 0.0), 0.0

    def __call__(self):
        """Take a sample; indices, since unpacking YADE's vectors is many times slower."""
        t, ground = self.omega.time - self.omega.dt, self.base.vel[1]  # of the forces
        beside = self.base.vel[0]
        pull, pull_x, lift = self.ground(t), self.ground_x(t), self.lift(t)
        energy = self.raised()
        power = -lift * self.raised.momentum()
        for state, mass, inertia, weight, height in self.free:
            velocity = state.vel
            x, y, z = velocity[0] - beside, velocity[1] - ground, velocity[2]
            energy += 0.5 * mass * y * y + _energy(state, mass, inertia, weight, height, x, z)
            power -= mass * (pull * y + pull_x * x + lift * z)
        for body, state, mass, inertia, weight, height in self.guided:
            velocity = state.vel
            z = velocity[2]
            energy += _energy(state, mass, inertia, weight, height, velocity[0], z)
            power -= self.forces.f(body)[1] * (velocity[1] - ground) + mass * lift * z
        for i, axis, wall, mass, curve in self.walls:
            # what acts on a wall less what drives it is the façade's push on it
            pushed = self.forces.f(i)[axis] - mass * curve(t)
            power -= pushed * (wall.vel[axis] - (ground if axis else beside))
        for pushed, speed in self._pushes(pull):
            power -= pushed * speed
        if self.start is None:
            self.start, self.before = energy, (t, power)
            self.stored = self._held()
        self.work += 0.5 * (power + self.before[1]) * (t - self.before[0])
        self.before = t, power
        self.energy = energy - self.start
        excess = (self.energy - self.work - self.stored) / self.scale
        if self.reason:
            return
        if not excess <= TOLERANCE:  # also where it is not a number
            self.reason = (
                f"energy from nowhere, {excess:.3g} of what overturns the façade, "
                f"at t = {t:.4f} s: numerical failure"
            )
            loop.stop()
        self.excess = max(self.excess, excess) if math.isfinite(excess) else math.inf

    def _held(self):
        """Energy in the closed dry nodes [J]; a bond's two preloads never come free together."""
        total = 0.0
        for contact in self.omega.interactions:
            if contact.isReal and not self.nodes.isdisjoint((contact.id1, contact.id2)):
                law = contact.phys
                total += 0.5 * law.normalForce.squaredNorm() / law.kn
                total += 0.5 * law.shearForce.squaredNorm() / law.ks if law.ks > 0.0 else 0.0
        return total

    def height_j(self):
        """Weight times height of free blocks and loads above their reference position [J]."""
        blocks = (*self.free, *(entry[1:] for entry in self.guided))
        of_blocks = sum(weight * (state.pos[2] - height) for state, _, _, weight, height in blocks)
        return of_blocks + self.raised()

    def _pushes(self, pull):
        """Force on each mass [N] but of links, sliding storeys and inertia; its speed [m/s]."""
        dt, at, force = self.omega.dt, {}, {}
        for index, body, state, mass, start in self.masses:
            # the step's links saw the position at its start, the velocity half a step earlier
            total, speed = self.forces.f(body)[1], state.vel[1]
            at[index] = state.pos[1] - dt * speed - start, speed - dt * total / mass
            force[index] = total + mass * pull
        for link in self.links:
            (y, v), (y_b, v_b) = (at.get(i, (0.0, 0.0)) for i in (link.a, link.b))
            held = built_stiffness(link) * (y - y_b) + link.dashpot_ns_m * (v - v_b)
            for i, sign in ((link.a, 1.0), (link.b, -1.0)):
                if i in force:
                    force[i] += sign * held
        for first, second, law in self.sliders:
            shear = law.shearForce[1]  # on the second
            for i, sign in ((first, 1.0), (second, -1.0)):
                if i in force:
                    force[i] += sign * shear
        return [(force[index], state.vel[1]) for index, _, state, *_ in self.masses]


def _energy(state, mass, inertia, weight, height, x, z):
    """Energy of a block but for its motion along y [J]; x, z: its velocity past the base."""
    spin, turning = state.angVel, 0.0
    if len(inertia) > 1:  # about axes that turn with the block
        spin = state.ori.inverse() * spin
    for axis, about in enumerate(inertia):
        turning += about * spin[axis] ** 2
    return 0.5 * (mass * (x * x + z * z) + turning) + weight * (state.pos[2] - height)


class _Curve:
    """Acceleration of a motion at any time [m/s²], linear between samples, then the last."""

    def __init__(self, motion):
        # plain numbers, with which Python reckons several times faster than with numpy's
        self.time, self.value = numbers(motion.time_s), memoryview(motion.acceleration_m_s2)

    def __call__(self, t):
        time, value = self.time, self.value
        if t >= time[-1]:
            return value[-1]
        i = max(bisect_left(time, t) - 1, 0)
        share = (t - time[i]) / (time[i + 1] - time[i])
        return value[i] + share * (value[i + 1] - value[i])
