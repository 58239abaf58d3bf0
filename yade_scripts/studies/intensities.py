"""Which intensities YADE runs, and where a curve of them collapses, as pure functions."""

import math

DIGITS = 4  # intensities are rounded to 1e-4 g so that tables and caches agree


def next_intensity(done, settings, plan=None):
    """Return the next PGA to run [g], or None when the curve is complete.

    Parameters
    ----------
    done : dict of float to str
        Status ("ok", "overturned", "failed") of each PGA already run.
    settings : dict
        Section ida of the configuration: mode, grid_g.
    plan : sequence of float, optional
        Intensities that a dense scan asks for [g]; not needed with mode "grid", whose list counts.

    Raises
    ------
    ValueError
        One line, without either.
    """
    if settings["mode"] == "grid":
        plan = settings["grid_g"]
    if plan is None:
        raise ValueError("ida.mode = adaptive: expected the plan of a dense scan (--plan)")
    left = [round(g, DIGITS) for g in plan if round(g, DIGITS) not in done]
    return min(left, default=None)


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
