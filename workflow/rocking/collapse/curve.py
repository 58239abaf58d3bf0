"""One curve of a case under a motion: outcomes at intensities, and where it collapses."""

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np
import pandas as pd
from record_files.reader import nearest

from rocking.collapse import building, probability, search
from rocking.collapse.case import Case
from rocking.collapse.equivalent import SLOPE
from rocking.collapse.history import History, Outcome
from rocking.collapse.limits import intensity, positive
from rocking.collapse.motion import Motion
from rocking.collapse.others import within_table
from rocking.collapse.scan import Screen, scan_settings, seen_together
from rocking.configuration import config as configuration
from rocking.configuration import refusals, schema
from rocking.solver import runs
from rocking.solver.first_compilation import say_first_compilation
from yade_scripts.model.motion import SIGNS

OF_A_SEARCH = ("from_g", "pga_g", "scatter")  # settings that no section of a case has
OF_THE_ENSEMBLE = ("realisations", "amplitude_spread")
WHERE = {  # their keys in the configuration, whose limits hold
    **{key: f"ida.{key}" for key in schema.whole()["properties"]["ida"]["properties"]},
    **{key: f"ensemble.{key}" for key in OF_THE_ENSEMBLE},
    "from_g": "ida.start_g",
}
Direction = Literal["pos", "neg"]
Solver = Literal["planar", "yade"]
Search = Literal["scan", "climb", "crossings", "list"]


@dataclass(frozen=True, eq=False)
class Curve(Outcome):
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
        Seconds that the curve took.
    """

    model: str
    record: str
    direction: str
    table: pd.DataFrame
    spread: float
    found: Any = None
    wall_s: float = float("nan")

    @property
    def _facts(self) -> tuple:  # not the time that it took
        return self.model, self.record, self.direction, self.spread, len(self.table)

    def __repr__(self) -> str:
        """Return one line: what it is of, histories, where it collapses."""
        summary = self.summary()
        line = f"Curve {self.model} {self.record} {self.direction}: {self.runs} histories, "
        if math.isnan(summary["pga_collapse_g"]):
            return f"{line}none fell up to {summary['pga_max_g']:.3f} g"
        line += f"lowest collapse {summary['pga_collapse_g']:.3f} g"
        half = summary["pga_median_g"]
        return line if math.isnan(half) else f"{line}, half collapse {half:.3f} g"

    @property
    def pga_g(self) -> np.ndarray:
        """Intensities that were run [g]."""
        return self.table["pga_g"].to_numpy(float)

    @property
    def status(self) -> np.ndarray:
        """Outcome of each: "ok", "overturned" or "failed"."""
        return self.table["status"].to_numpy(object)

    @property
    def runs(self) -> int:
        """Number of histories."""
        return len(self.table)

    @cached_property
    def probability(self) -> pd.DataFrame:
        """Collapse probability by intensity: pga_g, probability, realisations."""
        return probability.from_scan(self.table, self.spread)

    def summary(self, slope: float = SLOPE) -> dict[str, Any]:
        """Collapse intensities by name, as `tables/ida_collapse.csv` has them.

        Parameters
        ----------
        slope : float
            k of a hazard that falls as x⁻ᵏ, for the equivalent PGA.

        Returns
        -------
        dict
            pga_safe_g, pga_collapse_g (lowest collapse), pga_p10_g, pga_median_g (half collapse),
            pga_p90_g, pga_all_g, pga_max_g, pga_equivalent_g (threshold that falls as often in a
            year) [g], NaN where nothing fell; of a building that yields pga_building_g, where its
            own storey reaches its drift, and building_first, 1 where that is first; reversals, and
            the histories behind them. docs/collapse.md says what each means.
        """
        positive("slope", slope)
        none = pd.DataFrame()
        summary = probability.summary(self.table, none, none, self.spread, slope)
        summary |= building.told(self.table, summary, self.spread)
        return {k: v.item() if isinstance(v, np.generic) else v for k, v in summary.items()}


def collapse_curve(
    case: Case,
    motion: Motion,
    direction: Direction = "pos",
    *,
    solver: Solver = "planar",
    search: Search = "scan",
    settings: Mapping[str, Any] | None = None,
    **options: Any,
) -> Curve:
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
        "scan", "climb", "crossings" or "list", see `search`.
    settings : dict, optional
        What differs from the case's sections ida and ensemble (level_ratio, beyond, max_pga_g,
        power, safe_share, realisations, amplitude_spread); from_g, where a climb begins; of a list,
        pga_g, and scatter to run them as realisations.
    options
        Of the solver, see `Screen` and `yade.YadeRuns`.

    Returns
    -------
    Curve

    Raises
    ------
    ValueError
        In one line, for an unknown direction, solver, search or setting, or a case that the solver
        cannot run.
    TypeError
        For arguments that are not a Case and a Motion.

    Examples
    --------
    >>> from rocking import Case, Motion, collapse_curve
    >>> curve = collapse_curve(Case.configured("W1"), Motion.named("RRS228"), "pos", search="climb")
    >>> bool(0.1 < curve.summary()["pga_collapse_g"] < 0.25)
    True
    """
    if solver == "planar":
        how = {"search": search, "settings": [settings or {}], **options}
        return collapse_curves(case, [(motion, direction)], **how)[0]
    began = time.monotonic()
    outcomes = run_by(solver, case, motion, direction, **options)
    # a run of YADE takes seconds
    given = _settings(case, settings, search, power=0.0)
    seen = outcomes.seen(strategy(search, case, outcomes, given))
    return _curve(case, (motion, direction), seen, given, time.monotonic() - began)


