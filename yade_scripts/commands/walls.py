"""Entry point: single walls, released to rock freely or on a shake table, in one YADE process.

    python3 yade_scripts walls --list walls.json --output histories.npz

The file holds a list; each entry is one wall:

    id             text, unique
    config         sections facade, return_wall, smdof and numerics of a resolved configuration;
                   facade.gap_m and tilt_deg say how it stood
    model          "W1" (one-sided) or "free" (two-sided)
    beta_s         β [s]; a list for a run with each

and of a wall that is released

    release_ratio  θ₀/α
    limit_s        end of each history [s]

or of one on a table

    motion         path of a motion file with columns time_s, ground_m_s2
    factor         on the motion; its sign is the direction
    observed_m     height of d above the base; without it d is the top's

The archive tells of every run its id, beta_s, status, reason, peak_d_over_b, dt_s and steps, with
time_s, d_m (relative to the table and from the upright position, so that a tilted wall starts at
h·sin φ) and theta_over_alpha, the rotation outward from the vertical.
"""

import math

from yade_scripts.commands import command, shaking
from yade_scripts.commands.tables import archive
from yade_scripts.engine import adapter, simulate
from yade_scripts.files import read_json, write_atomic
from yade_scripts.lists import listed
from yade_scripts.model import facade, floor_motions, models
from yade_scripts.model.floor_motions import GROUND
from yade_scripts.model.gravity import GRAVITY_M_S2

KEYS = ("id", "config", "model", "beta_s")
RELEASED = ("release_ratio", "limit_s")
SHAKEN = ("motion", "factor")
SAMPLES = 2500  # a free history is kept in about so many samples: 0.1 % of a bounce or finer
REST_SPEED = 2e-3  # of the speed √(gh)·b/h, at which a wall that has stopped is left
REST_BOUNCES = 0.3  # for so long, in units of 1/p


def read_walls(path):
    """Read a list of walls; of each beta_s is a list.

    ValueError of one line that names file and wall if a key is missing or a number is not usable.
    """
    walls = read_json(path)
    if not isinstance(walls, list) or not walls:
        raise ValueError(f"{path}: expected a list of walls")
    for number, wall in enumerate(walls, 1):
        more_keys = SHAKEN if "motion" in wall else RELEASED
        if missing := [key for key in (*KEYS, *more_keys) if key not in wall]:
            raise ValueError(f"{path}: wall {number} has no {listed(missing)}")
        where = f"{path}: wall {wall['id']}"
        if not isinstance(wall["beta_s"], list):
            wall["beta_s"] = [wall["beta_s"]]
        betas, limit = wall["beta_s"], wall.get("limit_s", 1.0)
        if not betas or not all(isinstance(b, (int, float)) and 0 <= b < 1 for b in betas):
            raise ValueError(f"{where}: expected beta_s between 0 and 1 s")
        if not isinstance(limit, (int, float)) or not 0.0 < limit < 1e4:
            raise ValueError(f"{where}: expected a positive limit_s")
    if len({wall["id"] for wall in walls}) < len(walls):
        raise ValueError(f"{path}: two walls have the same id")
    return walls


def released(wall, beta_s):
    """History of a wall that is released at θ₀ and left to rock."""
    config, release_ratio, limit_s = wall["config"], wall["release_ratio"], wall["limit_s"]
    scene = facade.facade_scene(config, wall["model"], beta_s, release_ratio=release_ratio)
    step, _ = simulate.choose_step(scene, config["numerics"])
    h, b = config["facade"]["height_m"], config["facade"]["thickness_m"]
    speed = math.sqrt(GRAVITY_M_S2 * h) * b / h
    p = math.sqrt(1.5 * GRAVITY_M_S2 / math.hypot(h, b))  # √(3g/4R)
    rules = simulate.StopRules(
        motion_s=math.acosh(1.0 / (1.0 - release_ratio)) / p if release_ratio else 0.0,
        limit_s=limit_s,
        rest_velocity_m_s=REST_SPEED * speed,
        rest_time_s=REST_BOUNCES / p,
    )
    return simulate.run(
        scene,
        {GROUND: adapter.SupportMotion.none(limit_s + 1.0)},
        step,
        rules,
        sample_s=limit_s / SAMPLES,
        making=simulate.Making(config["numerics"].get("node_radius_m", 1e-3)),
    )


def shaken(wall, beta_s):
    """History of a wall on a shake table."""
    time_s, columns = floor_motions.read(wall["motion"])
    stated = {key: wall[key] for key in ("model", "observed_m") if key in wall}
    case = {**wall["config"], **stated, "beta_s": beta_s}
    scene = models.build_scene(case)
    return shaking.set_up(scene, case["numerics"], time_s, columns, wall["factor"]).retried()


def main(arguments=None):
    """Parse the command line, run, write the archive; return the exit status."""
    texts = {"list": "walls (JSON)", "output": "histories to write (.npz)"}
    args = command.parser(__doc__, **texts).parse_args(arguments)
    walls, say = read_walls(args.list), command.progress("walls")
    adapter.load_yade()
    runs, histories, angles = [], [], []
    for number, wall in enumerate(walls, 1):
        sizes = wall["config"]["facade"]
        alpha = math.atan2(sizes["thickness_m"], sizes["height_m"])
        for beta_s in wall["beta_s"]:
            history = (shaken if "motion" in wall else released)(wall, beta_s)
            failed = history.status == simulate.FAILED
            runs.append(
                {
                    "id": wall["id"],
                    "beta_s": beta_s,
                    "status": history.status,
                    "reason": history.reason,
                    "peak_d_over_b": None if failed else history.peak_d_over_b,
                    "dt_s": history.dt_s,
                    "steps": history.steps,
                }
            )
            histories.append(history)
            angles.append(history.rotation_rad / alpha)
        cost = sum(h.wall_s for h in histories[-len(wall["beta_s"]) :])
        say(f"{number} of {len(walls)}: {wall['id']}, {history.status} ({cost:.1f} s)")
    series = {"time_s": [h.time_s for h in histories], "d_m": [h.d_m for h in histories]}
    write_atomic(args.output, archive(runs, **series, theta_over_alpha=angles))
    return 0
