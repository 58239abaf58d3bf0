"""What test_friction runs inside YADE's Python; thrown blocks are for the compiled solver too."""

from dataclasses import replace

import numpy as np

from yade_scripts.model import facade, models


def thrown(config, beta_s, speed_m_s, drag=1.0):
    """A free block at rest on its base, thrown outward along it, `drag` along the joint."""
    scene = facade.facade_scene(config, "free", beta_s)
    scene.nodes.drag = np.full(len(scene.nodes), drag)
    number = scene.index(scene.monitor)
    scene.blocks[number] = replace(scene.blocks[number], velocity_m_s=(0.0, speed_m_s, 0.0))
    return scene


def slide(config, beta_s, speed_m_s, drag, dt_s, limit_s):
    """Way of a thrown block by the end of a run."""
    from yade_scripts.engine import adapter, simulate

    scene = thrown(config, beta_s, speed_m_s, drag)
    still = {
        name: adapter.SupportMotion(np.array([0.0, 1.0]), np.zeros(2)) for name in scene.motions
    }
    rules = simulate.StopRules(limit_s, limit_s, overturn_ratio=1e9)
    return float(simulate.run(scene, still, dt_s, rules, sample_s=0.01).d_m[-1])


class _Forces:
    """Largest |T| − μN of dry nodes over their force, from what acts on their spheres."""

    def __init__(self, scene):
        self.scene, self.most, self.steps, self.seen = scene, 0.0, 0, 0

    def attach(self, built):
        """Look at the nodes after every step."""
        from yade_scripts.engine import loop

        self.omega, self.built = built.omega, built
        self.slope = np.tan(self.scene.nodes.friction_rad)
        self.node = {body: i for i, body in enumerate(built.node_body)}
        loop.between(self, 1, first=1)

    def __call__(self):
        """Take the forces of the last step."""
        self.steps += 1
        for contact in self.omega.interactions:
            i = self.node.get(contact.id1, self.node.get(contact.id2))
            if i is None or not contact.isReal:
                continue
            sphere = contact.id1 if contact.id1 in self.node else contact.id2
            force, pressed = self.omega.forces.f(sphere), contact.phys.normalForce
            pressed = pressed if force.dot(pressed) > 0.0 else -pressed
            along, limit = (force - pressed).norm(), self.slope[i] * pressed.norm()
            self.seen += 1
            self.most = max(self.most, (along - limit) / max(force.norm(), 1e-3))


def shears(job, time_s, columns):
    """Largest |T| − μN over the node's force, over all nodes and steps, and how many there were."""
    from yade_scripts.commands import shaking

    scene, columns = models.build_scene(job), {k: np.array(v) for k, v in columns.items()}
    forces = _Forces(scene)
    case = shaking.set_up(scene, models.numerics(job), np.array(time_s), columns, 1.0)
    history = case.run(setup=forces.attach)
    return {
        "excess": forces.most,
        "steps": forces.steps,
        "forces": forces.seen,
        "status": history.status,
        "peak": history.peak_d_over_b,
    }
