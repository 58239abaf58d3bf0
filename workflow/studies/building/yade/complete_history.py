"""Entry point: one history of the complete building, with the motion of its floors.

    python3 yade_scripts complete_history --scene complete/cases/CBc_6.json
        --motion smdof/RRS228_4dof.csv --direction neg --pga 0.1 --output history.csv
        --cost history.json [--until 6] [--apart]

Displacements are relative to the ground. With --apart façade and building stand each alone:
the nodes between them are left out.
"""

import resource
import time

import numpy as np

from studies.building.yade.complete import apart
from yade_scripts.commands import command, shaking
from yade_scripts.commands.tables import history_csv
from yade_scripts.engine import adapter, loop
from yade_scripts.files import write_atomic, write_json
from yade_scripts.model import models
from yade_scripts.model.motion import amplitude

SAMPLE_S = 0.005  # between samples
COLUMNS = ("time_s", "d_over_b", "top_m", "ends_m", "facade_m", "broken")


class Recorder:
    """Displacements along y at every interval [s]: see COLUMNS."""

    def __init__(self, scene, interval_s=SAMPLE_S):
        """`top` is the floor on top, `ends` the highest bricks behind the façade."""
        self.scene, self.interval_s, self.rows = scene, interval_s, []
        facade = scene.index(scene.monitor)
        behind = np.unique(scene.nodes.a[scene.nodes.b == facade])
        heights = np.array([scene.blocks[i].centre_m[2] for i in behind])
        highest = [int(i) for i in behind[heights >= heights.max(initial=0.0) - 1e-6]]
        self.groups = [[scene.index(scene.notes["top"])], highest, [facade]]

    def __call__(self, built):
        """Start recording; the `setup` of a run."""
        self.omega, self.bonds = built.omega, built.bonds
        states = [[built.omega.bodies[built.body[i]].state for i in g] for g in self.groups]
        self.states = [[(s, s.pos[1]) for s in group] for group in states]
        loop.between(self.sample, round(self.interval_s / built.omega.dt), first=1)

    def sample(self):
        """Keep time, displacements and the number of broken bonds."""
        moved = [
            sum(s.pos[1] - start for s, start in group) / len(group) if group else np.nan
            for group in self.states
        ]
        broken = len(self.bonds.broken) if self.bonds else 0
        self.rows.append((self.omega.time, *moved, broken))


def main(arguments=None):
    """Parse the command line, run, write history and cost; return the exit status."""
    words = [word for word in command.CURVE if word != "record"]
    texts = {"output": "history to write (CSV)", "cost": "outcome and cost (JSON)"}
    parser = command.parser(__doc__, *words, **texts)
    parser.add_argument("--pga", type=float, required=True, help="intensity [g]")
    parser.add_argument("--until", type=float, help="end of motion and run [s]")
    parser.add_argument("--apart", action="store_true", help="nothing between façade and building")
    args = parser.parse_args(arguments)
    case, time_s, columns = command.opened(args)
    scene, numerics = models.build_scene(case), models.numerics(case)
    if args.apart:
        scene = apart(scene)
    factor = amplitude(columns["ground"], args.direction, args.pga)
    if args.until is not None:
        kept = time_s <= args.until + 1e-9
        time_s, columns = time_s[kept], {"ground": columns["ground"][kept]}
        numerics = {**numerics, "after_motion_s": 0.0}
    adapter.load_yade()
    shaken = shaking.set_up(scene, numerics, time_s, columns, factor)
    recorder = Recorder(scene)
    cpu = time.process_time()
    history = shaken.checked(setup=recorder)
    cpu = time.process_time() - cpu
    rows = np.array(recorder.rows)
    d_over_b = np.interp(rows[:, 0], history.time_s, history.d_m) / scene.thickness_m
    lines = np.column_stack([rows[:, 0], d_over_b, rows[:, 1:]])
    write_atomic(args.output, history_csv({}, COLUMNS, lines, dict.fromkeys(COLUMNS, ".9g")))
    cost = {
        "blocks": len(scene.blocks),
        "nodes": len(scene.nodes),
        "status": history.status,
        "reason": history.reason,
        "d_over_b": float(history.peak_d_over_b),
        "step_s": history.dt_s,
        "steps": history.steps,
        "simulated_s": float(history.time_s[-1]),
        "cpu_s": cpu,
        "memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0,
    }
    write_json(args.cost, cost, sort_keys=True)
    return 0
