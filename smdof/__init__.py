"""Lumped-mass shear chains, spectra and the weighted mean error: NumPy and SciPy only, no files."""

from .chain import Chain, FloorMotions, floor_motions, shear_chain
from .spectra import PowerSpectrum, ResponseSpectrum, power_spectrum, response_spectrum
from .wme import common_grid, weighted_mean_error

__all__ = [
    "Chain",
    "FloorMotions",
    "PowerSpectrum",
    "ResponseSpectrum",
    "common_grid",
    "floor_motions",
    "power_spectrum",
    "response_spectrum",
    "shear_chain",
    "weighted_mean_error",
]