def collapse_curves(
    case: Case,
    shaken: Sequence[tuple[Motion, Direction]],
    *,
    search: Search = "scan",
    settings: Mapping[str, Any] | Sequence[Mapping[str, Any]] | None = None,
    **options: Any,
) -> list[Curve]:
    """Find the curves of a case under several motions; their histories march side by side.

    Faster than one curve after the other where searches ask for few histories at a time.

    Parameters
    ----------
    case : Case
    shaken : sequence of (Motion, direction)
    search, options
        As of `collapse_curve`, by the planar solver.
    settings : dict, or sequence of dict, optional
        For all, or one for each.

    Returns
    -------
    list of Curve
        With the same outcomes as one after the other; `wall_s` is each one's share of the time. Of
        brief histories (`scan.Screen`), which begin where the motion does (`Motion.begun`), without
        the building's drifts.
    """
    began = time.monotonic()
    several = [settings] * len(shaken)
    if isinstance(settings, Sequence) and not isinstance(settings, str):
        several = list(settings)
        if len(several) != len(shaken):
            raise ValueError(f"settings: {len(several)} given, expected one, or {len(shaken)}")
    brief = options.get("brief")
    outcomes = [
        run_by("planar", case, motion.begun if brief else motion, direction, **options)
        for motion, direction in shaken
    ]
    given = [_settings(case, chosen, search) for chosen in several]
    for (motion, _), run, chosen in zip(shaken, outcomes, given, strict=True):
        within_table(motion, run.columns, chosen)
    searches = [
        (run, strategy(search, case, run, chosen))
        for run, chosen in zip(outcomes, given, strict=True)
    ]
    seen = seen_together(searches)
    each_s = (time.monotonic() - began) / max(len(shaken), 1)
    return [
        _curve(case, pair, what, chosen, each_s, not brief)
        for pair, what, chosen in zip(shaken, seen, given, strict=True)
    ]


def _settings(case, settings, search, **other):
    """What a search is given: of the case, the solver's own, and what is stated."""
    given = {**scan_settings(case.sections), **other}
    return given | _known(settings or {}, given, search)


def _curve(case, shaken, seen, given, wall_s, told=True):
    """The curve of what a search has seen, with the building's drifts where they are `told`."""
    (motion, direction), (table, found), spread = shaken, seen, given["amplitude_spread"]
    if told:
        table = building.with_building(table, case, motion, direction)
    return Curve(case.model, motion.name, direction, table, spread, found, wall_s)


def run_by(solver, case, motion, direction, **options):
    """Outcomes at any amplitudes by a solver: an object with `seen` and `static_g`."""
    _shaken(case, motion, direction)
    if (fraction := options.get("fraction")) is not None:
        positive("fraction", fraction, 1.0)
    if solver == "planar":
        if not case.kind.scanned:
            raise ValueError(f"model {case.model}: expected return walls, for the planar solver")
        say_first_compilation()
        before = motion.before(case, direction)
        time_s, columns = motion.columns(case)
        return Screen(case.sections, time_s, columns, direction, before=before, **options)
    if solver == "yade":
        from rocking.collapse.yade import YadeRuns  # starts YADE's own Python

        return YadeRuns(case, motion, direction, **options)
    raise ValueError(f"solver = {solver!r}: expected planar or yade")


