"""Known motions in layouts and headings that are drawn: none may be read as another motion.

    python tests/trials/layouts.py --count 3000 --seed 2

A case is the motion of one to four channels, of known samples and step, written as people write
them: columns with and without a time, several numbers a line, pairs, running numbers, blocks one
after another, a first line of count and step; titles, captions, counts, steps and units in some
languages, or none; separators, decimal marks, line ends and encodings. What the file does not
state is stated beside it, as a user must. The answer is the motion, a question where the file has
several channels and none is named, or a refusal. Two are counted: a motion that is read wrong, and
a refusal of a file from which one motion follows.
"""

import argparse
import collections
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "workflow")]

from record_files.units import UNITS_M_S2  # noqa: E402
from rocking.records import RecordError, read_record  # noqa: E402

OTHERS = {  # units of what is no acceleration
    **{"m/s": 0.05, "cm/s": 5.0, "cm": 2.0, "counts": 3000.0, "mV": 40.0},
}
SPELT = {
    "g": ("g", "G", "g's"),
    "cm/s2": ("gal", "cm/s2", "cm/s/s", "cm/sec^2", "cm/s²", "Gal", "CM/SEC/SEC"),
    "m/s2": ("m/s2", "m/s^2", "m/s²", "m/s/s", "M/S**2", "m s-2"),
    "mm/s2": ("mm/s2", "mm/s^2", "mm/s/s"),
    "%g": ("%g", "percent of g", "% g"),
    "mg": ("mg", "milli-g"),
}
COUNTS = (
    *("NPTS= {n}", "Number of points: {n}", "No. of points = {n}", "{n} samples", "N = {n}"),
    *("Anzahl Werte: {n}", "numero di campioni: {n}", "NUM. TOTAL DE MUESTRAS : {n}"),
    *("nombre de points : {n}", "Number of data: {n}", "{n} data points", "Numero de datos = {n}"),
)
STEPS = (
    *("DT= {dt} SEC", "dt = {dt} s", "time step: {dt} s", "Sampling interval (s): {dt}"),
    *(
        "Sampling rate: {hz} Hz",
        "{hz} sps",
        "{hz} samples/sec",
        "Frequenza di campionamento: {hz} Hz",
    ),
    *("INTERVALO DE MUESTREO (s) : {dt}", "Zeitschritt {dt} s", "pas de temps = {dt} s", "{hz} Hz"),
    *(
        "Passo di campionamento: {dt} s",
        "Abtastrate {hz} Hz",
        "dt={ms} ms",
        "at {dt} sec intervals",
    ),
)
UNITS = (
    *("units: {u}", "Units = {u}", "Acceleration in {u}", "Accelerations ({u})", "UNITS OF {u}"),
    *(
        "UNIDADES DE LOS DATOS : {u}",
        "Einheit: {u}",
        "Unita: {u}",
        "acc [{u}]",
        "Acceleration, {u}",
    ),
)
TITLES = (
    *("Town hall, ground floor", "A record of 2016", "Event 2009-04-06 01:32:40", "# made by hand"),
    *("Station 4 of the array", "Lat 42.35 Lon 13.40", "M 6.1, 12 km", "garden wall shake"),
    *("Filtered 0.1 - 25 Hz, order 4", "PGA 0.25 g", "Vs30 = 360 m/s", "Acceleration time history"),
    *("Güímar, 28° N", "Instrument period 0.04 s, damping 0.6", "azimuth 240", "3 of 12"),
)
NAMES = (
    *(("N-S", "E-W", "U-D", "X"), ("North", "East", "Up", "T"), ("ax", "ay", "az", "a4")),
    *(("CH1", "CH2", "CH3", "CH4"), ("L", "T", "V", "R"), ("HNE", "HNN", "HNZ", "HN1")),
    *(("Norte", "Este", "Vertical", "Radial"), ("roof", "second", "first", "ground")),
    *(("CANAL-1", "CANAL-2", "CANAL-3", "CANAL-4"), ("V", "N00E", "N90E", "S")),
)


