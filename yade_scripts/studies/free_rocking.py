"""Entry point: free rocking of many walls, each at many β, in one YADE process.

Runs under YADE's own Python:

    python3 yade_scripts free_rocking --cases cases.json --output histories.npz

The cases file holds a list; each case is one wall:

    id             text, unique
    config         sections facade, return_wall, smdof and numerics of a resolved configuration
    model          "W1" (one-sided) or "free" (two-sided)
    release_ratio  θ₀/α
    beta_s         list of β [s]
    limit_s        end of each history [s]
"""

import math
import time

from yade_scripts.engine import adapter, simulate
from yade_scripts.files import write_atomic
from yade_scripts.model import facade
from yade_scripts.model.gravity import GRAVITY_M_S2
from yade_scripts.studies import command
from yade_scripts.studies.tables import archive

CASE_KEYS = ("id", "config", "model", "release_ratio", "beta_s", "limit_s")
SAMPLES = 2500  # a history is kept in about so many samples: 0.1 % of a bounce or finer
REST_SPEED = 2e-3  # of the speed √(gh)·b/h, at which a wall that has stopped is left
REST_BOUNCES = 0.3  # for so long, in units of 1/p


def read_cases(path):
    """Read a cases file.

    Raises
    ------
    ValueError
        One line naming the file and the case if a key is missing or a number is not usable.
    """
    cases = command.listed(path, "case", CASE_KEYS)
    for case in cases:
        betas = case["beta_s"]
        if not betas or not all(isinstance(b, (int, float)) and 0 <= b < 1 for b in betas):
            raise ValueError(f"{path}: case {case['id']}: expected beta_s between 0 and 1 s")
        limit = case["limit_s"]
        if not isinstance(limit, (int, float)) or not 0.0 < limit < 1e4:
            raise ValueError(f"{path}: case {case['id']}: expected a positive limit_s")
    if len({case["id"] for case in cases}) < len(cases):
        raise ValueError(f"{path}: two cases have the same id")
    return cases


def free_rocking(config, model, beta_s, release_ratio, limit_s, samples=SAMPLES):
    """Release a wall at θ₀ and let it rock.

    Parameters
    ----------
    config : dict
        Sections facade, return_wall, smdof and numerics.
    model : str
        "W1" or "free".
    beta_s, release_ratio, limit_s : float
    samples : int
        Number of samples over `limit_s`.

    Returns
    -------
    simulate.History
        `rotation_rad` is relative to the vertical, positive outward.
    """
    scene = facade.facade_scene(config, model, beta_s, release_ratio=release_ratio)
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
    quiet = {facade.GROUND: adapter.Motion.none(limit_s + 1.0)}
    return simulate.run(
        scene,
        quiet,
        step,
        rules,
        sample_s=limit_s / samples,
        node_radius_m=config["numerics"].get("node_radius_m", 1e-3),
    )


def run_cases(cases, say):
    """Run every case at every β.

    Returns
    -------
    runs : list of dict
        id, beta_s, status, reason, dt_s, steps, wall_s of each run.
    histories : list of (time_s, theta_over_alpha)
    """
    runs, histories = [], []
    for number, case in enumerate(cases, 1):
        part = case["config"]["facade"]
        alpha = math.atan2(part["thickness_m"], part["height_m"])
        began = time.perf_counter()
        for beta in case["beta_s"]:
            history = free_rocking(
                case["config"], case["model"], beta, case["release_ratio"], case["limit_s"]
            )
            runs.append(
                {
                    "id": case["id"],
                    "beta_s": beta,
                    "status": history.status,
                    "reason": history.reason,
                    "dt_s": history.dt_s,
                    "steps": history.steps,
                }
            )
            histories.append((history.time_s, history.rotation_rad / alpha))
        say(
            f"wall {number} of {len(cases)}: {case['id']}, {len(case['beta_s'])} β "
            f"({time.perf_counter() - began:.1f} s)"
        )
    return runs, histories


def main(arguments=None):
    """Parse the command line, run, write the archive; return the exit status."""
    texts = {"cases": "cases (JSON)", "output": "histories to write (.npz)"}
    args = command.parser(__doc__, **texts).parse_args(arguments)
    cases = read_cases(args.cases)
    adapter.load_yade()
    runs, histories = run_cases(cases, command.teller("free rocking"))
    times, angles = zip(*histories, strict=True)
    write_atomic(args.output, archive(runs, time_s=times, theta_over_alpha=angles))
    return 0
