"""Where the methods fail: a map over what people ask of a façade.

Each cell changes the configuration, or the motion, and says what becomes of it. At two shares of
the lowest collapse of a coarse climb the compiled solver runs with its own step and with half of
it, in other layouts of nodes and with amplitudes a millionth and a ten-thousandth apart; the
reference solver, which shares no line with it, runs the same.

    refused          in one line, when the configuration is read
    agree            both solvers within `AGREE`
    one solver       it repeats, and the reference solver does not know the model
    disagree         further apart, although the history repeats
    does not repeat  small changes move d/b more than `TRUSTED` times as much, or nodes or step by
                     more than `AGREE`
    too costly       a scan of `SCAN_RUNS` histories would take a processor longer than `LIMIT_S`
    failed           a solver gave no number
"""

import math
from dataclasses import replace

import numpy as np
from reference_solver.facade import answers
from rocking.collapse import search
from rocking.collapse.case import Case
from rocking.collapse.curve import run_by
from rocking.collapse.motion import Motion
from rocking.configuration.schema import ConfigError
from rocking.configuration.study import as_in_the_study
from rocking.solver.runs import STEP_FRACTION

from yade_scripts.model.registry import REFERENCE_MODELS

SHARES = (0.5, 0.8)  # of the lowest collapse
AGREE, TRUSTED = 0.01, 10.0
CHANGES = (1e-6, 1e-4)
SCAN_RUNS, STEP_COST_S, LIMIT_S = 800, 2e-7, 600.0
CLIMB = {"level_ratio": 0.15, "beyond": 1.1, "max_pga_g": 3.0}
NODES, TOLERANCE = 33, 1e-6  # of the reference solver
HEIGHTS_M, THICKNESSES_M = (2.0, 3.0, 4.5, 6.5, 9.0, 13.0, 18.0), (0.12, 0.25, 0.375, 0.6, 1.0)
AXES = {
    "β [s]": ("damping.beta_s", (0.0, 1e-5, 1e-3, 0.01, 0.03, 0.1)),
    "friction [°]": ("friction_deg", (0.0, 1.0, 2.0, 3.0, 10.0, 60.0)),
    "T1 [s]": ("smdof.period_s", (0.05, 0.1, 0.2, 0.5, 1.0, 1.5)),
    "gap [mm]": ("facade.gap_m", (0.0, 0.001, 0.002, 0.005, 0.02, 0.1)),
    "E [MPa]": ("facade.e_mpa", (20.0, 100.0, 500.0, 2000.0, 2e4, 1e5)),
    "walls' mass [t]": ("return_wall.building_mass_kg", (1e2, 500.0, 2e3, 1e4, 1e5, 1e6)),
    "record's step [s]": ("dt_s", (0.001, 0.002, 0.01, 0.02)),
    "duration [s]": ("duration_s", (10.0, 30.0, 60.0, 120.0)),
}
MODELS = {"T1 [s]": ("W2",), "walls' mass [t]": ("W2m",)}  # that an axis concerns; else both
COLUMNS = ["model", "axis", "value", "thickness_m", "verdict", "why"]
COLUMNS += ["pga_collapse_g", "d_over_b", "error", "step_s", "steps"]
ORDER = ("agree", "one solver", "does not repeat", "disagree", "too costly", "failed", "refused")


def cells():
    """Axis, value, thickness or None, model, changes of the configuration, and of the motion."""
    for model in ("W1", "W2"):
        for h in HEIGHTS_M:
            for b in THICKNESSES_M:
                yield "height [m]", h, b, model, {"facade": {"height_m": h, "thickness_m": b}}, {}
    for axis, (key, values) in AXES.items():
        for model in MODELS.get(axis, ("W1", "W2")):
            for value in values:
                changes, motion = {}, {}
                if key in ("dt_s", "duration_s"):
                    motion = {key: value}
                elif key == "friction_deg":
                    changes = {"facade": {key: value}, "return_wall": {key: value}}
                else:
                    section, name = key.split(".")
                    changes = {section: {name: value}}
                yield axis, value, None, model, changes, motion


