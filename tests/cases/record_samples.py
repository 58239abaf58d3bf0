"""Small synthetic record files, one builder a format, with the motion they hold.

The layouts follow the published format descriptions; every number in them is made up.
"""

from dataclasses import dataclass, field

import numpy as np
import pytest
from rocking.records import Record, RecordError, read_record

DT_S = 0.02


@dataclass
class Sample:
    """A file's name and bytes, what to pass to read_record, and what must come back."""

    name: str
    data: bytes
    acceleration_m_s2: np.ndarray
    tolerance_m_s2: float
    kwargs: dict = field(default_factory=dict)
    counted: bool = True  # the file declares its number of samples


def motion(n=64, seed=3, dt_s=DT_S):
    """Return a zero-mean burst with a peak of about 2 m/s²."""
    t = dt_s * np.arange(n)
    noise = np.random.default_rng(seed).standard_normal(n)
    a = 2.0 * np.exp(-(((t - 0.4 * t[-1]) / (0.2 * t[-1])) ** 2)) * (np.sin(9 * t) + 0.2 * noise)
    return a - a.mean()


def _rows(values, form, per_line):
    cells = [format(value, form) for value in values]
    return ["".join(cells[i : i + per_line]) for i in range(0, len(cells), per_line)]


def _bytes(lines):
    return ("\n".join(lines) + "\n").encode()


def at2(variant=0, a=None):
    a = motion() if a is None else a
    n = len(a)
    first, header = [
        ("PACIFIC ENGINEERING AND ANALYSIS STRONG-MOTION DATA", f"NPTS=  {n}, DT= .02000 SEC"),
        ("PEER NGA STRONG MOTION DATABASE RECORD", f"{n}    0.0200    NPTS, DT"),
        ("PEER NGA STRONG MOTION DATABASE RECORD", f"NPTS=   {n}, DT=   .0200 SEC,   "),
    ][variant]
    lines = [first, "SOMEWHERE, 1/2/99, A STATION, 228", "ACCELERATION TIME SERIES IN UNITS OF G"]
    lines += [header, *_rows(a / 9.80665, ">15.7E", 5)]
    return Sample(f"at2_{variant}.AT2", _bytes(lines), a, 1e-6)


def _geonet_component(label, a, dt_s, corrected):
    a_mm = 1e3 * a
    peak = a_mm[np.argmax(np.abs(a_mm))]
    n = len(a)
    kind = "Corrected" if corrected else "Uncorrected"
    step = (
        f"Instrument corrected data at {dt_s:.3f} sec intervals"
        if corrected
        else f"Raw readings in units of 1.00 mm/s/s  at intervals of {dt_s:.3f} s"
    )
    lines = [
        f"{kind} accelerogram 20990101_000000_ABCD",
        "Site ABCD",
        "A school",
        "Instrument X",
        "Resolution: 18-bit",
        "Accelerogram 20990101_000000_ABCD",
        "10 km from somewhere",
        "2099 January 1  00:00:00 UT",
        "Epicentre unknown",
        f"Number of points  {n}    Duration  {n * dt_s:.2f} s",
        step,
        "Data is unfiltered",
        f"Component {label}",
        f"Acceleration:  Peak {peak:8.1f} mm/s/s at   0.50 s     RMS     10.0 mm/s/s",
        "Velocity record",
        "Displacement record",
    ]
    lines += [format(0, "8d") * 10] * 3
    counts = [n, 0, 0, n, n if corrected else 0, n if corrected else 0, 0, 0, 0, 0]
    lines += ["".join(format(count, "8d") for count in counts)]
    lines += [format(0, "8.2f") * 10] * 6
    lines += _rows(a_mm, ">8.1f", 10)
    if corrected:
        lines += _rows(a_mm / 7, ">8.2f", 10) + _rows(a_mm / 99, ">8.3f", 10)
    return lines


def geonet(corrected=False):
    a = motion()
    lines = []
    for scale, label in ((0.5, "S26W"), (1.0, "S64E"), (-0.3, "Up")):
        lines += _geonet_component(label, scale * a, DT_S, corrected)
    name = "geonet.V2A" if corrected else "geonet.V1A"
    return Sample(name, _bytes(lines), a, 6e-5, {"component": "S64E"})


