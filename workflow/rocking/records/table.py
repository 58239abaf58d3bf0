"""The records table: one motion a row, cells apart by tabs, every cell checked.

A table without a tab, as a spreadsheet saves it, has its cells apart by semicolons or commas,
in quotation marks where they hold one.

Columns: record, file (relative to the table's folder or absolute; empty: surrogate),
format, dt_s, units (empty: from the file), component (label, azimuth or "#n" in a file
with several), vertical and vertical_file (component and, where it is another, file of the
vertical motion), floors (floor motions of another program, see `floor_table`) and
floors_building ("elastic": those of one file scale with the ground), station (of the
instrument: components of one are drawn together in every interval), then event, mw,
distance_km, soil for the reader and pga_g, pgv_cm_s, pgd_cm, duration_s, which a surrogate
must have. Only `record` is required.
Lines that start with # are comments.
"""

import csv
import os
import re
from dataclasses import dataclass, field

from record_files import FORMATS
from record_files.errors import RecordError
from record_files.reader import nearest
from record_files.record import MAX_DT_S, MIN_DT_S, UNITS_M_S2, unit_name
from record_files.text import parse_number, read_text

from yade_scripts.lists import listed

FILE_COLUMNS = ("file", "vertical_file", "floors")
TARGETS = ("pga_g", "pgv_cm_s", "pgd_cm", "duration_s")
ABOUT = ("event", "station", "mw", "distance_km", "soil")
NUMBER_COLUMNS = ("dt_s", "mw", "distance_km", *TARGETS)
COLUMNS = (
    *("record", *FILE_COLUMNS, "format", "units", "component", "vertical", "floors_building"),
    *("event", "station", "soil", *NUMBER_COLUMNS),
)
ELASTIC = "elastic"  # the one building whose floors scale with the ground
MAX_NAME = 64
SEPARATED = {"\t": "tabs", ";": "semicolons", ",": "commas"}
_NAME = re.compile(r"[A-Za-z0-9_+][A-Za-z0-9._+-]*")


@dataclass(frozen=True)
class Row:
    """One motion of a records table; None where a cell is empty.

    path is the record file's path, None for a surrogate; line the table's line;
    vertical_path and vertical are file and component of the vertical motion. floors_path is
    the file of floor motions that another program computed, or the table of such files by PGA.
    """

    record: str
    path: str | None = None
    format: str | None = None
    dt_s: float | None = None
    units: str | None = None
    component: str | None = None
    targets: dict = field(default_factory=dict)
    about: dict = field(default_factory=dict)
    line: int = 0
    vertical_path: str | None = None
    vertical: str | None = None
    floors_path: str | None = None
    floors_building: str | None = None

    @property
    def source(self):
        """Return "file" or "surrogate"."""
        return "surrogate" if self.path is None else "file"

    @property
    def station(self):
        """Station that the table names; the record itself where it names none."""
        return str(self.about.get("station") or self.record)

    def stated(self, vertical=False):
        """Return what the row states of its file: keywords of `reader.pick`."""
        component = self.vertical if vertical else self.component
        stated = {"component": component, "dt_s": self.dt_s, "units": self.units}
        return {"name": self.record, **stated}


def check_name(name, where):
    """Refuse a record name that is not safe in file names and command lines.

    Letters, digits and . _ + - only, at most MAX_NAME, not starting with . or -.
    """
    if not _NAME.fullmatch(name) or len(name) > MAX_NAME:
        raise RecordError(
            f"{where}: record name {name[:80]!r}; expected letters, digits and . _ + - only, "
            f"at most {MAX_NAME}, not starting with . or -"
        )


def read_table(path) -> dict[str, Row]:
    """Read and check a records table.

    Returns
    -------
    dict of str to Row
        In the table's order.

    Raises
    ------
    RecordError
        Naming the table, the line and what was expected.
    """
    text = read_text(path)
    lines = text.said()
    if not lines:
        raise RecordError(f"{text.path}: no header line")
    number, header = lines[0]
    separator = next((mark for mark in "\t;," if mark in header), "\t")
    columns = split_line(text, number, header, separator)
    _check_columns(text, number, columns)
    rows: dict[str, Row] = {}
    seen: dict[str, int] = {}
    for number, line in lines[1:]:
        cells = split_line(text, number, line, separator, len(columns))
        if not any(cells):
            continue
        if len(cells) > len(columns) or (len(cells) == 1 and len(columns) > 1 and " " in cells[0]):
            how = SEPARATED[separator]
            raise text.error(
                number, f"{len(cells)} cells; expected {len(columns)} separated by {how}"
            )
        named = dict(zip(columns, cells, strict=False))
        if separator == ";":  # where commas are for decimals
            named |= {c: named[c].replace(",", ".") for c in NUMBER_COLUMNS if c in named}
        row = _row(text, number, named)
        # Compared without case: some file systems cannot keep "a" and "A" apart.
        if row.record.lower() in seen:
            raise text.error(
                number, f"record {row.record!r} is already in line {seen[row.record.lower()]}"
            )
        seen[row.record.lower()] = number
        rows[row.record] = row
    if not rows:
        raise RecordError(f"{text.path}: no record below the header")
    return rows


