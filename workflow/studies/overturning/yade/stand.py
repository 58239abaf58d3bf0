"""Entry point: whether blocks of any shape fall from a shaken table, in one YADE process.

    python3 yade_scripts stand --list blocks.json --output outcomes.json

The file holds a list; each entry is one history:

    id             text, unique
    scene          a scene with one free block, as `scene.to_json` writes it, its text
    motion         path of a motion file with columns time_s, ground_m_s2
    fallen_rad     tilt of the block's upright axis, to whatever side, from which it has fallen
    step_fraction  of the critical step

The outcomes say of each its id, status ("stood", "fell" or "failed"), the largest tilt [rad], the
largest twist about the vertical [rad], how far its centre of mass moved along the table while it
leaned by less than half of `fallen_rad`, tilting included [m], dt_s, steps and wall_s.
"""

import json
import math

from yade_scripts.commands import command
from yade_scripts.engine import adapter, loop, simulate
from yade_scripts.engine.poses import rotation
from yade_scripts.files import read_json, write_atomic
from yade_scripts.lists import listed
from yade_scripts.model import floor_motions
from yade_scripts.model.floor_motions import GROUND
from yade_scripts.model.scene import from_dict

KEYS = ("id", "scene", "motion", "fallen_rad", "step_fraction")
AFTER_S = 4.0  # behind the motion's end
REST_M_S, REST_S = 1e-2, 0.5  # of the watched point


class Tilt:
    """Follows the tilt of a scene's block to any side; ends the run when it has fallen."""

    def __init__(self, scene, fallen_rad):
        """Of a scene with one free block."""
        self.index = next(i for i, block in enumerate(scene.blocks) if block.free)
        self.table, self.fallen_rad = scene.index(scene.reference), fallen_rad
        self.tilt_rad = self.twist_rad = self.moved_m = 0.0
        self.fell = False

    def attach(self, built):
        """Take hold of the built scene."""
        self.state = built.omega.bodies[built.body[self.index]].state
        self.unturned = built.unturned[self.index]
        self.support = built.omega.bodies[built.body[self.table]].state
        self.start = self._place()

    def _place(self):
        return [float(self.state.pos[i] - self.support.pos[i]) for i in (0, 1)]

    def __call__(self):
        """Take a sample."""
        turned = rotation(self.state.ori * self.unturned)
        tilt = math.acos(max(-1.0, min(1.0, turned[8])))
        self.tilt_rad = max(self.tilt_rad, tilt)
        if not tilt < self.fallen_rad:  # takes what is not a number too
            self.fell = math.isfinite(tilt)
            loop.stop()
            return
        self.twist_rad = max(self.twist_rad, abs(math.atan2(turned[3], turned[0])))
        if tilt < 0.5 * self.fallen_rad:
            place = self._place()
            moved = math.dist(place, self.start)
            self.moved_m = max(self.moved_m, moved)


def shaken(entry):
    """Outcome of one entry, as the module says."""
    time_s, columns = floor_motions.read(entry["motion"])
    scene = from_dict(json.loads(entry["scene"]))
    ground = adapter.SupportMotion(time_s, columns["ground"])
    rules = simulate.StopRules(
        motion_s=float(time_s[-1]),
        limit_s=float(time_s[-1]) + AFTER_S,
        rest_velocity_m_s=REST_M_S,
        rest_time_s=REST_S,
        max_speed_m_s=1e4,
    )
    step, _ = simulate.choose_step(scene, {"step_fraction": entry["step_fraction"]})
    tilt = Tilt(scene, entry["fallen_rad"])
    history = simulate.run(
        scene, {GROUND: ground}, step, rules, check=tilt, making=simulate.Making(full_rotation=True)
    )
    fell = tilt.fell or history.status == simulate.OVERTURNED
    status = "failed" if history.status == simulate.FAILED else "fell" if fell else "stood"
    values = {key: getattr(tilt, key) for key in ("tilt_rad", "twist_rad", "moved_m")}
    values |= {"dt_s": history.dt_s, "steps": history.steps, "wall_s": history.wall_s}
    return {"id": entry["id"], "status": status, **values}


def main(arguments=None):
    """Parse the command line, run, write the outcomes; return the exit status."""
    texts = {"list": "histories (JSON)", "output": "outcomes to write (JSON)"}
    args = command.parser(__doc__, **texts).parse_args(arguments)
    entries, say = read_json(args.list), command.progress("stand")
    if not isinstance(entries, list) or not entries:
        raise ValueError(f"{args.list}: expected a list of histories")
    for number, entry in enumerate(entries, 1):
        if missing := [key for key in KEYS if key not in entry]:
            raise ValueError(f"{args.list}: history {number} has no {listed(missing)}")
    adapter.load_yade()
    outcomes = []
    for number, entry in enumerate(entries, 1):
        outcomes.append(shaken(entry))
        say(f"{number} of {len(entries)}: {entry['id']}, {outcomes[-1]['status']}")
        write_atomic(args.output, json.dumps(outcomes).encode())
    return 0
