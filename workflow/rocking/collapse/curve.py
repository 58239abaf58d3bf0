"""One curve of a case under a motion: outcomes at intensities, and where it collapses."""

import time
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import pandas as pd

from rocking.collapse import probability, search
from rocking.collapse.scan import Screen, scan_settings
from rocking.solver import runs


@dataclass(frozen=True)
class Curve:
    """Outcomes of a case under a motion, by ascending intensity.

    Attributes
    ----------
    model, record, direction : str
    table : DataFrame
        pga_g, d_over_b, status ("ok", "overturned", "failed"), collapsed, and what the solver adds.
    spread : float
        Half width of the window over which a collapse probability counts, over the amplitude.
    found
        What the search returns, such as the crossings of a short climb.
    wall_s : float
        Time that it took.
    """

    model: str
    record: str
    direction: str
    table: pd.DataFrame
    spread: float
    found: Any = None
    wall_s: float = float("nan")

    @property
    def pga_g(self):
        """Intensities that were run [g]."""
        return self.table["pga_g"].to_numpy(float)

    @property
    def status(self):
        """Outcome of each: "ok", "overturned" or "failed"."""
        return self.table["status"].to_numpy(object)

    @property
    def runs(self):
        """Number of histories."""
        return len(self.table)

    @cached_property
    def probability(self):
        """Collapse probability by intensity: pga_g, probability, realisations."""
        return probability.from_scan(self.table, self.spread)

    def summary(self):
        """Collapse intensities, as `probability.summary`: pga_safe_g … pga_max_g, reversals."""
        none = pd.DataFrame()
        return probability.summary(self.table, none, none, self.spread)


def collapse_curve(
    case, motion, direction="pos", *, solver="planar", search="scan", settings=None, **options
):
    """Find where a case collapses under a motion.

    Parameters
    ----------
    case : Case
    motion : Motion
    direction : str
        "pos" or "neg": of the record along the outward normal.
    solver : str
        "planar", the compiled one, or "yade".
    search : str
        A name of `search.SEARCHES`: "scan", "climb", "crossings" or "list".
    settings : dict, optional
        What differs from the case's sections ida and ensemble (level_ratio, beyond, max_pga_g,
        realisations, amplitude_spread); from_g, where a climb begins; of a list, pga_g, and scatter
        to run them as realisations.
    options
        Of the solver, see `Screen` and `yade.YadeRuns`.

    Returns
    -------
    Curve

    Raises
    ------
    ValueError
        In one line, for an unknown solver or search, or a case that the solver cannot run.

    Examples
    --------
    >>> from rocking import Case, Motion, collapse_curve
    >>> curve = collapse_curve(Case.configured("W1"), Motion.named("RRS228"), "pos", search="climb")
    >>> bool(0.1 < curve.summary()["pga_collapse_g"] < 0.25)
    True
    """
    began = time.monotonic()
    outcomes = run_by(solver, case, motion, direction, **options)
    power = {} if solver == "planar" else {"power": 0.0}  # a run of YADE takes seconds
    given = {**scan_settings(case.scene), **power, **(settings or {})}
    table, found = outcomes.seen(strategy(search, case, outcomes, given))
    return Curve(
        case.model,
        motion.name,
        direction,
        table,
        given["amplitude_spread"],
        found,
        time.monotonic() - began,
    )


def run_by(solver, case, motion, direction, **options):
    """Outcomes at any amplitudes by a solver: an object with `seen` and `static_g`."""
    case.checked()
    if solver == "planar":
        if not case.kind.scanned:
            raise ValueError(f"model {case.model}: expected return walls, for the planar solver")
        before = motion.before(case, direction)
        time_s, columns = motion.columns(case)
        return Screen(case.scene, time_s, columns, direction, before=before, **options)
    if solver == "yade":
        from rocking.collapse.yade import YadeRuns  # starts YADE's own Python

        return YadeRuns(case, motion, direction, **options)
    raise ValueError(f"solver = {solver!r}: expected planar or yade")


def strategy(name, case, outcomes, settings):
    """Search of a name, from half the static capacity, or `start_g` of the settings."""
    start = settings.get("from_g") or 0.5 * outcomes.static_g
    if name == "list":
        return search.listed(settings["pga_g"], settings.get("scatter", False))
    if name in ("climb", "scan"):
        return search.SEARCHES[name](start, settings, outcomes.block)
    if name == "crossings":
        start = settings.get("from_g") or case.kind.climb_from * outcomes.static_g
        return search.crossings(start, settings["max_pga_g"], case.kind.climb_ratio)
    raise ValueError(f"search = {name!r}: expected scan, climb, crossings or list")


@dataclass(frozen=True)
class History:
    """One history.

    Attributes
    ----------
    table : DataFrame
        time_s, d_over_b, velocity_m_s, rotation_rad (outward), and what the solver adds.
    d_over_b : float
        Largest |d|/b; NaN where the run failed.
    status : str
    broken : int or None
        Bonds that broke; None where the solver does not count them.
    """

    table: pd.DataFrame
    d_over_b: float
    status: str
    broken: int | None = None


def history(case, motion, direction="pos", pga_g=0.1, *, solver="planar", sample_s=0.01):
    """One history of a case under a motion at one intensity.

    Parameters
    ----------
    case, motion, direction
        As of `collapse_curve`.
    pga_g : float
    solver : str
        "planar" or "yade".
    sample_s : float
        Interval between rows; YADE's is 0.01 s.

    Returns
    -------
    History

    Examples
    --------
    >>> from rocking import Case, Motion, history
    >>> found = history(Case.configured("W1"), Motion.named("RRS228"), "neg", 0.1)
    >>> found.status, bool(found.table["d_over_b"].abs().max() <= found.d_over_b)
    ('ok', True)
    """
    if solver == "yade":
        from rocking.collapse.yade import yade_history

        return yade_history(case.checked(), motion, direction, pga_g)
    screen = run_by(solver, case, motion, direction)
    plane = screen.planes[0]
    motions, factor = screen.shaking(pga_g)
    found = runs.history(
        plane,
        motions,
        screen.numerics,
        factor,
        carried=screen.carried,
        step_s=screen.steps_s[0],
        sample_s=sample_s,
    )
    table = pd.DataFrame(
        {
            "time_s": found.time_s,
            "d_over_b": found.d_m / plane.thickness_m,
            "velocity_m_s": found.d_m_s,
            "rotation_rad": -found.pose[:, 2],
        }
    )
    return History(table, found.peak_d_over_b, found.status, found.broken)