def esm():
    a = motion()
    peak = a[np.argmax(np.abs(a))] * 100
    lines = [
        "EVENT_NAME: A",
        "STATION_CODE: ABC",
        f"SAMPLING_INTERVAL_S: {DT_S:.6f}",
        f"NDATA: {len(a)}",
        "DURATION_S: 1.0",
        "STREAM: HNE",
        "UNITS: cm/s^2",
        f"PGA_CM/S^2: {peak:.6f}",
        "DATA_TYPE: ACCELERATION",
        "USER5: ",
    ]
    return Sample("esm.ASC", _bytes(lines + [format(v, ".6f") for v in a * 100]), a, 1e-8)


def cosmos():
    a = motion()
    reals = [-999.0] * 100
    reals[33], reals[61] = 0.005, 1e3 * DT_S
    reals[63] = float(100 * a[np.argmax(np.abs(a))])
    lines = ["Corrected acceleration    (Format v01.20 with 13 text lines) Src: nowhere"]
    lines += ["Text"] * 7 + ["Sta Cha:  1: 340 deg (Rcrdr Chan  1) Location: roof"] + ["Text"] * 4
    lines += [" 100 Integer-header values follow on  10 lines, Format= (10I8)"]
    lines += [format(-999, "8d") * 10] * 10
    lines += [" 100 Real-header values follow on  17 lines, Format= (6F13.6)"]
    lines += _rows(reals, ">13.6f", 6)
    lines += ['  1 Comment line(s) follow, each starting with a "|":', "| a comment"]
    lines += [f"   {len(a)}  acceleration pts, approx   1 secs, units=cm/sec2(04),Format=(8F10.5)"]
    lines += [
        *_rows(100 * a, ">10.5f", 8),
        "/&  ----------  End of data for channel  1  ----------",
    ]
    return Sample("cosmos.v2", _bytes(lines), a, 1e-7)


def _csmip_channel(number, label, a):
    cm = 100 * a
    peak = cm[np.argmax(np.abs(cm))]
    lines = [f"CORRECTED ACCELEROGRAM   ABC       CHAN  {number}:  {label}     FROM"]
    lines += [f"CHAN  {number}:  {label}"]
    lines += [f"PEAK ACCELERATION = {peak:10.3f}    CM/SEC/SEC  AT   10.940   SEC."]
    lines += [format(0, "5d") * 16] * 3 + [format(0, "10.3f") * 8] * 3
    for quantity, unit, scale in (
        ("ACCEL", "CM/SEC/SEC", 1),
        ("VELOC", "CM/SEC", 0.1),
        ("DISPL", "CM", 0.01),
    ):
        lines += [
            f" {len(a)} POINTS OF {quantity} DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: {unit})"
        ]
        lines += _rows(scale * cm, ">10.3f", 8)
    return [*lines, f"/&  ----------  END OF DATA FOR CHANNEL  {number}  ----------"]


def csmip():
    a = motion()
    lines = _csmip_channel(1, "90 DEG", a) + _csmip_channel(2, "UP", 0.4 * a)
    return Sample("csmip.V2", _bytes(lines), a, 6e-6, {"component": "90"})


def csmip_raw():
    """Volume 1: a rate in place of a step, values in g."""
    a = motion()
    lines = ["Uncorrected accelerogram data       ABC    Chan  1: 90 Deg", "CHAN  1:  90 DEG"]
    lines += [format(0, "5d") * 16] * 3
    rate = 1.0 / DT_S
    lines += [
        f" {len(a)} Accelerogram points at {rate:6.1f} pts/sec in units of g . Format: (8f9.6)"
    ]
    lines += _rows(a / 9.80665, ">9.6f", 8)
    lines += ["/&  ----------  END OF DATA FOR CHANNEL  1  ----------"]
    return Sample("csmip.V1", _bytes(lines), a, 6e-6)


def smc():
    a = motion()
    cm = 100 * a
    lines = ["2 CORRECTED ACCELEROGRAM", "*", "ABC", "1999 1 1", "Moment Mag="]
    lines += ["station = Somewhere component=    360", "epicentral dist =", "inst type=X", *"***"]
    integers = [-32768] * 48
    integers[15], integers[16] = 2, len(a)
    lines += _rows(integers, ">10d", 8)
    reals = [1.7e38] * 50
    reals[1], reals[29], reals[31] = 1 / DT_S, cm.max(), cm.min()
    lines += _rows(reals, ">15.7E", 5) + ["| a comment", "|"]
    # The exponent has one digit only, so that eight values of ten characters fit a line.
    cells = [f"{v:.4E}".replace("E+0", "E+").replace("E-0", "E-").rjust(10) for v in cm]
    lines += ["".join(cells[i : i + 8]) for i in range(0, len(cells), 8)]
    return Sample("smc.smc", _bytes(lines), a, 2e-4)


