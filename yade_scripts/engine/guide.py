"""Guide that imposes a motion along y on blocks whose other freedoms are free."""

import numpy as np

GUIDE_INTERVAL_S = 5e-4  # guided blocks move at constant speed for so long


class Guide:
    """Moves blocks along y at piecewise constant speed, their other freedoms left alone.

    Newton's integrator keeps the velocity of a blocked degree of freedom. Every
    `period` steps it is set to the mean speed of the motion over the coming ones, so
    the position agrees with the twice integrated motion at each of these instants.
    """

    def __init__(self, scene, omega, body, guided, motions, period):
        """Tabulate the speed of every guided block on the grid of updates."""
        self.omega, self.period = omega, period
        self.states = [omega.bodies[body[i]].state for i in guided]
        interval = period * omega.dt
        tables = {}
        for name in {scene.blocks[i].motion for i in guided}:
            motion = motions[name]
            count = int(np.ceil(motion.duration_s / interval)) + 2
            tables[name] = np.diff(motion.position(interval * np.arange(count))) / interval
        longest = max(len(t) for t in tables.values())
        columns = [tables[scene.blocks[i].motion] for i in guided]
        speeds = np.array([np.pad(c, (0, longest - len(c)), mode="edge") for c in columns])
        self.rows = speeds.T.tolist()

    def __call__(self):
        """Set the speeds until the next update; beyond the motion the last one stays."""
        row = self.rows[min(self.omega.iter // self.period, len(self.rows) - 1)]
        for state, speed in zip(self.states, row, strict=True):
            velocity = state.vel
            velocity[1] = speed  # YADE takes its own vector back in half the time of a tuple
            state.vel = velocity