def _shaken(case, motion, direction):
    """Refuse what is no case, no motion or no direction."""
    for value, kind in ((case, Case), (motion, Motion)):
        if not isinstance(value, kind):
            raise TypeError(f"{type(value).__name__} given: expected a {kind.__name__}")
    if not isinstance(direction, str) or direction not in SIGNS:
        raise ValueError(f"direction = {direction!r}: expected {' or '.join(SIGNS)}")
    case.checked()


def _known(settings, of_case, search):
    """Return the settings of a search, if it knows them all and can begin."""
    if not isinstance(settings, Mapping):
        raise TypeError(f"settings = {settings!r}: expected a mapping, as {{'level_ratio': 0.02}}")
    known = (*of_case, *OF_A_SEARCH)
    for key, value in settings.items():
        if key not in known:
            raise ValueError(f"settings: unknown {key!r}{nearest(str(key), known)}")
        if (place := WHERE.get(key)) is not None:
            _allowed(key, place, value)
    if search == "list":
        levels = np.ravel(settings.get("pga_g", []))
        if not levels.size:
            raise ValueError("search = 'list': expected settings={'pga_g': [0.1, 0.2]} (g)")
        for level in levels.tolist():
            intensity("settings['pga_g']", level)
        return {**settings, "pga_g": levels}
    return dict(settings)


def _allowed(key, place, value):
    """Refuse a setting that the configuration would refuse at its place."""
    try:
        value = schema.plain(value, key)
        refusals.refuse_invalid(configuration.nested({place: value}), schema.whole())
    except schema.ConfigError as error:
        said = error.detail.removeprefix(place)
        raise ValueError(f"settings[{key!r}]{said.removeprefix(key)}") from None


def strategy(name, case, outcomes, settings):
    """Search of a name, from `from_g` of the settings or where its search begins by itself.

    A climb and a scan begin at `start_g`, if the case states it, else at half the static capacity;
    a short climb where its model begins to fall.
    """
    start = settings.get("from_g") or settings.get("start_g") or 0.5 * outcomes.static_g
    if name == "list":
        return search.listed(settings["pga_g"], settings.get("scatter", False))
    if name == "climb":
        return search.climb(start, settings, outcomes.block)
    if name == "scan":
        return search.scan(start, settings, outcomes.block)
    if name == "crossings":
        start = settings.get("from_g") or case.kind.climb_from * outcomes.static_g
        return search.crossings(start, settings["max_pga_g"], case.kind.climb_ratio)
    raise ValueError(f"search = {name!r}: expected scan, climb, crossings or list")


def history(
    case: Case,
    motion: Motion,
    direction: Direction = "pos",
    pga_g: float = 0.1,
    *,
    solver: Solver = "planar",
    sample_s: float = 0.01,
) -> History:
    """Run one history of a case under a motion at one intensity.

    Parameters
    ----------
    case, motion, direction
        As of `collapse_curve`.
    pga_g : float
        Peak acceleration of the ground, whatever the record's own.
    solver : str
        "planar" or "yade".
    sample_s : float
        Interval between rows; YADE's is 0.01 s.

    Returns
    -------
    History

    Raises
    ------
    ValueError, TypeError
        As of `collapse_curve`, and for an intensity or interval that is not a number above 0.

    Examples
    --------
    >>> from rocking import Case, Motion, history
    >>> run = history(Case.configured("W1"), Motion.named("RRS228"), "neg", 0.1)
    >>> run.status, bool(run.table["d_over_b"].abs().max() <= run.d_over_b)
    ('ok', True)
    """
    intensity("pga_g", pga_g)
    positive("sample_s", sample_s)
    if solver == "yade":
        from rocking.collapse.yade import yade_history

        _shaken(case, motion, direction)
        return yade_history(case, motion, direction, pga_g)
    return _planar_history(run_by(solver, case, motion, direction), pga_g, sample_s)


def _planar_history(run, pga_g, sample_s):
    """One history of a screen of `run_by`, at one intensity."""
    (screen,) = run.routes([pga_g])
    plane = screen.planes[0]
    (motions,), (factor,) = screen.shaking(pga_g)
    series = runs.history(
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
            "time_s": series.time_s,
            "d_over_b": series.d_m / plane.thickness_m,
            "velocity_m_s": series.d_m_s,
            "rotation_rad": -series.pose[:, 2],
        }
    )
    return History(table, series.peak_d_over_b, series.status, series.broken)
