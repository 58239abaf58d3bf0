"""The hazard curve that a run states."""

from record_files.errors import RecordError

from studies.shared.hazard import HazardError, read_hazard
from yade_scripts.lists import listed


def stated_hazard(resolved, find):
    """File of the hazard curve that a configuration names, read and found to serve it.

    `find` returns where a file of the configuration is. A HazardError names the key.
    """
    path = resolved["risk"]["hazard"]
    if path is None:
        raise HazardError(
            "config: risk.hazard: null; expected the file of a hazard curve, with the columns"
            " pga_g,annual_rate or as OpenQuake exports it"
        )
    path = find(path)
    try:
        curve = read_hazard(path, resolved["smdof"]["period_s"], resolved["risk"]["site"])
    except (HazardError, RecordError) as error:
        raise HazardError(f"risk.hazard: {error}") from None
    measures = resolved["fragility"]["measures"]
    if curve.measure not in measures:
        raise HazardError(
            f"risk.hazard: {path} is of {curve.measure}; expected one of fragility.measures"
            f" ({listed(measures)})"
        )
    return path
