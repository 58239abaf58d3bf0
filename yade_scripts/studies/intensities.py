"""Which intensity to run next: a plan, the adaptive strategy or the grid, as pure functions.

Where a dense scan by the planar solver has shown where outcomes change, YADE runs its plan.
Without one the adaptive strategy climbs from below uplift by a constant factor until the façade
collapses, then closes every wide gap from the lowest collapse down to a share of it, also of any
lower collapse that this finds: below a collapse a façade may stand, fall and stand again. It
probes a few intensities beyond, then bisects the lowest collapse to a tolerance. After
Vamvatsikos and Cornell (2004), "Applied incremental dynamic analysis": hunt, then fill.
"""

import itertools
import math

DIGITS = 4  # intensities are rounded to 1e-4 g so that tables and caches agree


SEARCHED = 0.5  # share of the lowest collapse down to which islands of collapse are sought


def next_intensity(done, settings, plan=None):
    """Return the next PGA to run [g], or None when the curve is complete.

    Parameters
    ----------
    done : dict of float to str
        Status ("ok", "overturned", "failed") of each PGA already run.
    settings : dict
        Section ida of the configuration: mode, grid_g, start_g, growth,
        tolerance_g, tolerance_ratio, max_pga_g, beyond_collapse, search_ratio.
    plan : sequence of float, optional
        Intensities that a dense scan asks for [g]; it replaces the adaptive strategy.

    Notes
    -----
    start_g must be a number here; `run_ida` replaces null by half the uplift intensity.
    Failed runs carry no information about the façade: they neither stop the
    climb nor bound the bisection.
    """
    if settings["mode"] == "grid":
        plan = settings["grid_g"]
    if plan is not None:
        left = [round(g, DIGITS) for g in plan if round(g, DIGITS) not in done]
        return min(left) if left else None
    collapsed = sorted(g for g, status in done.items() if status == "overturned")
    climb = climb_sequence(settings)
    if not collapsed:
        return next((g for g in climb if g not in done), None)
    first = collapsed[0]
    below = [g for g in climb if g < first and g not in done]
    if below:  # only when rows of another strategy were reused
        return below[0]
    beyond = [g for g in climb if g > climb_collapse(done, climb)]
    for g in beyond[: settings["beyond_collapse"]]:
        if g not in done:
            return g
    low, ratio = SEARCHED * first, -math.log1p(-settings["search_ratio"])
    rungs = sorted({low, *(g for g in done if low < g <= first)}, reverse=True)
    for b, a in itertools.pairwise(rungs):
        parts = math.ceil(math.log(b / a) / ratio - 0.02)  # amplitudes are rounded
        if parts > 1 and (g := round(b * (a / b) ** (1.0 / parts), DIGITS)) not in done:
            return g
    safe = max((g for g, status in done.items() if status == "ok" and g < first), default=0.0)
    tolerance = min(settings["tolerance_g"], settings["tolerance_ratio"] * first)
    if first - safe > max(tolerance, 2 * 10**-DIGITS) * (1.0 + 1e-9):
        middle = round(0.5 * (safe + first), DIGITS)
        if middle not in done and safe < middle < first:
            return middle
        # the middle failed numerically: try the points beside it
        for share in (0.25, 0.75):
            g = round(safe + share * (first - safe), DIGITS)
            if g not in done and safe < g < first:
                return g
    return None


def climb_collapse(done, climb):
    """Lowest intensity of the climb that collapsed; infinity if none did."""
    return min((g for g in climb if done.get(g) == "overturned"), default=float("inf"))


def climb_sequence(settings):
    """Intensities of the climb [g]: from start_g by the factor `growth` up to max_pga_g."""
    count = math.ceil(math.log(settings["max_pga_g"] / settings["start_g"], settings["growth"]))
    climb = [settings["start_g"] * settings["growth"] ** i for i in range(count)]
    return [round(g, DIGITS) for g in (*climb, settings["max_pga_g"])]


def fallen_or_highest(done):
    """Lowest PGA at which a curve's façade fell [g]; the highest that was run if it never did."""
    return collapse_bounds(done)[1] or max(done)


def collapse_bounds(done):
    """Highest safe PGA below the first collapse, and the lowest that collapsed [g].

    Parameters
    ----------
    done : dict of float to str

    Returns
    -------
    safe, collapse : float or None
        collapse is None when nothing overturned; safe is None when nothing survived.
    """
    collapsed = [g for g, status in done.items() if status == "overturned"]
    first = min(collapsed) if collapsed else None
    safe = [g for g, s in done.items() if s == "ok" and (first is None or g < first)]
    return (max(safe) if safe else None), first
