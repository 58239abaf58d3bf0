"""One run in YADE: step a built scene, sample it, stop it, and say how it ended."""

import math
import time
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from yade_scripts.engine import adapter, loop
from yade_scripts.engine.poses import planar_turn, rotation
from yade_scripts.model.stiffness import compensated, critical_step

OK, OVERTURNED, FAILED = "ok", "overturned", "failed"
REST_RATIO = 0.5  # d/b


@dataclass
class StopRules:
    """When a run ends.

    Rest counts after `motion_s` alone, the end of the input that matters: then the top's velocity
    relative to the base is below `rest_velocity_m_s` for `rest_time_s`, and d/b below REST_RATIO,
    for a façade that lingers near its unstable balance is not at rest. From d/b = `overturn_ratio`
    on it counts as overturned; beyond the relative speed `max_speed_m_s` the run has failed
    numerically.
    """

    motion_s: float
    limit_s: float
    overturn_ratio: float = 1.0
    rest_velocity_m_s: float = 1e-3
    rest_time_s: float = 0.5
    max_speed_m_s: float = 50.0


@dataclass
class YadeHistory:
    """Sampled result of one run, and why it ended.

    d is positive outward, relative to the base, the rotation outward that of the monitored block;
    the peak |d|/b is refined between samples by the cubic through values and rates. The status is
    "ok", "overturned" or "failed". `beside` are further columns of a table's row: under two
    components the largest twist about z and slide of the centroid along x, at the samples.
    """

    time_s: np.ndarray
    d_m: np.ndarray
    velocity_m_s: np.ndarray
    rotation_rad: np.ndarray
    peak_d_over_b: float
    status: str
    reason: str
    dt_s: float
    steps: int
    wall_s: float
    beside: dict = field(default_factory=dict)


def choose_step(scene, numerics):
    """Time step of a run, the stated one or a fraction of the critical step, and that [s].

    The scene's note "critical_step_s", where it has one, spares the dense search for it. A
    ValueError of one line if the step would be beyond the critical one.
    """
    critical = scene.notes.get("critical_step_s") or critical_step(scene)
    step = numerics.get("step_s") or numerics["step_fraction"] * critical
    if step > critical:
        raise ValueError(
            f"numerics.step_s = {step:g} s is beyond the critical step {critical:.4g} s "
            "of this scene: choose a smaller one or leave step_s empty"
        )
    return step, critical


def cubic_peak(time_s, value, rate):
    """Largest |value| of the piecewise cubic Hermite curve through samples and rates."""
    best = float(np.max(np.abs(value)))
    step = np.diff(time_s)
    turning = np.flatnonzero((rate[:-1] * rate[1:] < 0.0) & (step > 0.0))
    for i in turning:
        h, y0, y1, m0, m1 = step[i], value[i], value[i + 1], rate[i], rate[i + 1]
        s = np.linspace(0.0, 1.0, 33)
        curve = (
            (2 * s**3 - 3 * s**2 + 1) * y0
            + (s**3 - 2 * s**2 + s) * h * m0
            + (3 * s**2 - 2 * s**3) * y1
            + (s**3 - s**2) * h * m1
        )
        best = max(best, float(np.max(np.abs(curve))))
    return best