def shaped(record, dt_s=None, duration_s=None):
    """A record at another step, linear between its samples, or repeated to a duration."""
    a, step = record.acceleration_m_s2, record.dt_s
    if duration_s:
        count = round(duration_s / step)
        a = np.tile(a, -(-count // a.size))[:count]
    if dt_s:
        at = np.arange(0.0, (a.size - 1) * step, dt_s)
        a, step = np.interp(at, step * np.arange(a.size), a), dt_s
    return replace(record, acceleration_m_s2=a, dt_s=step, vertical_m_s2=None)


def verdict_of(model, changes, record, direction):
    """What becomes of one cell: verdict, why, and the numbers behind it, the rest of COLUMNS."""
    try:
        case = Case.configured(model, as_in_the_study(changes))
        given = "planar", case, Motion(record), direction
        full, half = run_by(*given), run_by(*given, fraction=0.5 * STEP_FRACTION)
    except (ConfigError, ValueError) as error:
        return {"verdict": "refused", "why": str(error)}
    time_s, columns = full.time_s, full.columns
    step_s, steps = full.steps_s[0], math.ceil(time_s[-1] / full.steps_s[0])
    row, scan_s = {"step_s": step_s, "steps": steps}, SCAN_RUNS * steps * STEP_COST_S
    if scan_s > LIMIT_S:
        why = f"a scan would take some {scan_s / 3600.0:.1f} h"
        return {**row, "verdict": "too costly", "why": why}
    levels, _ = full.seen(search.climb(0.5 * full.static_g, CLIMB))
    fell = levels.loc[levels["collapsed"] == 1, "pga_g"]
    lowest = float(fell.min()) if len(fell) else CLIMB["max_pga_g"]
    row["pga_collapse_g"] = lowest
    worst = {"verdict": "agree", "why": "", "error": 0.0}
    for share in SHARES:
        at = _at(share * lowest, case, (time_s, columns), full, half, direction)
        if ORDER.index(at["verdict"]) > ORDER.index(worst["verdict"]) or not worst.get("d_over_b"):
            worst = at
    return {**row, **worst}


def _at(pga_g, case, moving, full, half, direction):
    """Verdict at one intensity."""
    value = float(full.run([pga_g], scatter=False)["d_over_b"].iloc[0])
    near = half.run([pga_g, *(pga_g * (1.0 + c) for c in CHANGES)], scatter=False)["d_over_b"]
    nodes = half.run([pga_g] * 3, scatter=True)["d_over_b"].to_numpy()
    base = float(near.iloc[0])
    row = {"d_over_b": base, "error": np.nan}
    if not np.isfinite([value, base, *nodes]).all():
        return {**row, "verdict": "failed", "why": "the compiled solver gave no number"}
    gain = max(abs(d - base) / c for d, c in zip(near.iloc[1:], CHANGES, strict=True))
    moved = max(abs(nodes / base - 1.0).max(), abs(value / base - 1.0))
    if gain > TRUSTED or moved > AGREE:
        why = f"{gain:.0f} times a change of amplitude; nodes and step {100.0 * moved:.1f} %"
        return {**row, "verdict": "does not repeat", "why": why}
    if case.model not in REFERENCE_MODELS:
        return {**row, "verdict": "one solver", "why": ""}
    other = answers(case.sections, moving, direction, [pga_g], nodes=NODES, tolerance=TOLERANCE)
    error = float(value / other.d_over_b[0] - 1.0)
    if not np.isfinite(error):
        return {**row, "verdict": "failed", "why": "the reference solver gave no number"}
    verdict = "agree" if abs(error) <= AGREE else "disagree"
    return {**row, "error": error, "verdict": verdict, "why": ""}
