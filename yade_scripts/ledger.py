"""Energy that comes from nowhere: the check that tells an unstable run from a collapse.

A time step that is too long for the contacts feeds energy into the façade until it
overturns, at speeds that look harmless. In the frame of the base the energy of the block

    E = ½ m |v − v_g|² + ½ ωᵀ I ω + m g Δz

changes by the work of three things only: the inertia forces −m a_g, the return walls that
move relative to the base, and the contacts, which store and dissipate. Contacts cannot give
more than they were given, so at every sample

    E(t) − E(0) − ∫ −m a_g (v − v_g) dt − Σ_j ∫ F_j (v_j − v_g) dt ≤ 0

but for the integration of the samples. More than TOLERANCE of the energy that overturns the
block, m g (R − h/2), is a numerical failure. Stable runs stay below 0.01, whatever the record;
the check cannot see an instability whose gain is smaller than what the contacts dissipate
meanwhile, which is why the step is compared with the critical one before any run.
"""

import math

DRIVE = "InterpolatingDirectedForceEngine"  # moves the supports
TOLERANCE = 0.1  # of the energy that overturns the block


class EnergyLedger:
    """Adds up the energy of a scene's only free block; stops the run when it is too much.

    Pass it to `simulate.run` as `check`, then read `reason` after the run.

    Attributes
    ----------
    reason : str
        Why the run was stopped; empty if it was not.
    excess : float
        Largest energy from nowhere so far, over the energy that overturns the block.
    """

    def __init__(self, scene, motions):
        """Prepare the ledger of a run; it stays idle where several blocks are free."""
        free = [i for i, block in enumerate(scene.blocks) if block.free]
        self.scene, self.motions = scene, motions
        self.index = free[0] if len(free) == 1 else None
        self.reason, self.excess, self.iteration = "", 0.0, None

    def attach(self, built):
        """Take hold of the built scene; return whether it is to be sampled."""
        if self.index is None:
            return False
        scene, omega = self.scene, built.omega
        block, reference = scene.blocks[self.index], scene.index(scene.reference)
        self.omega, self.state = omega, omega.bodies[built.body[self.index]].state
        self.base = omega.bodies[built.body[reference]].state
        self.forces = omega.forces
        names = sorted({b.motion for b in scene.blocks if not b.free and b.motion})
        drives = [e for e in omega.engines if type(e).__name__ == DRIVE]
        curves = {name: _Curve(self.motions[name]) for name in names}
        self.ground = curves.get(scene.blocks[reference].motion, lambda t: 0.0)
        self.walls = []
        for name, drive in zip(names, drives, strict=True):
            # with one motion no support moves relative to the base, and nothing works
            if len(names) > 1 and name != scene.blocks[reference].motion:
                states = [(i, omega.bodies[i].state) for i in drive.ids]
                self.walls += [(i, state, state.mass, curves[name]) for i, state in states]
        self.mass, self.inertia = block.mass_kg, block.inertia_kg_m2
        self.weight, self.height = block.mass_kg * scene.gravity_m_s2, block.centre_m[2]
        depth, height = block.size_m[1], block.size_m[2]
        self.scale = self.weight * 0.5 * (math.hypot(depth, height) - height)
        self.start, self.before, self.work = None, (0.0, 0.0), 0.0
        return True

    def __call__(self):
        """Take a sample; indices, since unpacking YADE's vectors is many times slower."""
        t, ground = self.omega.time, self.base.vel[1]
        velocity, spin, inertia = self.state.vel, self.state.angVel, self.inertia
        x, y, z = velocity[0], velocity[1] - ground, velocity[2]
        energy = 0.5 * self.mass * (x * x + y * y + z * z)
        energy += self.weight * (self.state.pos[2] - self.height)
        for axis in (0, 1, 2):
            energy += 0.5 * inertia[axis] * spin[axis] ** 2
        power = -self.mass * self.ground(t) * y
        for i, wall, mass, curve in self.walls:
            # what acts on a wall less what drives it is the façade's push on it
            pushed = self.forces.f(i)[1] - mass * curve(t)
            power -= pushed * (wall.vel[1] - ground)
        if self.start is None:
            self.start, self.before = energy, (t, power)
        self.work += 0.5 * (power + self.before[1]) * (t - self.before[0])
        self.before = t, power
        excess = (energy - self.start - self.work) / self.scale
        if self.reason:
            return
        if not excess <= TOLERANCE:  # also where it is not a number
            self.reason = (
                f"energy from nowhere, {excess:.3g} of what overturns the façade, "
                f"at t = {t:.4f} s: numerical failure"
            )
            self.omega.stopAtIter = self.omega.iter + 1  # see simulate._Monitor._stop
        self.excess = max(self.excess, excess) if math.isfinite(excess) else math.inf


class _Curve:
    """Acceleration of a motion at ascending times [m/s²], linear between samples."""

    def __init__(self, motion):
        self.time, self.value, self.at = motion.time_s, motion.acceleration_m_s2, 0

    def __call__(self, t):
        time, value, i = self.time, self.value, self.at
        while i < len(time) - 2 and time[i + 1] < t:
            i += 1
        self.at = i
        if t >= time[-1]:
            return float(value[-1])
        share = (t - time[i]) / (time[i + 1] - time[i])
        return float(value[i] + share * (value[i + 1] - value[i]))
