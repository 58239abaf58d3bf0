"""What shakes a case: a record, or floor motions that were made of one, and a shock before it."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from numbers import Real
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike
from record_files.record import UNITS_M_S2, begun, check_plausible, measures, unit_name

from rocking.collapse.others import check_floors, fit
from rocking.records import Record, RecordError, load, read_record, read_table
from rocking.records.floor_file import read_floor_file
from rocking.records.floor_table import read_floor_table
from rocking.records.floors import floor_columns
from rocking.shipped import found, shipped
from rocking.solver.storeys import march
from yade_scripts.lists import listed
from yade_scripts.model import floor_motions, yielding
from yade_scripts.model.motion import amplitude
from yade_scripts.model.storeys import storey_height

if TYPE_CHECKING:
    from rocking.collapse.case import Case, Variant

TABLES = ("config/suites/recorded_suite.tsv", "config/records.tsv")  # of what may be named alone
LEAST = {"vertical": -math.inf, "first_pga_g": 0.0, "pause_s": 0.0}  # numbers of a variant
NOT_NUMBERS = {"c": "complex numbers", "b": "truth values", "U": "texts", "S": "bytes"}  # numpy's
PAUSE_S = 10.0  # between two shocks, beyond the free vibration of the first (smdof.tail_s)


@dataclass(frozen=True, eq=False)
class Motion:
    """A motion of the ground, scaled to any peak acceleration.

    Attributes
    ----------
    record : rocking.records.Record, or None
        The horizontal motion across the façade, with its vertical one where that counts.
    floors : (time_s, columns), or None
        Floor motions instead of a record, as `floor_motions.read` gives them.
    label : str
        Name of floor motions.
    file : str
        Where floor motions were read.
    first : Motion, or None
        A shock before this one, on the same case and in the same direction.
    first_pga_g : float
        Peak ground acceleration of that shock; 0: no first shock.
    pause_s : float
        From the end of its motion to the beginning of this one.
    of_chain : bool
        Floor motions are those of the case's own chain of masses, as the workflow writes them.

    Examples
    --------
    >>> from rocking import Motion
    >>> Motion.named("RRS228")
    Motion RRS228: 1491 samples of 0.01 s, peak 0.840 g
    >>> Motion.sampled([0.0, 0.2, -0.1, 0.0], 0.02, "g", name="mine")
    Motion mine: 4 samples of 0.02 s, peak 0.200 g
    """

    record: Any = None
    floors: tuple | None = None
    label: str = ""
    file: str = ""
    first: "Motion | None" = None
    first_pga_g: float = 0.0
    pause_s: float = PAUSE_S
    of_chain: bool = False
    _kept: dict = field(default_factory=dict, init=False, repr=False, compare=False)

    def __post_init__(self):
        """Check that there is a motion."""
        if self.floors is not None:
            check_floors(self.floors)
        if self.floors is None and not isinstance(self.record, Record):
            raise TypeError(
                f"Motion of {type(self.record).__name__}: expected Motion.named(name), "
                "Motion.read(path) or, of samples in memory, Motion.sampled(acceleration, dt_s)"
            )

    def __repr__(self) -> str:
        """Return one line: name, samples, peak, what comes before."""
        if self.floors is not None:
            return f"Motion {self.name}: floor motions, {len(self.floors[0])} samples"
        peak = measures(self.record)["pga_g"]
        line = f"Motion {self.name}: {len(self.record)} samples of {self.record.dt_s:g} s, "
        line += f"peak {peak:.3f} g"
        line += ", vertical too" if self.record.vertical_m_s2 is not None else ""
        if self.first is not None and self.first_pga_g:
            line += f", after {self.first.name} at {self.first_pga_g:g} g"
        return line

    def __eq__(self, other: object) -> bool:
        """Tell whether two motions shake alike: names, samples, steps, and what comes before."""
        return self._content == other._content if isinstance(other, Motion) else NotImplemented

    def __hash__(self) -> int:
        """Return the hash of what `==` compares."""
        return hash(self._content)

    @property
    def _content(self):
        record, floors = self.record, self.floors
        content: tuple = (self.name, self.first, self.first_pga_g, self.pause_s, self.of_chain)
        if record is not None:
            rows = record.acceleration_m_s2, record.vertical_m_s2
            content += (record.dt_s, *(None if row is None else _bytes(row) for row in rows))
        if floors is not None:
            columns = ((name, _bytes(values)) for name, values in floors[1].items())
            content += (_bytes(floors[0]), *columns)
            if isinstance(floors[1], yielding.ByAmplitude):
                content += (floors[1].identity,)
        return content

    @classmethod
    def named(cls, name: str, table: str | PathLike | None = None, **how: Any) -> "Motion":
        """Motion of one row of a records table.

        Parameters
        ----------
        name : str
            In the table's column record.
        table : path or None
            One of the project's own may be named by its place in the project, wherever that is
            installed. None: the recorded suite, then the study's four, which are surrogates.
        how
            Of `rocking.records.load`: baseline, seed; vertical_motion="on" adds the vertical one.

        Raises
        ------
        RecordError
            In one line that names the table, and row or file.
        """
        given = (("name", name), *([] if table is None else [("table", table)]))
        for what, value in given:
            if not isinstance(value, (str, PathLike)):
                raise TypeError(f"Motion.named: {what} = {value!r}: expected text")
        if table is None:
            tables = [shipped(path) for path in TABLES]
            table = next((path for path in tables if name in read_table(path)), tables[-1])
        return cls(load(name, str(found(table)), **how))

    @classmethod
    def read(cls, path: str | PathLike, **how: Any) -> "Motion":
        """Motion of an accelerogram's file.

        Parameters
        ----------
        path : path
            Of any format that a records table may name (docs/motions.md).
        how
            Of `rocking.records.read_record`: name, format, component, and dt_s and units where the
            file does not state them.

        Raises
        ------
        RecordError
            In one line that names the file and the line.
        """
        return cls(read_record(str(path), **how))

    @classmethod
    def sampled(
        cls, acceleration: ArrayLike, dt_s: float, units: str = "m/s2", name: str = "motion"
    ) -> "Motion":
        """Motion of samples in memory, as an instrument or another program gives them.

        Parameters
        ----------
        acceleration : array_like, shape (n,)
            At equal steps, outward positive.
        dt_s : float
        units : str
            Of the acceleration: "g", "m/s2", "cm/s2" or "mm/s2".
        name : str

        Raises
        ------
        RecordError
            In one line, for a name that is no text, unknown units, a step or samples of no record.
        """
        if not isinstance(name, str):
            raise RecordError(f"Motion.sampled: name = {name!r}: expected text")
        unit = unit_name(str(units))
        if unit is None:
            raise RecordError(
                f"record {name}: units {units!r}; expected one of {', '.join(UNITS_M_S2)}"
            )
        try:
            for kind in (np.asanyarray(acceleration).dtype.kind, np.asanyarray(dt_s).dtype.kind):
                if kind in NOT_NUMBERS:
                    raise TypeError(f"{NOT_NUMBERS[kind]} are no acceleration or step")
            samples = np.ma.asarray(acceleration, dtype=float).filled(np.nan) * UNITS_M_S2[unit]
            step_s = float(dt_s)
        except (TypeError, ValueError) as error:
            raise RecordError(f"record {name}: expected samples and a step (s): {error}") from None
        if samples.ndim != 1:
            raise RecordError(f"record {name}: samples of shape {samples.shape}; expected one row")
        record = Record(name, samples, step_s, "file", unit)
        check_plausible(samples, unit, f"record {name}")
        return cls(record)

    @classmethod
    def read_floors(
        cls,
        path: str | PathLike,
        name: str = "",
        *,
        units: str | None = None,
        columns: Sequence[str] | None = None,
        record: "Motion | Record | None" = None,
    ) -> "Motion":
        """Floor motions that another program computed, of absolute accelerations.

        Parameters
        ----------
        path : path
            Times, ground and floors from the lowest up, see `rocking.records.floor_file`.
        name : str
            The file's stem by default.
        units : str, optional
            Where the captions state none: "g", "m/s2", …
        columns : sequence of str, optional
            What the columns after the time are, "ground", "floor1", …, without captions.
        record : Motion, optional
            The ground motion that the other program was given, to be compared.

        Raises
        ------
        RecordError
            In one line that names the file and the column.

        Notes
        -----
        The motions of all floors are scaled with the ground's peak: those of a yielding building
        hold at the intensity for which they were computed alone.
        """
        given = record.record if isinstance(record, Motion) else record
        floors = read_floor_file(str(path), units, columns, given)
        return cls(floors=floors, label=name or Path(path).stem, file=str(path))

    @classmethod
    def read_floor_table(
        cls,
        path: str | PathLike,
        name: str = "",
        *,
        units: str | None = None,
        columns: Sequence[str] | None = None,
        record: "Motion | Record | None" = None,
    ) -> "Motion":
        """Floor motions that another program computed at several intensities, by PGA.

        Parameters
        ----------
        path : path
            A table (CSV) with pga_g, ascending by at most a quarter, and file, one an intensity.
        name, units, columns, record
            As of `read_floors`, of every file.

        Raises
        ------
        RecordError
            In one line that names the table or the file.

        Notes
        -----
        Between two intensities the floors are mixed in proportion; below the lowest they are
        scaled; a PGA above the highest is refused, so a search needs `ida.max_pga_g` below it.
        """
        given = record.record if isinstance(record, Motion) else record
        floors = read_floor_table(str(path), units, columns, given)
        return cls(floors=floors, label=name or Path(path).stem, file=str(path))

    @classmethod
    def of_workflow(cls, path: str | PathLike, name: str = "") -> "Motion":
        """Floor motions that the workflow wrote, `smdof/{record}_{n}dof.csv`.

        They are of the case's chain, or at several intensities those of another program.

        Raises
        ------
        ValueError
            In one line that names the file.
        """
        floors = floor_motions.read(path)
        of_chain = not isinstance(floors[1], yielding.TabulatedFloors)
        return cls(floors=floors, label=name, file=str(path), of_chain=of_chain)

    @property
    def name(self) -> str:
        """Name of the record, or of the floor motions."""
        return self.record.name if self.record is not None else self.label

    def varied(self, variant: "Variant") -> "Motion":
        """Return the motion with a variant's changes.

        Its `motion` may hold: vertical, the share of the vertical motion that counts; surrogate,
        the keywords of `named` whose motion of the same name takes its place; first, a Motion
        before it or the keywords of `named`; first_pga_g; pause_s.

        Raises
        ------
        ValueError
            In one line, for anything else.
        TypeError
            For anything but a variant.
        """
        changes = getattr(variant, "motion", None)
        if not isinstance(changes, Mapping):
            raise TypeError(
                f"{type(variant).__name__} given: expected a Variant, as Variant(motion={{…}})"
            )
        out, given = self, _known(changes, variant.name)
        if self.floors is not None and given.keys() & {"surrogate", "vertical"}:
            raise ValueError(
                f"variant '{variant.name}': motion {listed(given)}: expected the motion of a "
                "record, not floor motions"
            )
        if (how := given.pop("surrogate", None)) is not None:
            out = replace(out, record=Motion.named(out.name, **how).record)
        if (share := given.pop("vertical", None)) is not None:
            up = out.record.vertical_m_s2
            if share and up is None:
                raise ValueError(
                    f"variant '{variant.name}': record {out.name} has no vertical motion; expected "
                    "Motion.named(…, vertical_motion='on')"
                )
            record = replace(out.record, vertical_m_s2=share * up if share else None)
            out = replace(out, record=record)
        if (how := given.pop("first", None)) is not None:
            out = replace(out, first=how if isinstance(how, Motion) else Motion.named(**how))
        for key in {"first_pga_g", "pause_s"} & given.keys():
            out = replace(out, **{key: given.pop(key)})
        return out

    @cached_property
    def begun(self) -> "Motion":
        """The motion without what comes before it shakes; whole after a shock, or of floors."""
        whole = self.record is None or self.first is not None
        return self if whole else replace(self, record=begun(self.record))

    def columns(self, case: "Case") -> tuple[np.ndarray, dict[str, np.ndarray]]:
        """Times and accelerations of ground and floors for a factor of one, without a first shock.

        Returns
        -------
        time_s : ndarray, shape (nt,)
        columns : dict of str to ndarray
            See `floor_motions.read`; of a building that yields as `yielding.YieldingFloors`, which
            `floor_motions.scaled` asks for those at a factor.
        """
        if self.floors:
            fit(self, case)
            time_s, columns = self.floors
            return time_s, yielding.of_case(case.sections, time_s, columns, march)
        chain, height_m = case["smdof"], storey_height(case.sections)
        key = json.dumps([chain, height_m, yielding.drives(case.sections)], sort_keys=True)
        if key not in self._kept:
            time_s, columns = floor_columns(self.record, chain)
            self._kept.clear()  # of one building: a sample of thousands has as many
            self._kept[key] = time_s, yielding.of_case(case.sections, time_s, columns, march)
        return self._kept[key]

    def before(self, case, direction):
        """What comes before it: time_s and columns as they shake, and the pause; None: nothing."""
        if self.first is None or self.first_pga_g == 0.0:
            return None
        time_s, columns = self.first.columns(case)
        factor = amplitude(columns["ground"], direction, self.first_pga_g)
        return time_s, floor_motions.scaled(columns, factor), self.pause_s


def _bytes(values):
    return np.ascontiguousarray(values, dtype=float).tobytes()


def _known(changes, name):
    """Changes of a motion, if a variant may hold them all."""
    for key, value in changes.items():
        if key in LEAST:
            good = isinstance(value, Real) and LEAST[key] <= float(value) < math.inf
            wanted = "a number" + " ≥ 0" * (LEAST[key] == 0.0)
        elif key in ("first", "surrogate"):
            good = value is None or isinstance(value, (Motion, Mapping)[key == "surrogate" :])
            wanted = "keywords of Motion.named, as {'name': 'RRS228'}"
        else:
            raise ValueError(f"variant '{name}': unknown change of the motion {key!r}")
        if not good:
            raise ValueError(f"variant '{name}': motion {key} = {value!r}: expected {wanted}")
    return dict(changes)
