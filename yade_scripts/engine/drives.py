"""Engines of motions: forces that move supports, and inertia forces in a frame that moves."""

from yade_scripts.model.motion import numbers
from yade_scripts.model.scene import DOFS


def force(w, motion, mass_kg, axis, ids):
    """Engine of the force mass·a along an axis (0, 1, 2) on each body; a is the motion's."""
    return w.InterpolatingDirectedForceEngine(
        times=numbers(motion.time_s),
        magnitudes=(mass_kg * motion.acceleration_m_s2).tolist(),
        direction=tuple(int(i == axis) for i in range(3)),
        ids=ids,
        wrap=False,
    )


def set_back(state, axis, acceleration_m_s2, dt_s):
    """Take a body's velocity half a step back, where velocities live, under its acceleration."""
    velocity = list(state.vel)
    velocity[axis] -= 0.5 * dt_s * float(acceleration_m_s2)
    state.vel = tuple(velocity)


def shake(w, scene, motion, body, omega, axis):
    """Inertia forces −m·a of the blocks free along an axis (1: y, 2: z), as engines.

    They belong to the frame that moves with the motion along that axis.
    """
    groups: dict[float, list] = {}
    same: dict[str, float] = {}  # masses that differ by rounding alone share an engine
    for index, block in enumerate(scene.blocks):
        if DOFS[axis] in block.free:
            mass = same.setdefault(f"{block.mass_kg:.10g}", block.mass_kg)
            groups.setdefault(mass, []).append(body[index])
            state = omega.bodies[body[index]].state
            set_back(state, axis, -motion.acceleration_m_s2[0], omega.dt)
    return [force(w, motion, -mass, axis, ids) for mass, ids in groups.items()]
