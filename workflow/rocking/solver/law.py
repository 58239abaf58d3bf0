"""The law of a contact node, which all loops of the compiled solvers take.

With δ > 0 the penetration, u the slip since the node closed and r = ks/kn, all forces over kn:

    N = max(δ + β δ̇, 0),  T = r (u + β u̇) where that is at most μ N in size, else μ N of its sign

and |r u| ≤ μ N too: the spring slides at Coulomb's limit, and the dashpot beside it takes no more
than what the spring leaves of it. Joints may also have no dashpot along them, T = r u.

A bond acts both ways and without a limit, N = δ + β δ̇ and T = r (u + β u̇), until −δ reaches its
tension or |r u| its cohesion + μ max(δ, 0); from then on the node is a dry one. A tie has no ks.

It is written for one number and for lanes of them (`vectors`): `choose` where they part.
"""

import math

from rocking.runtime.compiled import inlined

from .vectors import choose, every, like, some


@inlined
def since_closed(depth_m, rate_m_s, dt_s):
    """Of a node that closed within this step: the share of its force, and of its slip.

    The force stands for half a step on either side of now, of which the node, closed since
    depth/rate, has been in contact for that share.
    """
    since = depth_m / (rate_m_s * dt_s)
    return min(0.5 + since, 1.5), min(since, 1.0)


@inlined
def rub(slip_m, normal_m, ratio, friction, before_m):
    """Slip under Coulomb's limit; forces over kn.

    Parameters
    ----------
    slip_m : float
        With this step's, as if it stuck; in space its size.
    normal_m, ratio, friction : float
        Normal force, ks/kn and tan φ.
    before_m : float
        Slip at the step before, from whose force to the limit friction acts on average.

    Returns
    -------
    shear_m, slip_m, taken_m2, sticks : float, float, float, bool
        Force of the spring, slip that is left, what sliding took (over kn).
    """
    limit, held = friction * normal_m, ratio * slip_m
    sticks, shear, taken = abs(held) <= limit, held, 0.0
    if not every(sticks):
        most = math.copysign(limit, held)
        mean = 0.5 * (limit + min(ratio * abs(before_m), abs(held)))
        shear = choose(sticks, held, most)
        slip_m = choose(sticks, slip_m, most / ratio)
        taken = choose(sticks, 0.0, mean * abs(held - most) / ratio)
    return shear, slip_m, taken, sticks


@inlined
def bounded(shear_m, limit_m):
    """A shear force within ± limit, and whether it was; of spring and dashpot together."""
    return min(max(shear_m, -limit_m), limit_m), abs(shear_m) <= limit_m


@inlined
def dry(depth_m, rate_m_s, speed_m_s, slip_m, step_m, fresh, joint, dt_s, drag=1.0):
    """A node in contact that can only push.

    Parameters
    ----------
    depth_m, rate_m_s : float
        Penetration and its rate.
    speed_m_s, slip_m, step_m : float
        Rate of slip, slip before this step and what this one adds.
    fresh : bool
        It did not touch at the step before.
    joint : tuple of 3 floats
        β [s], ks/kn, tan φ.
    dt_s : float
    drag : float
        Dashpot along the joint over β·ks; 0: it has none.

    Returns
    -------
    normal_m, shear_m, share : float
        Forces over kn, and the share of the step for which they count; |shear| ≤ tan φ · normal.
    slip_m : float
    pressed, drags : bool
        Whether the dashpot across and the one along the joint act, within their limits.
    stored_m2, taken_m2 : float
        Energy stored, and taken in this step, over kn.
    """
    beta, ratio, friction = joint
    share, closing = 1.0, fresh & (rate_m_s > 0.0)
    if some(closing):
        counts, part = since_closed(depth_m, rate_m_s, dt_s)
        share, step_m = choose(closing, counts, share), choose(closing, step_m * part, step_m)
    normal = max(depth_m + beta * rate_m_s, 0.0)
    spring, slip, taken, sticks = rub(slip_m + step_m, normal, ratio, friction, slip_m)
    shear, within = bounded(spring + drag * ratio * beta * speed_m_s, friction * normal)
    shear = choose(sticks, shear, spring)
    power = (normal - depth_m) * rate_m_s + (shear - spring) * speed_m_s
    drags = sticks & within & (0.0 * normal < drag)  # of lanes a mask
    stored = 0.5 * (depth_m * depth_m + ratio * slip * slip)
    return normal, shear, share, slip, normal > 0.0, drags, stored, taken + share * dt_s * power


@inlined
def bond_breaks(depth_m, slip_m, strength, joint):
    """Whether a bond breaks at this penetration and slip; `strength`: tension, cohesion over kn."""
    pull, hold = strength
    torn = -depth_m >= pull
    return torn | (joint[1] * abs(slip_m) > hold + joint[2] * max(0.0, depth_m))


@inlined
def released(depth_m, slip_m, ratio):
    """Energy that a bond with this slip loses as it breaks, over kn [m²]."""
    pulled = min(depth_m, 0.0)
    return 0.5 * (ratio * slip_m * slip_m + pulled * pulled)


@inlined
def bonded(depth_m, rate_m_s, speed_m_s, slip_m, joint, dt_s):
    """A bond that holds, its slip with this step's; arguments and values as those of `dry`."""
    beta, ratio, _ = joint
    normal, shear = depth_m + beta * rate_m_s, ratio * (slip_m + beta * speed_m_s)
    taken = dt_s * beta * (rate_m_s * rate_m_s + ratio * speed_m_s * speed_m_s)
    stored = 0.5 * (depth_m * depth_m + ratio * slip_m * slip_m)
    return normal, shear, 1.0, slip_m, True, True, stored, taken


@inlined
def node(depth_m, rate_m_s, speed_m_s, had_m, step_m, acts, joints, dt_s, drag=1.0):
    """What `dry` and `bonded` say of a node, each where it acts; elsewhere nothing.

    `acts`: it touches, its bond holds, it touched before. `joints`: its own, and that of its bond.
    """
    touching, holds, was = acts
    normal = shear = share = stored = taken = like(0.0, depth_m)
    slip, pressed, drags = had_m, touching & ~touching, touching & ~touching
    if some(touching):
        had, step = choose(touching & was, had_m, 0.0), choose(touching, step_m, 0.0)
        normal, shear, share, slip, pressed, drags, stored, taken = dry(
            depth_m, rate_m_s, speed_m_s, had, step, touching & ~was, joints[0], dt_s, drag
        )
        pressed, drags = touching & pressed, touching & drags
    if some(holds):
        pull, held, whole, after, _, _, kept, lost = bonded(
            depth_m, rate_m_s, speed_m_s, had_m + step_m, joints[1], dt_s
        )
        normal, shear = choose(holds, pull, normal), choose(holds, held, shear)
        share, slip = choose(holds, whole, share), choose(holds, after, slip)
        pressed, drags = pressed | holds, choose(holds, joints[1][1] > 0.0, drags)
        stored, taken = choose(holds, kept, stored), choose(holds, lost, taken)
    return normal, shear, share, slip, pressed, drags, stored, taken
