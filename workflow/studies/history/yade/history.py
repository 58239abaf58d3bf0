"""Entry point: one history of one model, its motions, contact forces and energies.

    python3 yade_scripts history --scene cases/W2.json --motion smdof/RRS228_4dof.csv
        --record RRS228 --direction neg --pga 0.2 --output histories/W2/RRS228_neg_0.2g.csv

The run is that of the analyses (step, energy check, stop rules), sampled every SAMPLE_S. Columns::

    d_over_b, velocity_m_s  top displacement relative to the base over b, and its rate
    rotation_rad            the façade's outward rotation
    {motion}_m_s2, {motion}_m  ground and floors as imposed: acceleration, displacement
    base_y_n, base_z_n, walls_y_n, walls_z_n  contacts' force on the façade (half of it in W3's
                            half model), outward and upward; without the dashpots' shear
    ties_y_n, floors_y_n    pull of its ties, and of its floors, on it, where it has any
    input_j                 since the start, in the frame of the base: work of inertia forces and
                            one-way coupled walls (see `energy_check`)
    kinetic_j, potential_j, elastic_j  of the free blocks and of the contacts' springs
    lost_j                  input − stored: dashpots, friction, broken bonds, the samples' error
"""

from dataclasses import replace

import numpy as np

from yade_scripts.commands import command, shaking
from yade_scripts.commands.tables import HEAD, history_csv, history_facts
from yade_scripts.engine import adapter, balance, energy_check, loop
from yade_scripts.files import write_atomic
from yade_scripts.model import floor_motions

SAMPLE_S = 0.01
FORCES = ("base_y_n", "base_z_n", "walls_y_n", "walls_z_n")
BARS = ("ties", "floors")
ENERGIES = ("input_j", "kinetic_j", "potential_j", "elastic_j", "lost_j")


class Probe:
    """Contact forces on the façade and energies at every sample; `attach` is a run's `setup`."""

    def __init__(self, scene, check):
        """Prepare for a scene whose run has the energy check `check` beside it."""
        self.balance, self.check, self.scene = balance.EnergyBalance(scene), check, scene
        self.rows: list[tuple] = []
        self.start = None

    def attach(self, built):
        """Start the samples, at the instants of the run's own."""
        self.balance.hold(built)
        slots, scene = self.balance.slot, self.scene
        self.facade = [slots[built.body[scene.index(name)]] for name, _ in scene.watched]
        self.base = slots[built.body[scene.index(scene.reference)]]
        self.chain = {body for parts in built.linked.values() for body in parts}
        loop.between(self, round(SAMPLE_S / built.omega.dt), first=1)

    def __call__(self):
        """Take a sample; the energy check comes after it, so bring that up to the same instant."""
        self.check()
        c = self.balance.contacts()
        sign = np.isin(c.b, self.facade).astype(float) - np.isin(c.a, self.facade)
        push = sign[:, None] * c.force[:, 1:]
        below = (c.a == self.base) | (c.b == self.base)
        own_keys = [getattr(self.balance, bar) for bar in BARS]
        pulls = [np.array([key in keys for key in c.keys], bool) for keys in own_keys if keys]
        base, walls = push[below].sum(axis=0), push[~np.any([below, *pulls], axis=0)].sum(axis=0)
        bars = [push[mine, 0].sum() for mine in pulls]
        counted = [not self.chain.intersection(key) for key in c.keys]  # not the chain's springs
        now = np.array([self.check.height_j(), c.elastic[counted].sum()])
        self.start = now if self.start is None else self.start
        potential, elastic = now - self.start
        kinetic, work = self.check.energy - potential, self.check.work
        lost = work - kinetic - potential - elastic
        self.rows.append((*base, *walls, *bars, work, kinetic, potential, elastic, lost))


def trace(shaken):
    """Run a `shaking.Shaking`, sampled every SAMPLE_S: its history, and values by column."""
    shaken = replace(shaken, sample_s=SAMPLE_S)
    scene = shaken.scene
    check = energy_check.EnergyCheck(scene, shaken.motions)
    probe = Probe(scene, check)
    history = shaken.checked(check, setup=probe.attach)
    values = {
        "time_s": history.time_s,
        "d_over_b": history.d_m / scene.thickness_m,
        "velocity_m_s": history.velocity_m_s,
        "rotation_rad": history.rotation_rad,
    }
    ahead = (floor_motions.GROUND, floor_motions.VERTICAL)
    for name in sorted(shaken.motions, key=lambda name: [name != first for first in ahead]):
        motion = shaken.motions[name]
        pulled = np.interp(history.time_s, motion.time_s, motion.acceleration_m_s2)
        values[f"{name}_m_s2"] = pulled
        values[f"{name}_m"] = motion.position(history.time_s)
    bars = [f"{bar}_y_n" for bar in BARS if getattr(probe.balance, bar)]
    probed = np.array(probe.rows[: len(history.time_s)]).T
    return history, values | dict(zip((*FORCES, *bars, *ENERGIES), probed, strict=True))


def main(arguments=None):
    """Parse the command line, run, write the history; return the exit status."""
    parser = command.parser(__doc__, *command.CURVE, output="history to write (CSV)")
    parser.add_argument("--pga", required=True, type=float, help="intensity [g]")
    args = parser.parse_args(arguments)
    if not 0.0 < args.pga <= 10.0:
        raise ValueError(f"PGA of {args.pga:g} g: expected a number above 0, at most 10 (g)")
    case, time_s, columns = command.opened(args)
    adapter.load_yade()
    shaken = shaking.of_case(case, time_s, columns, args.direction, args.pga)
    history, values = trace(shaken)
    facts = history_facts(case, args, args.pga, history)
    rows = zip(*(v.tolist() for v in values.values()), strict=True)
    write_atomic(args.output, history_csv(facts, values, rows, {**HEAD, "time_s": ".4f"}))
    return 0
