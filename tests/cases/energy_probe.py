"""Energy of a running scene: kinetic, potential and elastic, at whole steps.

A probe for `simulate.run(setup=probe.attach)`. The scheme knows positions at whole
steps and velocities between them; kinetic energy is that of the mean velocity of the
two half steps around each sample, so that a conservative scene keeps its sum to second
order in the step.
"""

import numpy as np

from yade_scripts.engine import adapter, loop


class EnergyProbe:
    """Samples the energies of a scene's free blocks.

    Attributes
    ----------
    rows : list of tuple
        time [s], kinetic, potential and elastic energy [J]; potential is zero in the
        reference position, elastic covers normal and shear springs of every contact.
    """

    def __init__(self, scene, sample_s=0.01):
        """Prepare the probe of a run."""
        self.scene, self.sample_s, self.rows = scene, sample_s, []

    def attach(self, built):
        """Place one runner before and one after the integrator."""
        wrapper, omega = adapter.load_yade(), built.omega
        self.omega = omega
        self.blocks = [
            (block, omega.bodies[built.body[i]].state)
            for i, block in enumerate(self.scene.blocks)
            if block.free
        ]
        period = max(1, round(self.sample_s / omega.dt))
        engines = list(omega.engines)
        at = next(i for i, e in enumerate(engines) if isinstance(e, wrapper.NewtonIntegrator))
        before, after = loop.runner(self._before, period), loop.runner(self._after, period)
        omega.engines = [*engines[:at], before, engines[at], after, *engines[at + 1 :]]

    def _before(self):
        """Keep positions' and contacts' energy at the step, and the velocities before it."""
        gravity = self.scene.gravity_m_s2
        self.potential = sum(
            b.mass_kg * gravity * (s.pos[2] - b.centre_m[2]) for b, s in self.blocks
        )
        self.elastic = 0.0
        for contact in self.omega.interactions:
            if contact.isReal:
                depth, shear = contact.geom.penetrationDepth, np.array(contact.phys.shearForce)
                self.elastic += 0.5 * contact.phys.kn * depth**2
                self.elastic += 0.5 * float(shear @ shear) / contact.phys.ks
        self.speed = [(np.array(s.vel), np.array(s.angVel)) for _, s in self.blocks]

    def _after(self):
        """Add the kinetic energy of the mean velocity."""
        kinetic = 0.0
        for (block, state), (velocity, spin) in zip(self.blocks, self.speed, strict=True):
            v = 0.5 * (velocity + np.array(state.vel))
            w = 0.5 * (spin + np.array(state.angVel))
            kinetic += 0.5 * block.mass_kg * v @ v
            kinetic += 0.5 * w @ (np.array(block.inertia_kg_m2) * w)
        self.rows.append((self.omega.time, float(kinetic), self.potential, self.elastic))

    @property
    def total(self):
        """Sum of the three energies at the samples, shape (n,) [J]."""
        return np.array([row[1:] for row in self.rows]).sum(axis=1)
