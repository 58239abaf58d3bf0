"""Files of recorded motions: from any of a dozen formats to m/s², every refusal with its line.

    from record_files import read_record

    record = read_record("CH1.V2A", component="N12E")  # acceleration_m_s2, dt_s, details

Stands on numpy alone and knows no project. `formats` tells formats apart, a module each; `reader`
picks component, unit and step; `text` and `header` read what files have in common.
"""

from .errors import RecordError
from .formats import FORMATS
from .reader import detect, read_record
from .record import Record

__all__ = ["FORMATS", "Record", "RecordError", "detect", "read_record"]