@dataclass
class Case:
    """A file, what is stated beside it, and what is right."""

    data: bytes
    stated: dict
    right: np.ndarray  # m/s²
    dt_s: float
    tolerance: float
    must_refuse: bool = False
    open: bool = False  # a refusal is as right as the motion
    words: list = field(default_factory=list)


def motion(rng, n, dt_s, kind):
    """A burst: smooth, rough or quiet at its ends; peak one."""
    t = np.arange(n) * dt_s
    if kind == "sine":  # of a period that lines may have
        return np.sin(2 * np.pi * t / (dt_s * rng.choice([4, 5, 6, 8, 10, 20, 50])) + 0.3)
    frequencies = {"smooth": (0.5, 4.0), "rough": (2.0, 0.2 / dt_s), "usual": (0.5, 12.0)}[kind]
    parts = rng.uniform(*frequencies, 12)
    a = sum(
        rng.standard_normal() / (1 + f / 6) * np.sin(2 * np.pi * f * t + rng.uniform(0, 6.3))
        for f in parts
    )
    a *= np.exp(-(((t - rng.uniform(0.3, 0.6) * t[-1]) / (0.22 * t[-1])) ** 2))
    a += 2e-3 * rng.standard_normal(n) * np.max(np.abs(a)) * (kind == "rough")
    return a / np.max(np.abs(a))


def draw(rng):
    """Draw a `Case`."""
    pick = lambda options: options[rng.integers(len(options))]  # noqa: E731
    n = int(pick((240, 256, 400, 720, 1000, 1501)))
    dt_s = float(pick((0.005, 0.01, 0.02)))
    unit = pick(("g", "g", "cm/s2", "cm/s2", "m/s2", "mm/s2", "%g", "mg"))
    layout = pick(
        ("one", "wrapped", "wrapped", "channels", "channels", "timed", "timed", "numbered")
        + ("pairs", "blocks", "counted", "counted", "beside", "alike", "times", "foreign")
    )
    kind = pick(("smooth", "usual", "usual", "rough", "sine"))
    many = (
        1
        if layout in ("one", "wrapped", "pairs", "counted", "foreign")
        else int(pick((2, 3, 3, 4)))
    )
    peak_g = rng.uniform(0.05, 0.6)
    base = motion(rng, n, dt_s, kind)
    channels = [peak_g * base]
    for _ in range(many - 1):
        other = motion(rng, n, dt_s, kind)
        if layout == "alike":
            other = base + 0.02 * other
        channels.append(peak_g * rng.uniform(0.3, 1.0) * other)
    digits = int(pick((5, 6, 7)))
    scale = UNITS_M_S2["g"] / UNITS_M_S2[unit]
    values = [scale * c for c in channels]
    if layout == "foreign":
        unit = pick(tuple(OTHERS))
        values = [OTHERS[unit] * c / peak_g for c in channels]
    return _write(rng, pick, layout, values, unit, dt_s, digits)