def knet():
    a = motion(n=100)
    counts = np.rint(a * 100 / 3920 * 6182761).astype(int) + 4321
    gal = (counts - counts.mean()) * 3920 / 6182761
    lines = ["Origin Time       2099/01/01 00:00:00", "Lat.              35.0"]
    lines += [f"Key {i}" for i in range(8)]
    lines += [
        f"Sampling Freq(Hz) {1 / DT_S:.0f}Hz",
        "Duration Time(s)  2",
        "Dir.              E-W",
        "Scale Factor      3920(gal)/6182761",
        f"Max. Acc. (gal)   {np.abs(gal).max():.3f}",
        "Last Correction   2099/01/01 00:00:00",
        "Memo.             ",
    ]
    lines += [row[1:] + " " for row in _rows(counts, ">9d", 8)]
    return Sample("knet.EW", _bytes(lines), a, 1e-4)


def two_column():
    a = motion()
    lines = [f"{DT_S * i:.6f}\t{value:.8e}" for i, value in enumerate(a)]
    return Sample("two.txt", _bytes(lines), a, 1e-8, {"units": "m/s2"}, counted=False)


def columns():
    a = motion()
    lines = ["#AmplitudeUnit:  gal. DCoffset(corr)", "#Data: F10.3, 3F12.5"]
    lines += [f"{DT_S * i:10.3f}{0:12.5f}{-v:12.5f}{v:12.5f}" for i, v in enumerate(100 * a)]
    return Sample("columns.dat", _bytes(lines), a, 1e-7, {"component": "3"}, counted=False)


def wrapped():
    a = motion()
    lines = ["A station", "The units are (g)", *_rows(a / 9.80665, ">11.7f", 5)]
    return Sample("wrapped.dat", _bytes(lines), a, 1e-6, {"dt_s": DT_S}, counted=False)


def csv():
    a = motion()
    lines = ["# made up", "# Time (s),Acceleration (g's)"]
    lines += [f"{DT_S * i:.3g},{value / 9.80665:.8g}" for i, value in enumerate(a)]
    return Sample("comma.csv", _bytes(lines), a, 1e-6, counted=False)


def single_column():
    a = motion()
    lines = [format(v, ".6f") for v in a]
    kwargs = {"units": "m/s2", "dt_s": DT_S}
    return Sample("single", _bytes(lines), a, 1e-6, kwargs, counted=False)


def packed():
    """Return a file whose damage shows in a check sum, not in the damaged line."""
    from record_files.packed import FIRST, pack

    a, lines = motion(), [FIRST, "source: made up", "licence: none", "motions: 2"]
    for scale, label in ((1, "A NS"), (2, "A UD")):
        about = {"label": label, "station": "A", "event": "B", "time_utc": "2099-01-01 00:00"}
        lines += pack(scale * a, about | {"units": "m/s2", "dt_s": DT_S})
    return Sample("packed.motions", _bytes(lines), a, 3e-4, {"component": "#1"})


def all_samples():
    """Return one sample of every format and variant."""
    return [
        at2(0),
        at2(1),
        at2(2),
        geonet(False),
        geonet(True),
        esm(),
        cosmos(),
        csmip(),
        csmip_raw(),
        smc(),
        knet(),
        two_column(),
        columns(),
        wrapped(),
        csv(),
        single_column(),
    ]


def put(folder, sample, data=None):
    """Write a sample's file, or other bytes under its name; return its path."""
    path = folder / sample.name
    path.write_bytes(sample.data if data is None else data)
    return str(path)


def read(path, sample, **changed):
    """Read a file as the sample is read, but for what is changed."""
    return read_record(path, **(sample.kwargs | changed))


def refusal(path, sample, **changed):
    """Return the one-line refusal of a file, which names it."""
    with pytest.raises(RecordError) as caught:
        read(path, sample, **changed)
    message = str(caught.value)
    assert path in message
    assert "\n" not in message
    return message


def harmonic(amplitude_g=0.3, period_s=1.0, cycles=40, dt_s=0.005):
    """A sine of acceleration from rest: v = (aT/2π)(1 − cos), so PGV = aT/π."""
    t = np.arange(0.0, cycles * period_s + dt_s / 2, dt_s)
    return Record(
        "harmonic", amplitude_g * 9.80665 * np.sin(2 * np.pi * t / period_s), dt_s, "surrogate"
    )
