"""Entry point: the critical step as YADE shows it, against the one predicted from K, M and C.

    python3 yade_scripts stability --scene cases/W2.json --output stability.csv
        --limits stability_limits.csv

Each scene is pressed together, brought to rest and then disturbed by a millionth of
the speed that free fall gains in a step.
Below the critical step the disturbance stays; above, it grows by orders of
magnitude. Bisection finds where.
"""

import math
from dataclasses import replace

import numpy as np

from yade_scripts.commands import command
from yade_scripts.commands.tables import to_csv
from yade_scripts.engine import adapter, loop
from yade_scripts.files import read_case, write_atomic
from yade_scripts.model import facade, floor_motions
from yade_scripts.model.quadrature import gauss_lobatto
from yade_scripts.model.scene import DOFS, Block, Interface, NodeList, Scene, box_inertia
from yade_scripts.model.stiffness import assemble, critical_step

COLUMNS = {
    "scene": "",
    "stiffness_factor": ".5g",
    "beta_s": ".6g",
    "dt_s": ".6e",
    "dt_over_dt_crit": ".5f",
    "stable_predicted": "d",
    "stable_observed": "d",
    "growth": ".3e",
}
LIMIT_COLUMNS = {
    "scene": "",
    "stiffness_factor": ".5g",
    "beta_s": ".6g",
    "dt_crit_predicted_s": ".6e",
    "dt_crit_observed_s": ".6e",
    "ratio": ".4f",
}
SCENES = ("W1", "W2", "stack")
BETA_FACTORS = (0.0, 0.3, 1.0, 3.0, 10.0)
STIFFNESS_FACTORS = (10**-1.5, 10**-0.75, 1.0, 10**0.75, 10**1.5)
STACK_M = (1.0, 0.4, 0.3)  # edges of a block of the stack
PRESS_M_S2 = 3.0  # of the façade against its return walls
RELAX_STEPS, STEPS = 500, 3000
UNSTABLE_GROWTH = 100.0  # undamped stable cases stay below 10, unstable ones pass 1000


def stack_scene(count, beta_s, jkn_pa_m=1e9):
    """Stack of equal blocks on a support, planar: a scene with many interfaces in series."""
    lx, ly, lz = STACK_M
    mass = 1800.0 * lx * ly * lz
    blocks = [
        Block(
            "base",
            (0.0, 0.5 * ly, -0.5),
            (2.0, 2.0, 1.0),
            1.0,
            (1.0,) * 3,
            free="",
            motion=floor_motions.GROUND,
        )
    ]
    listed = NodeList()
    points, weights = gauss_lobatto(3)
    for i in range(count):
        blocks.append(
            Block(
                f"block {i + 1}",
                (0.0, 0.5 * ly, (i + 0.5) * lz),
                STACK_M,
                mass,
                box_inertia(mass, STACK_M),
                free="yzX",
            )
        )
        line = np.stack([0 * points, points * ly, 0 * points + i * lz], axis=1)
        listed.add_joint(
            f"joint {i + 1}",
            i + 1,
            i,
            line,
            (0, 0, 1),
            weights * lx * ly,
            Interface(jkn_pa_m, 0.33 * jkn_pa_m, beta_s=beta_s, friction_rad=math.radians(60)),
        )
    return Scene(
        blocks,
        listed.joints,
        listed.done(),
        monitor=f"block {count}",
        monitor_point_m=(0.0, 0.5 * ly, count * lz),
        reference="base",
        thickness_m=ly,
    )


def scene_of(case, name, stiffness_factor, beta_s):
    """Scene of the map: a façade model or the stack of ten, with scaled joint stiffness."""
    if name == "stack":
        return stack_scene(10, beta_s, jkn_pa_m=1e9 * stiffness_factor)
    scaled = {
        **case,
        "facade": {**case["facade"], "friction_deg": 80.0, "gap_m": 0.0},
        "return_wall": {**case["return_wall"], "friction_deg": 80.0},
    }
    scaled["facade"]["e_mpa"] = case["facade"]["e_mpa"] * stiffness_factor
    return facade.facade_scene(scaled, name, beta_s)


def pressed(scene, acceleration_m_s2):
    """Copy of a scene in static equilibrium under a uniform acceleration, without shear forces.

    Solves K u = M a with the normal springs alone, as shear springs start unstretched in a run;
    directions without stiffness stay put.
    """
    smooth = replace(scene.nodes, ks_n_m=1e-12 * scene.nodes.kn_n_m)
    matrices = assemble(replace(scene, nodes=smooth))
    k, _ = matrices.dense()
    load = np.where(matrices.dof[:, 1] < 3, matrices.mass, 0.0)
    load = load * np.concatenate((acceleration_m_s2, np.zeros(3)))[matrices.dof[:, 1]]
    u = np.linalg.lstsq(k, load, rcond=1e-9)[0]
    blocks = list(scene.blocks)
    for i in np.unique(matrices.dof[:, 0]):
        pose = np.zeros(6)
        mine = matrices.dof[:, 0] == i
        pose[matrices.dof[mine, 1]] = u[mine]
        blocks[i] = replace(
            blocks[i],
            displacement_m=tuple(map(float, pose[:3])),
            rotation_rad=tuple(map(float, pose[3:])),
        )
    return replace(scene, blocks=blocks)