def split_line(text, number, line, separator, least=0):
    """Cells of a line without the blanks around them; quotation marks count where tabs do not.

    Where tabs do not, empty cells at the end are dropped down to `least`: spreadsheets pad rows.
    """
    if separator == "\t":
        return [cell.strip() for cell in line.split(separator)]
    try:
        (cells,) = csv.reader([line], delimiter=separator, strict=True)
    except (csv.Error, ValueError):
        raise text.error(number, "a quotation mark that opens or ends within a cell") from None
    while len(cells) > least and not cells[-1].strip():
        cells.pop()
    return [cell.strip() for cell in cells]


def _check_columns(text, number, columns):
    for column in columns:
        if column not in COLUMNS:
            hint = "; the header is not tab-separated" if re.search("[ ,;]", column) else ""
            raise text.error(
                number, f"unknown column {column[:60]!r}{hint or nearest(column, COLUMNS)}"
            )
        if columns.count(column) > 1:
            raise text.error(number, f"column {column!r} appears twice")
    if "record" not in columns:
        raise text.error(number, "no column 'record'")


def _row(text, number, cells):
    cells = {column: cell for column, cell in cells.items() if cell}
    name = cells.get("record", "")
    check_name(name, f"{text.path}, line {number}")
    numbers = _numbers(text, number, cells)
    form, units, vertical = (cells.get(column) for column in ("format", "units", "vertical"))
    if form and form.lower() not in FORMATS:
        raise text.error(number, f"unknown format {form!r}{nearest(form.lower(), FORMATS)}")
    if units and unit_name(units) is None:
        raise text.error(
            number, f"unknown units {units!r}; expected one of {', '.join(UNITS_M_S2)}"
        )
    paths = {}
    for column in FILE_COLUMNS:
        if column in cells:
            path = os.path.join(os.path.dirname(text.path), cells[column])
            if not os.path.isfile(path):
                said = "no regular file" if os.path.lexists(path) else "no file"
                raise text.error(number, f"record {name}: {said} {cells[column]!r} ({path})")
            paths[column] = path
    horizontal = paths.get("file")
    if horizontal is None and "floors" in paths:
        raise text.error(
            number,
            f"record {name}: floors without a file; expected in the column file the motion that "
            "the building was given",
        )
    if horizontal is None and (vertical or paths):
        raise text.error(number, f"record {name}: a vertical motion without a file")
    building = _floors_building(text, number, name, cells)
    missing = [column for column in TARGETS if column not in numbers]
    if horizontal is None and missing:
        raise text.error(
            number, f"record {name}: no file, and a surrogate needs a value of {listed(missing)}"
        )
    return Row(
        name,
        horizontal,
        form,
        numbers.get("dt_s"),
        units,
        cells.get("component"),
        targets={column: numbers[column] for column in TARGETS if column in numbers},
        about={column: numbers.get(column, cells[column]) for column in ABOUT if column in cells},
        line=number,
        vertical_path=paths.get("vertical_file", horizontal if vertical else None),
        vertical=vertical,
        floors_path=paths.get("floors"),
        floors_building=building,
    )


def _floors_building(text, number, name, cells):
    """Which building a row's floors are of: `ELASTIC`, or None."""
    said = cells.get("floors_building")
    if said is not None and "floors" not in cells:
        raise text.error(number, f"record {name}: floors_building = {said!r} without floors")
    if said not in (None, ELASTIC):
        raise text.error(
            number, f"record {name}: floors_building = {said[:40]!r}; expected {ELASTIC} or nothing"
        )
    return said


def _numbers(text, number, cells):
    """Cells of a row that hold numbers, by column."""
    numbers = {}
    for column in NUMBER_COLUMNS:
        if column in cells:
            value = parse_number(text, number, cells[column], f"a number in {column}")
            if value < 0 or (value == 0 and column != "distance_km"):
                raise text.error(number, f"{column} is {cells[column]!r}; expected it positive")
            numbers[column] = value
    if "dt_s" in numbers and not MIN_DT_S <= numbers["dt_s"] <= MAX_DT_S:
        raise text.error(
            number, f"dt_s is {numbers['dt_s']:g}; expected {MIN_DT_S:g} … {MAX_DT_S:g} s"
        )
    return numbers


def second_component(rows, name):
    """Name of the other record with the same event and station; None for none or several."""
    place = _place(rows[name])
    mates = [other for other, row in rows.items() if other != name and _place(row) == place]
    return mates[0] if len(mates) == 1 and all(place) else None


def _place(row):
    return row.about.get("event"), row.about.get("station")
