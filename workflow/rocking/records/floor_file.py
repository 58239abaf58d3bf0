"""Floor motions of another program: read, and checked against what floors of a building do.

The file has times and absolute accelerations of the ground and of every floor from the lowest up,
with captions (`time_s, ground_m_s2, floor1_m_s2, …`) or without. The walls behind a façade move as
the floors do, so what is wrong with a column moves a wall: accelerations that are relative to the
ground, another unit, floors from the top down, or a mean that the ground does not have.
"""

import re

import numpy as np
from record_files.captions import TIME_UNITS
from record_files.columns import uniform_step
from record_files.errors import RecordError
from record_files.header import heading_unit
from record_files.layout import layout
from record_files.record import UNITS_M_S2, unit_name
from record_files.text import read_text

from yade_scripts.lists import listed

from .floor_check import GROUND, VERTICAL, check_floors

_FLOOR = re.compile(
    r"(?:floor|storey|story|level|piano|planta|etage|stock\w*|geschoss|f|l)[ _-]?(\d{1,2})", re.I
)
_GROUND = re.compile(r"(?:ground|base|soil|suolo|terreno|boden|floor[ _-]?0|level[ _-]?0)", re.I)


def read_floor_file(path, units=None, columns=None, record=None):
    """Read floor motions of another program.

    Parameters
    ----------
    path : path
        A table with times first.
    units : str, optional
        Of all accelerations, where the captions state none.
    columns : sequence of str, optional
        What the columns after the time are, "ground", "floor1", … and at most "vertical", of a file
        without captions.
    record : Record, optional
        The ground motion that the other program was given; its ground has to be that, scaled or
        not.

    Returns
    -------
    time_s : ndarray, shape (nt,)
    columns : dict of str to ndarray
        Absolute accelerations [m/s²]: "ground", "floor1", …, as `floor_motions.read` gives them.

    Raises
    ------
    RecordError
        In one line that names the file and the column.

    Warns
    -----
    UserWarning
        For floors that drift from the ground, or accelerations of few digits.
    """
    text = read_text(path)
    table = layout(text)
    if table is None or table.time_s is None:
        raise RecordError(f"{path}: expected a column of times, then ground, floor1, …")
    labels = [label for label, _, _ in table.channels]
    if columns is None and any(map(_name, labels)):
        columns = [_name(label) for label in labels]
    if columns is None:
        raise RecordError(
            f"{path}: no captions ground, floor1, …; state columns=['{GROUND}', 'floor1', …] for "
            f"its {len(labels)} columns after the time"
        )
    columns = [str(column) for column in columns]
    _check_names(path, columns, labels)
    factors = _factors(path, labels, columns, units)
    time_s = _times(text, table)
    values = {
        name: factor * np.array(channel[1])
        for name, channel, factor in zip(columns, table.channels, factors, strict=True)
    }
    values = {name: values[name] for name in sorted(values, key=_height)}
    check_floors(path, time_s, values, record)
    return time_s, values


def named(path):
    """What the captions of a file name, "ground", "floor1", …; nothing of a file without."""
    table = layout(read_text(path))
    return [_name(label) for label, _, _ in table.channels] if table else []


def _name(label):
    """What a caption names, "ground", "floor2" or "vertical"; empty for anything else."""
    words = re.sub(r"[(\[].*|_(?:%?m?g|\w+_s2|gal)$", "", label.strip()).strip(" _")
    words = re.sub(r"^(?:acc\w*|a)[ _-]", "", words, flags=re.I)
    floor = _FLOOR.fullmatch(words)
    if floor and int(floor[1]):
        return f"floor{int(floor[1])}"
    if _GROUND.fullmatch(words):
        return GROUND
    return VERTICAL if re.fullmatch(r"vert\w*|up", words, re.I) else ""


def _height(name):
    floor = re.fullmatch(r"floor(\d+)", name)
    return {GROUND: 0, VERTICAL: 1000}.get(name, int(floor[1]) if floor else 999)


def _check_names(path, columns, labels):
    if len(columns) != len(labels):
        raise RecordError(
            f"{path}: {len(labels)} columns after the time, but {len(columns)} are named"
        )
    floors = sorted(_height(name) for name in columns if name.startswith("floor"))
    strange = [
        label or name
        for name, label in zip(columns, labels, strict=True)
        if name not in (GROUND, VERTICAL) and not re.fullmatch(r"floor[1-9]\d?", name)
    ]
    if strange:
        raise RecordError(
            f"{path}: column {strange[0][:40]!r}; expected ground, floor1, floor2, … or vertical"
        )
    if len(set(columns)) != len(columns):
        twice = next(name for name in columns if columns.count(name) > 1)
        raise RecordError(f"{path}: column {twice} appears twice")
    if GROUND not in columns:
        raise RecordError(f"{path}: no column of the ground's acceleration")
    if floors != list(range(1, len(floors) + 1)):
        raise RecordError(
            f"{path}: floors {listed(map(str, floors))}; expected 1 to {len(floors)}, the "
            "lowest first"
        )


def _factors(path, labels, columns, units):
    """Factor to m/s² of every column; all are in one unit."""
    stated = unit_name(units) if units else None
    if units and stated is None:
        raise RecordError(f"{path}: units {units!r}; expected one of {', '.join(UNITS_M_S2)}")
    column_units = []
    for label, name in zip(labels, columns, strict=True):
        said = heading_unit(label)
        if said.against:
            raise RecordError(f"{path}: column {name}: {said.against}; expected an acceleration")
        if said.unit and stated and said.unit != stated:
            raise RecordError(f"{path}: column {name} is in {said.unit}, but {units!r} is stated")
        column_units.append(said.unit or stated)
    if None in column_units:
        known = ", ".join(UNITS_M_S2)
        name = columns[column_units.index(None)]
        raise RecordError(f"{path}: column {name}: no units; state units, one of {known}")
    if len(set(column_units)) > 1:
        several = " and ".join(map(str, dict.fromkeys(column_units)))
        raise RecordError(f"{path}: columns in {several}; expected one")
    return [UNITS_M_S2[str(unit)] for unit in column_units]


def _times(text, table):
    label, cells = table.time
    bracketed = re.search(r"[(\[]([^()\[\]]+)[)\]]|_(m?s)$", label)
    word = next(filter(None, bracketed.groups())).strip().lower() if bracketed else "s"
    if word not in TIME_UNITS:
        raise RecordError(f"{text.path}: time is in {word[:20]!r}; expected seconds")
    factor = TIME_UNITS[word]
    lines = table.block.lines
    first = lines.index(table.channels[0][2])
    at = min(len(lines) - 1, first)
    uniform_step(text, table.time_s, cells, lambda i: lines[min(at + i, len(lines) - 1)])
    return factor * np.array(table.time_s)