def growth(scene, dt_s):
    """Growth of a small disturbance of the pressed scene at one time step; ∞ if numbers overflow.

    A horizontal acceleration presses the façade against its return walls, so that every contact is
    closed as the prediction assumes.
    """
    w = adapter.load_yade()
    has_walls = any(name.startswith("return wall") for name in scene.joints)
    gravity = np.array([0.0, -PRESS_M_S2 if has_walls else 0.0, -scene.gravity_m_s2])
    zero = adapter.SupportMotion.none(1e6)
    small = 0.3 * critical_step(scene)
    built = adapter.build(pressed(scene, gravity), {name: zero for name in scene.motions}, small)
    omega = built.omega
    for body in omega.bodies:  # driven supports are free along y: hold them against the press
        if body.state.mass > 1e6 * max(b.mass_kg for b in scene.blocks):
            body.state.blockedDOFs = DOFS
    newton = next(e for e in omega.engines if isinstance(e, w.NewtonIntegrator))
    newton.gravity = tuple(float(g) for g in gravity)
    newton.damping = 0.7
    loop.run(omega, RELAX_STEPS)
    newton.damping = 0.0
    free = [omega.bodies[built.body[i]].state for i, b in enumerate(scene.blocks) if b.free]
    rng = np.random.default_rng(1)
    start = 0.0
    for state in free:
        kick = 1e-6 * scene.gravity_m_s2 * small * rng.uniform(-1.0, 1.0, 3)
        state.vel = (0.0, float(kick[0]), float(kick[1]))
        state.angVel = (float(kick[2]), 0.0, 0.0)
        start = max(start, float(np.max(np.abs(kick))))
    omega.dt = dt_s
    speeds = []

    def probe():
        speeds.append(np.max(np.abs([v for s in free for v in (*s.vel, *s.angVel)])))

    omega.engines = [*omega.engines, loop.runner(probe, 5, at_start=False)]
    loop.run(omega, STEPS)
    return float(np.max(speeds)) / start if np.all(np.isfinite(speeds)) else math.inf


def bisect(scene, label, *, tolerance=0.01):
    """Observed over predicted critical step, by bisection, and every trial as a row.

    The ratio is the middle of the final bracket; NaN if the limit is not within a tenth of the
    predicted one.
    """
    critical = critical_step(scene)
    rows = []

    def stable(ratio):
        grown = growth(scene, ratio * critical)
        rows.append(
            {
                **label,
                "dt_s": ratio * critical,
                "dt_over_dt_crit": ratio,
                "stable_predicted": int(ratio < 1.0),
                "stable_observed": int(grown < UNSTABLE_GROWTH),
                "growth": grown,
            }
        )
        return grown < UNSTABLE_GROWTH

    low, high = 0.9, 1.1
    if not stable(low) or stable(high):
        return math.nan, rows
    while high - low > tolerance:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stable(middle) else (low, middle)
    return 0.5 * (low + high), rows


def trials(case, say):
    """Map of the critical step over scenes, damping and stiffness: rows of both tables."""
    rows, limits = [], []
    for name in SCENES:
        for factor in STIFFNESS_FACTORS:
            for multiple in BETA_FACTORS:
                beta = multiple * case["beta_s"]
                scene = scene_of(case, name, factor, beta)
                label = {"scene": name, "stiffness_factor": factor, "beta_s": beta}
                ratio, more = bisect(scene, label)
                rows += more
                critical = critical_step(scene)
                limits.append(
                    {
                        **label,
                        "dt_crit_predicted_s": critical,
                        "dt_crit_observed_s": ratio * critical,
                        "ratio": ratio,
                    }
                )
        worst = max(abs(r["ratio"] - 1.0) for r in limits if r["scene"] == name)
        say(f"{name}: observed within {100 * worst:.1f} % of the predicted critical step")
    return rows, limits


def main(arguments=None):
    """Parse the command line, run the trials, write both tables; return the exit status."""
    texts = {"output": "every trial (CSV)", "limits": "observed limits (CSV)"}
    args = command.parser(__doc__, "scene", **texts).parse_args(arguments)
    case = read_case(args.scene)
    rows, limits = trials(case, command.progress("stability"))
    write_atomic(args.limits, to_csv(limits, LIMIT_COLUMNS))
    write_atomic(args.output, to_csv(rows, COLUMNS))
    return 0
