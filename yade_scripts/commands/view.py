"""Entry point: a scene in YADE's own viewer, ready to play.

    python3 yade_scripts view --scene cases/W2.json --motion smdof/RRS228_4dof.csv
        --record RRS228 --direction neg --pga 0.2

opens YADE's viewer and controller with the scene as the analyses run it; press Play. Blocks that
nothing drives are solid. Return walls and base are frames that follow their motion: the faces that
stand for them in contact are many times larger than a wall, and hidden.
"""

import contextlib
import os
import shutil
import sys
from pathlib import Path

if __name__ == "__main__":  # started by YADE's own program, which sets no path
    sys.path.insert(0, str(Path(sys.argv[0]).resolve().parents[2]))

from yade_scripts.commands import command, shaking
from yade_scripts.engine import adapter, loop

FOLLOW_S = 0.005  # between two places of a frame
SHOWN_M = 2.2  # of the return walls, which are longer than needed
COLOURS = {True: (0.79, 0.51, 0.42), False: (0.68, 0.72, 0.76)}  # free, support


class Ready(Exception):
    """The scene is built; nothing has run."""


def dress(scene, built):
    """Draw the blocks: free ones solid, supports as frames that follow them.

    Returned are YADE's id of each frame by the block's name, and ids of what is not to be drawn.
    """
    from yade import utils

    omega = built.omega
    carriers, frames, follow = set(), {}, []
    for index, block in enumerate(scene.blocks):
        body = omega.bodies[built.body[index]]
        if block.free:
            first = min(body.shape.members) if body.isClump else body.id
            carriers.add(first)
            omega.bodies[first].shape.color = COLOURS[True]
            omega.bodies[first].shape.wire = False
            continue
        half = [0.5 * min(size, SHOWN_M) for size in block.size_m]
        centre = list(block.centre_m)
        centre[1] += 0.5 * block.size_m[1] - half[1]  # its face towards the façade stays
        centre[2] += (0.5 * block.size_m[2] - half[2]) * (block.name == scene.reference)
        half[2] = half[2] if block.name == scene.reference else 0.5 * block.size_m[2]
        box = utils.box(tuple(centre), tuple(half), fixed=True, wire=True, mask=0)
        box.shape.color = COLOURS[False]
        frames[block.name] = omega.bodies.append(box)
        support = omega.bodies[built.body[index]].state
        follow.append((box.state, support, box.state.pos - support.pos))

    def move():
        for state, support, apart in follow:
            state.pos = support.pos + apart

    loop.between(move, round(FOLLOW_S / omega.dt))
    carriers.update(frames.values())
    drawn = [b.id for b in omega.bodies if b.shape and not b.isClump]
    return frames, [i for i in drawn if i not in carriers]


def read(arguments):
    """What the command line names: the words, the case, time and accelerations of the motion."""
    parser = command.parser(__doc__, *command.CURVE)
    parser.add_argument("--pga", required=True, type=float, help="intensity [g]")
    args = parser.parse_args(arguments)
    return args, *command.opened(args)


def opened(arguments):
    """Build the scene that the command line names; return it with its handles in YADE."""
    args, case, time_s, columns = read(arguments)
    run = shaking.of_case(case, time_s, columns, args.direction, args.pga)
    handles = []

    def setup(built):
        handles.append(built)
        raise Ready

    with contextlib.suppress(Ready):
        run.run(setup=setup)
    return run.scene, handles[0]


def show(arguments):
    """Build and open the viewer; runs inside YADE's own program."""
    adapter.load_yade()
    from yade import qt

    scene, built = opened(arguments)
    _, hidden = dress(scene, built)
    loop.from_engines(built.omega)
    qt.Controller()
    view, renderer = qt.View(), qt.Renderer()
    for body in hidden:
        renderer.hideBody(body)
    renderer.mask = 0  # blocks touch nothing, so they belong to no group: draw all groups
    renderer.bgColor = (1.0, 1.0, 1.0)
    height = max(b.centre_m[2] + 0.5 * b.size_m[2] for b in scene.blocks)
    view.viewDir, view.upVector = (-0.75, -0.6, -0.2), (0.0, 0.0, 1.0)
    view.fitAABB((-height, -height, -0.2 * height), (height, height, 1.2 * height))
    return view


def main(arguments=None):
    """Hand over to YADE's own program, which has the viewer.

    It would show a mistake as a stack of calls beside its prompt: what is named is read here first.
    """
    read(arguments)
    program = shutil.which("yade")
    if program is None:
        raise ValueError("YADE's program is not on the path: install Debian's package 'yade'")
    if not os.environ.get("DISPLAY"):
        raise ValueError("no display: YADE's viewer needs one (DISPLAY is not set)")
    os.execv(program, [program, str(Path(__file__).resolve()), *arguments])


if __name__ == "__main__":
    try:
        VIEW = show(sys.argv[1:])
    except (ValueError, OSError, adapter.EngineError, ImportError) as error:
        print(f"error: {error}", file=sys.stderr, flush=True)
        adapter.load_yade().Omega().exitNoBacktrace(1)
