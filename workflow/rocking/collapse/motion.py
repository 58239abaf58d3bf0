"""What shakes a case: a record, or floor motions that were made of one, and a shock before it."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from rocking.records import load, read_record
from rocking.records.floors import floor_columns
from yade_scripts.model import floor_motions, models
from yade_scripts.model.motion import amplitude

TABLE = Path(__file__).resolve().parents[3] / "config" / "records.tsv"
PAUSE_S = 10.0  # between two shocks, beyond the free vibration of the first (smdof.tail_s)


@dataclass(frozen=True)
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
    first : Motion, or None
        A shock before this one, on the same case and in the same direction.
    first_pga_g : float
        Its peak ground acceleration; 0: there is none.
    pause_s : float
        From the end of its motion to the beginning of this one.

    Examples
    --------
    >>> from rocking import Motion
    >>> Motion.named("RRS228").name
    'RRS228'
    """

    record: Any = None
    floors: tuple | None = None
    label: str = ""
    first: "Motion | None" = None
    first_pga_g: float = 0.0
    pause_s: float = PAUSE_S

    @classmethod
    def named(cls, name, table=TABLE, **how):
        """Motion of one row of a records table; `how` as of `rocking.records.load`."""
        return cls(load(name, str(table), **how))

    @classmethod
    def read(cls, path, **how):
        """Motion of an accelerogram's file; `how` as of `rocking.records.read_record`."""
        return cls(read_record(str(path), **how))

    @classmethod
    def read_floors(cls, path, name=""):
        """Floor motions of a file, see `floor_motions.read`."""
        return cls(floors=floor_motions.read(path), label=name)

    @property
    def name(self):
        """Name of the record, or of the floor motions."""
        return self.record.name if self.record is not None else self.label

    def varied(self, variant):
        """Return the motion with a variant's changes.

        Its `motion` may hold: vertical, the share of the vertical motion that counts; surrogate,
        the keywords of `named` whose motion of the same name takes its place; first, a Motion
        before it or the keywords of `named`; first_pga_g; pause_s.

        Raises
        ------
        ValueError
            In one line, for anything else.
        """
        out, given = self, dict(variant.motion)
        if (how := given.pop("surrogate", None)) is not None:
            out = replace(out, record=Motion.named(out.name, **how).record)
        if (share := given.pop("vertical", None)) is not None:
            up = out.record.vertical_m_s2
            record = replace(out.record, vertical_m_s2=share * up if share else None)
            out = replace(out, record=record)
        if (how := given.pop("first", None)) is not None:
            out = replace(out, first=how if isinstance(how, Motion) else Motion.named(**how))
        for key in {"first_pga_g", "pause_s"} & given.keys():
            out = replace(out, **{key: given.pop(key)})
        if given:
            raise ValueError(f"variant '{variant.name}': unknown change of the motion {[*given]}")
        return out

    def columns(self, case):
        """Times and accelerations of ground and floors for a factor of one, without a first shock.

        Returns
        -------
        time_s : ndarray, shape (nt,)
        columns : dict of str to ndarray
            See `floor_motions.read`.
        """
        return self.floors or floor_columns(self.record, case["smdof"])

    def before(self, case, direction):
        """What comes before it: time_s and columns as they shake, and the pause; None: nothing."""
        if self.first is None or self.first_pga_g == 0.0:
            return None
        time_s, columns = self.first.columns(case)
        factor = amplitude(columns["ground"], direction, self.first_pga_g)
        return time_s, models.scaled(columns, factor), self.pause_s