class _Monitor:
    """Samples the watched points relative to the reference support; decides when to stop."""

    def __init__(self, scene, built, rules):
        bodies = built.omega.bodies
        self.omega, self.rules = built.omega, rules
        self.support = bodies[built.body[scene.index(scene.reference)]].state
        self.points = []
        for name, point in scene.watched:
            index = scene.index(name)
            centre = scene.blocks[index].centre_m
            arm = tuple(float(p - c) for p, c in zip(point, centre, strict=True))
            state = bodies[built.body[index]].state
            self.points.append((state, built.unturned[index], float(centre[1]), arm))
        self.beside = {"twist_rad": 0.0, "slid_m": 0.0} if scene.two_components else {}
        self.start = self.support.pos[1]
        self.apart_x = self.points[-1][0].pos[0] - self.support.pos[0]
        self.b = scene.thickness_m
        self.rows, self.moving_until = [], 0.0
        self.status, self.reason = OK, ""

    def __call__(self):
        """Take a sample; end the run when a stop rule applies. Plain floats, for speed."""
        t, support = self.omega.time, self.support
        moved, speed = support.pos[1] - self.start, support.vel[1]
        d, v, turn, farthest = 0.0, 0.0, 0.0, -1.0
        for state, unturned, centre, point in self.points:
            _, y, z = point
            angle = planar_turn(state, unturned)  # rotation about x alone carries d
            c, s = math.cos(angle), math.sin(angle)
            at = (state.pos[1] - centre) + (c * y - s * z - y) - moved
            if abs(at) <= farthest:
                continue
            d, turn, farthest = at, angle, abs(at)
            v = state.vel[1] - state.angVel[0] * (s * y + c * z) - speed
            if self.beside:
                turned = np.array(rotation(state.ori * unturned), float).reshape(3, 3)
                arm = turned @ point
                d += arm[1] - (c * y - s * z)
                v = state.vel[1] + state.angVel[2] * arm[0] - state.angVel[0] * arm[2] - speed
                slid = state.pos[0] - support.pos[0] - self.apart_x
                now = {"twist_rad": math.atan2(turned[1, 0], turned[0, 0]), "slid_m": slid}
                self.beside = {name: max(self.beside[name], abs(now[name])) for name in now}
        self.rows.append((t, d, v, -turn))
        rules = self.rules
        if not (math.isfinite(d) and math.isfinite(v)) or abs(v) > rules.max_speed_m_s:
            self._stop(FAILED, f"speed {v:.3g} m/s at t = {t:.4f} s: numerical failure")
        elif abs(d) >= rules.overturn_ratio * self.b:
            self._stop(OVERTURNED, f"d/b reached {rules.overturn_ratio:g} at t = {t:.3f} s")
        elif abs(v) > rules.rest_velocity_m_s or abs(d) > REST_RATIO * self.b:
            self.moving_until = t
        elif t > rules.motion_s and t - self.moving_until > rules.rest_time_s:
            self._stop(OK, f"at rest at t = {t:.3f} s")

    def _stop(self, status, reason):
        if not self.reason:
            self.status, self.reason = status, reason
        loop.stop()

    def history(self, dt_s, wall_s):
        """What the run has been, once it has ended."""
        time_s, d, v, rotation_rad = np.array(self.rows, float).reshape(-1, 4).T
        finite = np.isfinite(d) & np.isfinite(v)
        peak = cubic_peak(time_s[finite], d[finite], v[finite]) if finite.any() else np.nan
        if self.status == FAILED:
            peak = np.nan
        return YadeHistory(
            time_s,
            d,
            v,
            rotation_rad,
            peak / self.b,
            self.status,
            self.reason or f"time limit {self.rules.limit_s:g} s",
            dt_s,
            int(self.omega.iter),
            wall_s,
            self.beside,
        )


class Making(NamedTuple):
    """How a scene becomes bodies of YADE.

    `node_radius_m` and `full_rotation` are those of `adapter.build`. With `compensate_lag` return
    walls and links are corrected for the late dashpot velocity, see `stiffness.compensated`.
    """

    node_radius_m: float = 1e-3
    full_rotation: bool = False
    compensate_lag: bool = True


AS_USUAL = Making()


def run(
    scene,
    motions,
    dt_s,
    rules,
    *,
    sample_s=0.005,
    making=AS_USUAL,
    setup=None,
    check=None,
):
    """Run a scene in YADE until it overturns, rests, fails or reaches the limit: its `YadeHistory`.

    Samples are the only Python of a run; `check` is sampled in the same call from YADE, which costs
    as much as the Python in it. `setup` is called with the `Built` scene before the first step
    (recorders, other engines).
    """
    if making.compensate_lag:
        scene = compensated(scene, dt_s)
    built = adapter.build(
        scene,
        motions,
        dt_s,
        node_radius_m=making.node_radius_m,
        full_rotation=making.full_rotation or scene.two_components,
    )
    omega = built.omega
    monitor = _Monitor(scene, built, rules)
    if check is not None:
        check.attach(built)

    def sample():
        monitor()
        if check is not None:
            check()

    loop.between(sample, round(sample_s / dt_s), first=1)
    if setup is not None:
        setup(built)
    began = time.perf_counter()
    loop.run(omega, int(np.ceil(rules.limit_s / dt_s)))
    return monitor.history(dt_s, time.perf_counter() - began)