def _write(rng, pick, layout, values, unit, dt_s, digits):
    n, many = len(values[0]), len(values)
    form = pick(("fixed", "fixed", "exponent", "plus"))
    text = {
        "fixed": lambda v: f"{v:.{digits}f}",
        "exponent": lambda v: f"{v:.{digits}E}",
        "plus": lambda v: f"{v:+.{digits}f}",
    }[form]
    cells = [[text(v) for v in c] for c in values]
    right = [np.array([float(w) for w in c]) for c in cells]
    times = [f"{i * dt_s:.4f}" for i in range(n)]
    separator = pick(("  ", "  ", "\t", ",", ";", " ; ", ", "))
    head, stated, flags = [], {}, {}
    title = [pick(TITLES) for _ in range(int(pick((0, 1, 1, 2))))]
    says = {what: rng.random() < 0.5 for what in ("count", "step", "unit", "names")}
    spelt = pick(SPELT.get(unit, (unit,)))
    names = pick(NAMES)[:many]
    which = int(rng.integers(many))
    facts = {"dt": f"{dt_s:g}", "hz": f"{1 / dt_s:g}", "ms": f"{1e3 * dt_s:g}", "n": n, "u": spelt}
    caption = None
    rows, timed = [], False
    if layout in ("one", "counted", "foreign"):
        rows = [[c] for c in cells[0]]
        if pick((0, 1)) and layout != "foreign":
            k = int(pick((2, 5, 6, 8, 10))) if layout == "counted" else 1
            rows = _lines(cells[0], k)
    elif layout == "wrapped":
        k = int(pick((2, 3, 4, 5, 6, 8, 8, 10)))
        rows = _lines(cells[0], k)
        flags["open"] = (k < 4 or len(rows[-1]) == k) and not says["count"]
    elif layout in ("channels", "alike"):
        rows = [list(row) for row in zip(*cells, strict=True)]
        caption = names if says["names"] else None
        flags["open"] = layout == "alike" and not (says["count"] or caption)
    elif layout in ("timed", "numbered", "beside", "times"):
        timed = layout != "numbered" or pick((0, 1))
        columns = [[str(i + 1) for i in range(n)]] if layout == "numbered" else []
        caption = ["no"] if columns else []
        if timed:
            columns.append(times)
            caption.append(pick(("time", "Time (s)", "t [s]", "Zeit [s]", "tempo")))
        for name, c in zip(names, cells, strict=True):
            if layout == "times" and c is not cells[0]:
                columns.append(times)
                caption.append("time")
            columns.append(c)
            caption.append(name)
        rows = [list(row) for row in zip(*columns, strict=True)]
        if layout == "beside":  # the last channel is a velocity
            caption[-1] = pick(("Velocity [m/s]", "vel_cm_s", "v (cm/s)", "velocity", "Disp (cm)"))
            says["names"] = True
        caption = caption if says["names"] else None
    elif layout == "pairs":
        timed = True
        flat = [w for pair in zip(times, cells[0], strict=True) for w in pair]
        rows = _lines(flat, 2 * int(pick((2, 3, 4, 5))))
    elif layout == "blocks":
        k = int(pick((1, 1, 5, 8)))
        part = pick(("words", "words", "blank", "nothing"))
        flags["open"] = True
        if part == "nothing":
            says["count"] = True
        for name, c in zip(names, cells, strict=True):
            if rows:
                rows += {"words": [[f"Component {name}"]], "blank": [[]], "nothing": []}[part]
            rows += _lines(c, k)
        if part == "words":
            title.append(f"Component {names[0]}")
    if layout == "counted":
        first = pick(
            (f"{n} {dt_s:g}", f"{n}  {dt_s:.4f}", f"{dt_s:g} {n}", f"{n}\n{dt_s:g}", f"{n}")
        )
        rows = [[line] for line in first.split("\n")] + rows
        says["count"], says["step"] = False, says["step"] and " " not in first
        if first != f"{n}":
            says["step"] = None
    return _finish(
        rng, pick, layout, title, says, facts, caption, rows, separator,
        dict(right=right[which], which=which, unit=unit, dt_s=dt_s, timed=timed, names=names,
             many=many, digits=digits, **flags), head, stated,
    )  # fmt: skip


def _lines(cells, k):
    return [cells[i : i + k] for i in range(0, len(cells), k)]


