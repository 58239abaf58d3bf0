"""Entry point: poses of all blocks through one run, for pictures and animations.

    python3 yade_scripts frames --scene cases/W2.json --motion smdof/RRS228_4dof.csv
        --record RRS228 --direction neg --pga 0.2 --output frames.json [--fall 2] [--contacts]

The poses are YADE's state at each frame: nothing is drawn that was not computed. With --contacts
the velocities of the blocks and the forces of their contacts are kept too.
"""

import json
from dataclasses import replace
from typing import Any

import numpy as np

from yade_scripts.commands import command, shaking
from yade_scripts.engine import adapter, balance, loop
from yade_scripts.engine.poses import planar_turn
from yade_scripts.files import write_atomic

INTERVAL_S = 0.02  # between frames


class Camera:
    """Keeps the pose of every block at every interval [s], and on request what acts on it."""

    def __init__(self, scene, interval_s, contacts=False):
        """Prepare for a scene; `attach` is the `setup` of `simulate.run`."""
        self.scene, self.interval_s, self.rows, self.times = scene, interval_s, [], []
        self.balance: Any = balance.EnergyBalance(scene) if contacts else None
        self.velocities: list = []
        self.contacts: list = []

    def attach(self, built):
        """Start the frames."""
        self.omega = omega = built.omega
        self.states = [omega.bodies[i].state for i in built.body]
        self.start = [tuple(float(v) for v in s.pos) for s in self.states]
        self.unturned = [built.unturned.get(i) for i in range(len(self.states))]
        if self.balance:
            self._number(built)
        omega.engines = [*omega.engines, loop.runner(self, round(self.interval_s / omega.dt))]

    def _number(self, built):
        """Know which block a contact's ends belong to, and which of two is to be named."""
        self.balance.hold(built)
        self.block_of = {self.balance.slot[body]: i for i, body in enumerate(built.body)}
        watched = {self.scene.index(name) for name, _ in self.scene.watched}
        blocks = enumerate(self.scene.blocks)
        self.rank = {i: (i not in watched, not block.free, i) for i, block in blocks}

    def __call__(self):
        """Keep displacement and rotation of every block."""
        row = []
        for state, start, unturned, block in zip(
            self.states, self.start, self.unturned, self.scene.blocks, strict=True
        ):
            p = state.pos  # a clump's own frame may be turned by half a turn
            angle = 0.0 if unturned is None else planar_turn(state, unturned)
            dy = p[1] - start[1] + block.displacement_m[1]
            dz = p[2] - start[2] + block.displacement_m[2]
            row.append([round(float(v), 7) for v in (dy, dz, angle)])
        self.rows.append(row)
        self.times.append(round(float(self.omega.time), 6))
        if self.balance:
            self._act()

    def _act(self):
        """Keep the velocities of the blocks, and places and forces of their contacts."""
        rates = [(s.vel[1], s.vel[2], s.angVel[0]) for s in self.states]
        self.velocities.append(np.round(np.array(rates, float), 7).tolist())
        self.contacts.append(self._forces(self.balance.contacts()).tolist())

    def _forces(self, contacts):
        """Place [m], force [N] and block it acts on, a row a node; preloads of a bond cancel.

        Of two blocks it is the one that the run watches, or else the free one of lower number.
        """
        rows: dict = {}
        for k, (body, other) in enumerate(contacts.keys):
            ends = self.block_of.get(contacts.a[k], -1), self.block_of.get(contacts.b[k], -1)
            on = min((end for end in ends if end >= 0), key=lambda end: self.rank[end])
            force = contacts.force[k] if on == ends[1] else -contacts.force[k]
            node = self.balance.bond_of.get(body, self.balance.bond_of.get(other, (body, other)))
            rows.setdefault((node, on), []).append((contacts.point[k], force))
        acting = [
            (*np.mean([p for p, _ in parts], axis=0), *np.sum([f for _, f in parts], axis=0), on)
            for (_, on), parts in rows.items()
        ]
        table = np.round(np.array(acting, float).reshape(-1, 7), 6)
        return table[np.any(table[:, 3:6] != 0.0, axis=1)]

    def write(self, path, history, **facts):
        """Write the frames of a run.

        time_s; moved, shape (frames, blocks, 3): displacement along y and z of each centroid [m]
        and rotation about x [rad]; blocks; d_over_b, status and the facts. With contacts also
        velocity, of the same shape [m/s, rad/s], and contacts, a list a frame of place [m], force
        [N] (x, y, z each) and number of the block that it acts on.
        """
        blocks = [
            {
                "name": b.name,
                "centre_m": list(map(float, b.centre_m)),
                "size_m": list(map(float, b.size_m)),
                "free": b.free,
            }
            for b in self.scene.blocks
        ]
        d = np.interp(self.times, history.time_s, history.d_m) / self.scene.thickness_m
        frames = {
            "time_s": self.times,
            "moved": self.rows,
            "blocks": blocks,
            "d_over_b": np.round(d, 6).tolist(),
            "status": history.status,
            **({"velocity": self.velocities, "contacts": self.contacts} if self.balance else {}),
            **facts,
        }
        write_atomic(path, json.dumps(frames, separators=(",", ":")) + "\n")


def main(arguments=None):
    """Parse the command line, run, write the frames; return the exit status."""
    parser = command.parser(__doc__, *command.CURVE, output="frames to write (JSON)")
    parser.add_argument("--pga", type=float, required=True, help="intensity [g]")
    parser.add_argument("--fall", type=float, default=1.0, help="d/b at which to stop")
    parser.add_argument("--contacts", action="store_true", help="keep forces and velocities")
    args = parser.parse_args(arguments)
    case, time_s, columns = command.opened(args)
    adapter.load_yade()
    shaken = shaking.of_case(case, time_s, columns, args.direction, args.pga)
    shaken = replace(
        shaken,
        rules=replace(shaken.rules, overturn_ratio=args.fall),
        sample_s=min(INTERVAL_S, shaken.sample_s),
    )
    camera = Camera(shaken.scene, INTERVAL_S, args.contacts)
    history = shaken.run(setup=camera.attach)
    facts = {"model": case["model"], "record": args.record, "direction": args.direction}
    camera.write(args.output, history, pga_g=args.pga, **facts)
    return 0
