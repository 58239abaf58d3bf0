"""The viewer's scene without a display; imported inside YADE's Python."""

from yade_scripts.commands import view
from yade_scripts.engine import loop


def played(arguments, until_s):
    """How far the supports' frames and the façade have moved when YADE has run by itself [m]."""
    scene, built = view.opened(arguments)
    frames, _ = view.dress(scene, built)
    loop.from_engines(built.omega)
    omega = built.omega
    bodies, facade = omega.bodies, omega.bodies[built.body[scene.index(scene.monitor)]].state
    start = {name: bodies[i].state.pos[1] for name, i in frames.items()}
    began = facade.pos[1]
    omega.run(round(until_s / omega.dt), True)
    return {
        "motions": {name: scene.blocks[scene.index(name)].motion for name in frames},
        "frames": {name: bodies[i].state.pos[1] - start[name] for name, i in frames.items()},
        "facade_m": facade.pos[1] - began,
        "time_s": omega.time,
    }
