"""One scene under one motion: what every dynamic study sets up and runs."""

import math
from dataclasses import dataclass, replace

import numpy as np

from yade_scripts.engine import adapter, energy_check, simulate
from yade_scripts.model import floor_motions, models, yielding
from yade_scripts.model.motion import amplitude

RETRY_SAMPLING = 0.1  # of the sampling interval, for a run tried once more


@dataclass(frozen=True)
class Shaking:
    """A scene, its motions, and how it is to be run; vary it with `dataclasses.replace`.

    With `retry` a numerical failure is tried once more at half the step.
    """

    scene: object
    motions: dict
    rules: simulate.StopRules
    step_s: float
    critical_step_s: float
    sample_s: float
    node_radius_m: float
    retry: bool

    def run(self, **how):
        """Run it as it is; `how` goes to `simulate.run` (set-up, check)."""
        return simulate.run(
            self.scene,
            self.motions,
            self.step_s,
            self.rules,
            sample_s=self.sample_s,
            making=simulate.Making(node_radius_m=self.node_radius_m),
            **how,
        )

    def checked(self, check=None, **how):
        """Run it with the energy check beside it: energy from nowhere is never a collapse."""
        check = check or energy_check.EnergyCheck(self.scene, self.motions)
        history = self.run(check=check, **how)
        if check.reason and history.status != simulate.FAILED:
            history.status, history.reason = simulate.FAILED, check.reason
            history.peak_d_over_b = math.nan
        return history

    def retried(self):
        """Run it, checked; a numerical failure is retried once at half the step.

        The retry is sampled more often too: the energy check's integral over samples may have
        missed the push of a short impact, which looks like energy from nowhere whatever the step.
        """
        history = self.checked()
        if history.status == simulate.FAILED and self.retry:
            half, often = 0.5 * self.step_s, RETRY_SAMPLING * self.sample_s
            again = replace(self, step_s=half, sample_s=often).checked()
            again.steps += history.steps
            again.wall_s += history.wall_s
            again.reason += f"; at half the step, after {history.reason}"
            return again
        return history


def set_up(scene, numerics, time_s, columns, factor):
    """Set up one shaking as section numerics says, see `models.numerics`.

    The factor is on the motion's amplitude; its sign is the direction, which the vertical motion
    has not. ValueError if the motion lacks a floor, or the stated step is beyond the critical one.
    """
    scene, columns = floor_motions.shaken(scene, columns)
    moved = floor_motions.shaking(scene, columns, factor)
    motions = {name: adapter.SupportMotion(time_s, values) for name, values in moved.items()}
    horizontal = {name: motion for name, motion in motions.items() if name != scene.vertical}
    step, critical = simulate.choose_step(scene, numerics)
    return Shaking(
        scene,
        motions,
        stop_rules(scene, numerics, time_s, horizontal),
        step,
        critical,
        numerics["sample_interval_s"],
        numerics["node_radius_m"],
        numerics["retry_half_step"],
    )


def of_case(case, time_s, columns, direction, pga_g):
    """Set up the shaking of a case file at one intensity [g]; see `set_up`."""
    factor = amplitude(columns["ground"], direction, pga_g)
    columns = yielding.of_case(case, time_s, columns)
    return set_up(models.build_scene(case), models.numerics(case), time_s, columns, factor)


def _end_of_shaking(time_s, motions, still_m_s2):
    """Time from which no support accelerates more than `still_m_s2` [s]."""
    n = len(time_s)
    moving = np.zeros(n, bool)
    for motion in motions.values():
        moving |= np.abs(motion.acceleration_m_s2[:n]) > still_m_s2
    return float(time_s[np.flatnonzero(moving)[-1]]) if moving.any() else 0.0


def stop_rules(scene, numerics, time_s, motions):
    """Stop rules of an earthquake run whose motion file has these times [s].

    A motion is over when no support accelerates more than quiet_ratio·min(g b/h, peak): g b/h lifts
    the façade, and below uplift the motion's own peak rules its response. What follows cannot raise
    the peak d/b of a façade at rest. `motions` are the horizontal ones: the vertical motion moves
    no façade that stands upright.
    """
    speed = max(m.peak_speed() for m in motions.values())
    peak = max(float(np.max(np.abs(m.acceleration_m_s2))) for m in motions.values())
    uplift = scene.gravity_m_s2 * scene.thickness_m / scene.monitor_point_m[2]
    return simulate.StopRules(
        motion_s=_end_of_shaking(time_s, motions, numerics["quiet_ratio"] * min(uplift, peak)),
        limit_s=float(time_s[-1]) + numerics["after_motion_s"],
        overturn_ratio=numerics["overturn_ratio"],
        rest_velocity_m_s=numerics["rest_velocity_m_s"],
        rest_time_s=numerics["rest_time_s"],
        max_speed_m_s=numerics["max_speed_ratio"] * (speed + 1.0),
    )
