"""Baseline treatment and filtering, explicit and recorded in words.

"none" leaves the record as given. Otherwise a mean or a polynomial of time fitted to
the acceleration by least squares is subtracted; corner frequencies add a Butterworth
filter run forwards and backwards (no phase shift; the gain at a corner is 1/2).
"""

from dataclasses import replace

import numpy as np
from record_files.errors import RecordError

from yade_scripts.lists import listed

MAX_DEGREE = 8


def treat(record, method="none", *, order=2, highpass_hz=None, lowpass_hz=None, filter_order=4):
    """Return a record with its baseline treated and the treatment in `baseline`.

    The keywords are the keys of the configuration's section `baseline`.

    Parameters
    ----------
    record : Record
    method : {"none", "mean", "linear", "poly"}
        What is subtracted: nothing, the mean, a straight line, a polynomial.
    order : int
        Degree of the polynomial of "poly".
    highpass_hz, lowpass_hz : float or None
        Corner frequencies; both make a band-pass.
    filter_order : int
        Order of each Butterworth filter in one pass.

    Raises
    ------
    RecordError
        An unknown method or a corner outside 0 … Nyquist.
    """
    where = f"record {record.name}"
    degrees = {"none": None, "mean": 0, "linear": 1, "poly": order}
    if method not in degrees:
        raise RecordError(f"{where}: baseline {method!r}; expected one of {listed(degrees)}")
    a, words, degree = record.acceleration_m_s2, [], degrees[method]
    if degree is not None:
        if not 0 <= degree <= min(MAX_DEGREE, len(a) - 2):
            raise RecordError(f"{where}: polynomial of degree {degree}; expected 0 … {MAX_DEGREE}")
        # Chebyshev polynomials on −1 … 1 keep the fit well conditioned.
        x = np.linspace(-1.0, 1.0, len(a))
        chebyshev = np.polynomial.chebyshev
        a = a - chebyshev.chebval(x, chebyshev.chebfit(x, a, degree))
        words.append("mean removed" if degree == 0 else f"polynomial of degree {degree} removed")
    if not 1 <= filter_order <= 10:
        raise RecordError(f"{where}: filter_order {filter_order}; expected 1 … 10")
    if highpass_hz is not None and lowpass_hz is not None and highpass_hz >= lowpass_hz:
        raise RecordError(
            f"{where}: high-pass {highpass_hz:g} Hz is not below low-pass {lowpass_hz:g} Hz"
        )
    for kind, corner in (("highpass", highpass_hz), ("lowpass", lowpass_hz)):
        if corner is not None:
            a = _filter(where, a, record.dt_s, kind, corner, filter_order)
            words.append(f"Butterworth {kind} {corner:g} Hz, order {filter_order}, both ways")
    return replace(record, acceleration_m_s2=a, baseline="; ".join(words) or "none")


def _filter(where, a, dt_s, kind, corner_hz, order):
    nyquist = 0.5 / dt_s
    if not 0 < corner_hz < nyquist:
        raise RecordError(
            f"{where}: {kind} {corner_hz:g} Hz; expected 0 … {nyquist:g} Hz (Nyquist)"
        )
    from scipy.signal import butter, sosfiltfilt  # slow to load, and most runs need none

    sections = butter(order, corner_hz, kind, fs=1 / dt_s, output="sos")
    # Zero pads of 1.5·order/corner hold the filter's transients (Converse & Brady 1992);
    # they are cut off again, so the record keeps its length.
    pad = min(int(1.5 * order / (corner_hz * dt_s)) + 1, 10 * len(a))
    padded = np.concatenate([np.zeros(pad), a, np.zeros(pad)])
    return sosfiltfilt(sections, padded, padtype=None)[pad:-pad]