def _finish(rng, pick, layout, title, says, facts, caption, rows, separator, about, head, stated):
    head = list(title)
    parts = []
    if says["count"]:
        parts.append(pick(COUNTS).format(**facts))
    if says["step"] and not about["timed"]:
        parts.append(pick(STEPS).format(**facts))
    if says["unit"]:
        parts.append(pick(UNITS).format(**facts))
    order = rng.permutation(len(parts))
    parts = [parts[i] for i in order]
    head += [", ".join(parts)] if parts and pick((0, 1)) else parts
    plain = layout in ("one", "wrapped", "counted", "foreign", "pairs")
    if separator.strip() == "," and plain and rng.random() < 0.7:
        separator = "  "
    comma = separator.strip() != "," and rng.random() < 0.2
    quoted = separator.strip() and rng.random() < 0.1
    join = separator.join
    if caption:
        head.append(join([f'"{c}"' if quoted else c for c in caption]))
    body = []
    for row in rows:
        words = [w.replace(".", ",") if comma and len(row) and _number(w) else w for w in row]
        words = [f'"{w}"' if quoted and _number(w) else w for w in words]
        body.append(join(words))
    lines = [*head, *body]
    end = pick(("\n", "\n", "\r\n", "\r"))
    data = (
        end.join(lines) + (end if rng.random() < 0.8 else "") + (end if rng.random() < 0.2 else "")
    )
    encoding = pick(("utf-8", "utf-8", "utf-8-sig", "cp1252", "utf-16"))
    many, unit = about["many"], about["unit"]
    if many > 1 and rng.random() < 0.8:
        named = caption and rng.random() < 0.5
        stated["component"] = about["names"][about["which"]] if named else f"#{about['which'] + 1}"
    if many == 1 and rng.random() < 0.2:
        stated["component"] = "1"
    if not says["unit"]:
        stated["units"] = unit if unit in UNITS_M_S2 else "m/s2"
    states_step = about["timed"] or says["step"] or says["step"] is None
    if not states_step:
        stated["dt_s"] = about["dt_s"]
    refuse = layout == "foreign" and says["unit"]
    refuse |= layout == "beside" and about["which"] == many - 1 and "component" in stated
    if states_step and rng.random() < 0.1:
        stated["dt_s"] = 2 * about["dt_s"]
        refuse = True
    if layout == "foreign" and not says["unit"]:
        stated["units"] = "m/s2"
    right = about["right"] * UNITS_M_S2.get(unit, 1.0)
    if layout == "beside" and about["which"] == many - 1 and "component" in stated:
        stated["component"] = f"#{many}"
    return Case(
        data.encode(encoding, "replace"), stated, right, about["dt_s"],
        tolerance=1e-9 + 1e-6 * float(np.max(np.abs(right))), must_refuse=bool(refuse),
        open=bool(about.get("open")) or (many > 1 and "component" not in stated)
        or (layout == "foreign" and not says["unit"]),
        words=[layout, *head[:6], "| " + " / ".join(body[:3])[:160]],
    )  # fmt: skip


def _number(word):
    try:
        float(word)
    except ValueError:
        return False
    return True


def judge(case, path):
    """Outcome ("right", "question", "refused", "wrong") and the line that was said."""
    Path(path).write_bytes(case.data)
    try:
        record = read_record(path, **case.stated)
    except RecordError as error:
        said = str(error)
        if "\n" in said:
            return "wrong", said
        return ("question" if case.open or case.must_refuse else "refused"), said
    same = len(record) == len(case.right) and abs(record.dt_s - case.dt_s) < 1e-4 * case.dt_s
    same = same and np.allclose(record.acceleration_m_s2, case.right, rtol=0, atol=case.tolerance)
    if same and not case.must_refuse:
        return "right", ""
    return "wrong", f"{len(record)} samples of {record.dt_s:g} s in {record.units_read}"


def run(count, seed, show=()):
    """Tally of the outcomes of drawn cases; those to show are printed."""
    tally: collections.Counter = collections.Counter()
    rng = np.random.default_rng(seed)
    with tempfile.TemporaryDirectory() as folder:
        for number in range(count):
            case = draw(rng)
            outcome, said = judge(case, Path(folder) / f"case{number % 4}.txt")
            tally[outcome] += 1
            if outcome in show:
                print(f"{number} {outcome}: {case.stated} {case.words}\n    {said}")
    return tally


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--show", nargs="*", default=["wrong", "refused"])
    given = parser.parse_args()
    print(dict(run(given.count, given.seed, given.show)))
