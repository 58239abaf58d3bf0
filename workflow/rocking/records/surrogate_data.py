"""Surrogate parameters from config/surrogates.yaml, every key checked."""

import math
import reprlib
from dataclasses import fields

import yaml
from record_files.errors import RecordError
from record_files.reader import nearest
from record_files.record import MAX_DT_S, MIN_DT_S
from record_files.text import read_text

from yade_scripts.lists import listed

from .surrogate_model import SOLVABLE_NOISE, SOLVABLE_PULSE, Noise, Pulse, Spec

KEYS = ("dt_s", "pulses", "noise", "solve", "notes")
MAX_PULSES = 20
MAX_LINES = 20_000
SMALLEST, LARGEST = 1e-4, 1e4  # far beyond any sensible parameter in its units


def read_specs(path):
    """Read the surrogate parameters (`Spec`) of all records in a file.

    A RecordError names the file and the key (or, for YAML itself, the line).
    """
    text = read_text(path)
    if len(text.lines) > MAX_LINES:
        raise RecordError(f"{path}: more than {MAX_LINES} lines")
    try:
        data = yaml.safe_load("\n".join(text.lines))
    except yaml.YAMLError as problem:
        mark = getattr(problem, "problem_mark", None)
        line = mark.line + 1 if mark else 1
        raise text.error(line, f"not YAML: {getattr(problem, 'problem', None)}") from None
    except (ValueError, RecursionError) as problem:
        # Impossible dates raise ValueError; thousands of brackets exhaust the parser's stack.
        raise RecordError(f"{path}: not YAML: {str(problem)[:80]}") from None
    if not isinstance(data, dict):
        raise RecordError(f"{path}: expected a mapping of record names to parameters")
    for name in data:
        if not isinstance(name, str | int):
            raise RecordError(f"{path}: {reprlib.repr(name)}; expected the name of a record")
    return {str(name): _spec(f"{path}: {name}", entry) for name, entry in data.items()}


def _spec(where, entry):
    _keys(where, entry, KEYS, {"pulses", "noise", "solve"})
    if not isinstance(entry["pulses"], list) or not 1 <= len(entry["pulses"]) <= MAX_PULSES:
        raise RecordError(f"{where}.pulses: expected a list of 1 to {MAX_PULSES} pulses")
    pulses = tuple(
        _build(Pulse, f"{where}.pulses.{i}", pulse) for i, pulse in enumerate(entry["pulses"])
    )
    for i, pulse in enumerate(pulses):
        if pulse.cycles <= 1:
            raise RecordError(f"{where}.pulses.{i}.cycles: {pulse.cycles:g}; expected more than 1")
    noise = _build(Noise, f"{where}.noise", entry["noise"])
    dt_s = entry.get("dt_s", 0.01)
    if not _is_number(dt_s) or not MIN_DT_S <= dt_s <= MAX_DT_S:
        raise RecordError(
            f"{where}.dt_s: {reprlib.repr(dt_s)}; expected {MIN_DT_S:g} … {MAX_DT_S:g} s"
        )
    solvable = [f"noise.{key}" for key in SOLVABLE_NOISE]
    solvable += [f"pulses.{i}.{key}" for i in range(len(pulses)) for key in SOLVABLE_PULSE]
    solve = entry["solve"]
    if not isinstance(solve, list) or not 3 <= len(solve) <= 20:
        raise RecordError(f"{where}.solve: expected three or more different parameter names")
    for name in solve:
        if not isinstance(name, str) or name not in solvable or solve.count(name) > 1:
            shown = reprlib.repr(name)
            raise RecordError(
                f"{where}.solve: unknown or repeated parameter {shown}{nearest(shown, solvable)}"
            )
    notes = entry.get("notes", "")
    if not isinstance(notes, str):
        raise RecordError(f"{where}.notes: expected text")
    spec = Spec(float(dt_s), pulses, noise, tuple(solve), notes)
    if any(abs(value) < SMALLEST for value in spec.values()):
        raise RecordError(f"{where}.solve: a parameter to solve for may not start at zero")
    return spec


def _keys(where, entry, known, required):
    if not isinstance(entry, dict):
        raise RecordError(f"{where}: expected a mapping with {listed(known)}")
    for key in entry:
        if key not in known:
            raise RecordError(
                f"{where}: unknown key {reprlib.repr(key)}{nearest(reprlib.repr(key), known)}"
            )
    for key in known:
        if key in required and key not in entry:
            raise RecordError(f"{where}: key {key!r} is missing")


def _is_number(value):
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _build(kind, where, entry):
    """Build a Pulse or Noise; all values finite, all but amplitude and phase positive."""
    names = [f.name for f in fields(kind)]
    _keys(where, entry, names, set(names))
    for key, value in entry.items():
        if not _is_number(value):
            raise RecordError(f"{where}.{key}: {reprlib.repr(value)}; expected a number")
        if key in ("amplitude_m_s", "phase_deg"):
            if abs(value) > LARGEST:
                raise RecordError(f"{where}.{key}: {value:g}; expected at most {LARGEST:g}")
        elif not SMALLEST <= value <= LARGEST:
            raise RecordError(
                f"{where}.{key}: {value:g}; expected it positive, {SMALLEST:g} … {LARGEST:g}"
            )
    return kind(**{key: float(value) for key, value in entry.items()})
