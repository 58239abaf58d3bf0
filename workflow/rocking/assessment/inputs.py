"""What an assessment needs to be told, checked before anything is planned."""

from collections.abc import Mapping

from rocking.assessment.site import SpectrumError, pga_at, read_spectrum
from rocking.records import RecordError
from rocking.risk.hazard import HazardError, read_hazard

STATED = {  # keys that an assessment does not take from the case study
    "facade": ("height_m", "thickness_m", "width_m", "density_kg_m3"),
    "smdof": ("n_dof", "period_s"),
    "assessment": ("confidence_factor",),
}


def check_stated(given):
    """Refuse a façade whose numbers would be the case study's.

    Parameters
    ----------
    given : mapping
        The configuration as the user gave it, to tell what is stated from what is a default.

    Raises
    ------
    ValueError
        In one line that names the key.
    """
    for section, keys in STATED.items():
        part = given.get(section)
        for key in keys:
            if not isinstance(part, Mapping) or key not in part:
                raise ValueError(
                    f"assess: {section}.{key} is not stated; expected it in the façade's file, not "
                    "the case study's default"
                )


def spectrum_file(resolved, find):
    """File of the site's spectrum, checked; None where the hazard curve stands for it.

    Parameters
    ----------
    resolved : dict
        Resolved configuration.
    find : callable
        Returns where a file of the configuration is.

    Raises
    ------
    ValueError
        In one line that names the key.
    """
    if (path := resolved["assessment"]["spectrum"]) is not None:
        path = find(path)
        _checked("assessment.spectrum", read_spectrum, path)
    return path


def hazard_file(resolved, find):
    """File of the site's hazard curve, as `spectrum_file`; None where a spectrum is given alone."""
    path, settings = resolved["risk"]["hazard"], resolved["assessment"]
    if path is not None:
        path, period_s = find(path), resolved["smdof"]["period_s"]
        curve = _checked("risk.hazard", read_hazard, path, period_s, resolved["risk"]["site"])
        if settings["spectrum"] is None:
            _checked("risk.hazard", pga_at, curve, settings["return_period_years"])
    return path


def check_demand(*files):
    """Refuse an assessment that has neither file."""
    if not any(files):
        raise ValueError(
            "assess: no demand; expected assessment.spectrum (columns period_s,sa_g) or "
            "risk.hazard (columns pga_g,annual_rate)"
        )


def _checked(key, read, *arguments):
    try:
        return read(*arguments)
    except (SpectrumError, HazardError, RecordError, ValueError) as error:
        raise ValueError(f"{key}: {error}") from None
