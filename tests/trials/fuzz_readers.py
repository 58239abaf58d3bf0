"""Fuzz the record readers, the records table and the surrogate parameters.

    python tests/trials/fuzz_readers.py --count 100000 --seed 1

Small synthetic files of every format, and the real ones beside the repository when they
are there, are damaged in many ways and read. Whatever happens must be either

- a RecordError of one line that names the file, or
- a finite, plausible record,

within a bound on time and memory. Where a format declares its number of samples, a file
that lost or doubled lines, or was cut off, must be refused or give the same motion.
"""

import argparse
import collections
import os
import re
import resource
import signal
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "workflow"), str(ROOT / "tests" / "cases")]

import record_samples  # noqa: E402
from record_files.record import MAX_DT_S, MAX_PGA_G, MIN_DT_S, MIN_PGA_G  # noqa: E402
from rocking.records import (  # noqa: E402
    FORMATS,
    RecordError,
    generate,
    read_record,
    read_specs,
    read_table,
)

REAL = ROOT.parent / "shared" / "formats"
SECONDS = 5.0  # of processor time for one input of the usual size
MAX_MEMORY = 2**30
TOKENS = [
    b"nan",
    b"inf",
    b"-inf",
    b"1e999",
    b"-1e-400",
    b"0",
    b"-0",
    b"1",
    b"-1",
    b"999999999",
    b"-",
    b"+",
    b".",
    b"e",
    b"1e",
    b"0x10",
    b"1_000",
    b"1,5",
    b"9" * 400,
    b"\xff",
    b"\x00",
    b"\xc3\xa9",
    "٣".encode(),
    b"NPTS=",
    b"\t",
    b"#",
    b"/&",
    b"'",
    b'"',
    b"%s",
    b"*",
    b"1e308",
    b"4294967296",
    b"units=",
    b"(",
    b")))",
    b"\x1a",
    b"\x0c",
    b"\xe2\x80\xa8",
    b"true",
    b"null",
    b"[",
    b"{a: &x",
]


class Finding(Exception):
    """What should not happen, with the input that shows it."""


def structural(rng, data):
    """Lose, double or cut off lines; the samples that remain are as they were."""
    lines = data.split(b"\n")
    where = int(rng.integers(len(lines)))
    kind = rng.integers(4)
    if kind == 0:
        return data[: int(rng.integers(len(data) + 1))]
    if kind == 1:
        return b"\n".join(lines[:where])
    if kind == 2:
        return b"\n".join(lines[:where] + lines[where + int(rng.integers(1, 4)) :])
    return b"\n".join(lines[: where + 1] + lines[where:])


def arbitrary(rng, data, others):
    """Damage characters, tokens, lines, or join two files."""
    kind = rng.integers(8)
    where = int(rng.integers(len(data) + 1))
    if kind == 0:
        flipped = bytearray(data)
        for _ in range(int(rng.integers(1, 6))):
            flipped[int(rng.integers(len(flipped)))] = int(rng.integers(256))
        return bytes(flipped)
    if kind == 1:
        return data[:where] + data[where + int(rng.integers(1, 20)) :]
    if kind == 2:
        return data[:where] + TOKENS[int(rng.integers(len(TOKENS)))] + data[where:]
    if kind == 3:  # another token for one of the first two hundred, most of them headers
        spans = [m.span() for m in re.finditer(rb"[^\s,;=:]+", data[:4000])][:200]
        start, end = spans[int(rng.integers(len(spans)))] if spans else (0, 0)
        return data[:start] + TOKENS[int(rng.integers(len(TOKENS)))] + data[end:]
    if kind == 4:
        other = others[int(rng.integers(len(others)))]
        return data[:where] + other[int(rng.integers(len(other) + 1)) :]
    if kind == 5:
        lines = data.split(b"\n")
        a, b = rng.integers(len(lines), size=2)
        lines[a], lines[b] = lines[b], lines[a]
        return b"\n".join(lines)
    if kind == 6:
        return data.replace(*[(b"\n", b"\r"), (b"\n", b""), (b" ", b""), (b".", b",")][where % 4])
    return data[:where] + data[where : where + 40] * int(rng.integers(2, 400)) + data[where:]


class Bound:
    """Raise inside the block when it takes more processor time than the bound."""

    def __init__(self, factor=1):
        self.factor = factor

    def __enter__(self):
        signal.setitimer(signal.ITIMER_PROF, self.factor * SECONDS)

    def __exit__(self, *exception):
        signal.setitimer(signal.ITIMER_PROF, 0.0)


def _late(*_):
    raise Finding(f"no answer in {SECONDS:g} s")


def refused(error, path):
    """Check a refusal: one short line that names the file."""
    message = str(error)
    if "\n" in message or len(message) > 1000 or not message.isprintable():
        raise Finding(f"refusal is not one short printable line: {message[:200]!r}")
    if str(path) not in message and "record x" not in message:
        raise Finding(f"refusal does not name the file: {message[:200]!r}")
    return "with line" if re.search(r", line \d+: ", message) else "without line"


def read_one(path, kwargs, reference=None):
    """Read a file; return what happened. `reference` is the motion it must hold if any."""
    try:
        with Bound():
            record = read_record(path, name="x", **kwargs)
    except RecordError as error:
        return "refused " + refused(error, path)
    a = record.acceleration_m_s2
    pga_g = np.max(np.abs(a)) / 9.80665
    if not np.all(np.isfinite(a)) or not MIN_DT_S <= record.dt_s <= MAX_DT_S:
        raise Finding("a record that is not finite, or of impossible step")
    if not MIN_PGA_G <= pga_g <= MAX_PGA_G:
        raise Finding(f"a record of {pga_g:g} g")
    if reference is not None and not np.array_equal(a, reference):
        raise Finding(f"lines are missing or doubled, yet {len(a)} samples were read")
    return "read"


def corpus(real=True):
    """Return [(name, data, kwargs, motion or None)] to start from."""
    found = []
    for sample in [*record_samples.all_samples(), record_samples.packed()]:
        found.append((sample.name, sample.data, sample.kwargs, sample.counted))
    for path in sorted(REAL.iterdir()) if real and REAL.is_dir() else ():
        bare = path.name.startswith(("SINGLE", "TWO"))
        kwargs = {"component": "#1"}
        if bare:
            kwargs = {"units": "g", "dt_s": 0.01 if path.name.startswith("TWO") else 0.005}
        found.append((path.name, path.read_bytes(), kwargs, not bare and ".csv" not in path.name))
    return found


def side_inputs():
    """Return the table and the parameters to start from."""
    head = "record\tfile\tformat\tdt_s\tunits\tcomponent\tpga_g\tpgv_cm_s\tpgd_cm\tduration_s\n"
    table = head + "A\t\t\t\t\t\t0.2\t20\t5\t10\nB-1.x\t\tat2\t0.01\tg\t#1\t1.1\t46\t14\t20\n"
    return table.encode(), (ROOT / "config" / "surrogates.yaml").read_bytes()


def read_side(path, kind):
    """Read a damaged table or parameters file; return what happened."""
    try:
        with Bound():
            if kind == "table":
                rows = read_table(path)
            else:
                rows = read_specs(path)
    except RecordError as error:
        return "refused " + refused(error, path)
    if kind == "table":
        for name in rows:
            if not re.fullmatch(r"[A-Za-z0-9_+][A-Za-z0-9._+-]{0,63}", name):
                raise Finding(f"the name {name!r} was taken")
        return "read"
    try:  # parameters that were taken must give a record or a refusal
        with Bound(10):  # a search, the slowest when there is nothing to find
            generate("x", 0.21, 73.6, 24.4, 16.2, spec=next(iter(rows.values()), None))
    except RecordError as error:
        return "refused " + refused(error, path)
    return "read"


def run(count, seed, real=True, progress=False):
    """Read `count` damaged inputs; return the tally. Raises Finding."""
    signal.signal(signal.SIGPROF, _late)
    rng = np.random.default_rng(seed)
    starts = corpus(real)
    small = [i for i, start in enumerate(starts) if len(start[1]) < 20_000]
    large = [i for i in range(len(starts)) if i not in small]
    others = [start[1] for start in starts]
    table, parameters = side_inputs()
    tally, slowest = collections.Counter(), 0.0
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "input")
        references = []
        for _, data, kwargs, counted in starts:
            Path(path).write_bytes(data)
            a = read_record(path, name="x", **kwargs).acceleration_m_s2
            references.append(a if counted else None)
        for number in range(count):
            dice = rng.random()
            reference, kwargs, kind = None, {}, "record"
            if dice < 0.05:
                kind = "table" if dice < 0.045 else "parameters"
                data = arbitrary(rng, table if kind == "table" else parameters, others)
            else:
                pool = large if large and dice > 0.95 else small
                index = pool[int(rng.integers(len(pool)))]
                name, data, kwargs, _ = starts[index]
                if rng.random() < 0.3:
                    data, reference = structural(rng, data), references[index]
                else:
                    data = arbitrary(rng, data, others)
                    if rng.random() < 0.3:
                        data = arbitrary(rng, data or b"0", others)
                if rng.random() < 0.1:
                    kwargs = kwargs | {"format": list(FORMATS)[int(rng.integers(len(FORMATS)))]}
            Path(path).write_bytes(data)
            started = time.process_time()
            try:
                if kind == "record":
                    outcome = read_one(path, kwargs, reference)
                else:
                    outcome = read_side(path, kind)
            except Exception as problem:
                kept = Path(tempfile.gettempdir()) / f"fuzz_readers_{seed}_{number}"
                kept.write_bytes(data)
                what = f"{type(problem).__name__}: {problem}"
                raise Finding(f"input {number}, kept in {kept} ({kwargs}): {what}") from problem
            slowest = max(slowest, time.process_time() - started)
            tally[f"{kind} {outcome}"] += 1
            if progress and (number + 1) % 5000 == 0:
                print(f"{number + 1} inputs, slowest {slowest:.2f} s", flush=True)
    return tally, slowest


def giants(folder):
    """Yield (name, file) of inputs near the size limits that could cost memory or time.

    Made one at a time, so that the memory measured is the reader's.
    """
    megabyte = 2**20
    at2 = b"PEER\nA, B, 1\nACCELERATION IN UNITS OF G\nNPTS= 2000000, DT= .01 SEC\n"
    header = record_samples.csmip().data.split(b" 64 POINTS")[0]
    makers = {
        "over the size limit": lambda: b"1 2\n" * (17 * megabyte),
        "short lines": lambda: b"1\n" * 1_999_999,
        "too many lines": lambda: b"1\n" * (8 * megabyte),
        "returns only": lambda: b"1\r" * (16 * megabyte),
        "two million samples": lambda: (
            at2 + b"1.0E-01 2.0E-01 -1.0E-01 3.0E-01 0.0E+00\n" * 400_000
        ),
        "many on a line": lambda: at2 + (b"1 " * 4_900 + b"\n") * 6_000,
        "commas": lambda: b"0,1,2\n" + b"," * 9_999 + (b"\n" + b"1," * 4_000) * 8_000,
        "time and sample": lambda: b"".join(b"%.2f 0.1\n" % (0.01 * i) for i in range(1_900_000)),
        "headers only": lambda: header * (60 * megabyte // len(header)),
        "spaces": lambda: (b"Sta Cha: 1: " + b" " * 9_900 + b"\n") * 6_000,
        "one line": lambda: b"1" * (60 * megabyte),
        "blank": lambda: b"\n" * 1_999_999 + b"x",
    }
    for name, make in makers.items():
        path = os.path.join(folder, "giant")
        Path(path).write_bytes(make())
        yield name, path


def run_giants(seconds=60.0):
    """Read the giants; return (largest resident memory in bytes, slowest in s). Raises Finding."""
    global SECONDS
    usual, SECONDS, slowest = SECONDS, seconds, 0.0
    signal.signal(signal.SIGPROF, _late)
    with tempfile.TemporaryDirectory() as folder:
        for name, path in giants(folder):
            started = time.process_time()
            try:
                outcome = read_one(path, {"units": "g", "dt_s": 0.01})
            except Exception as problem:
                raise Finding(f"{name}: {type(problem).__name__}: {problem}") from problem
            took = time.process_time() - started
            slowest = max(slowest, took)
            print(f"{name}: {outcome}, {took:.1f} s")
    SECONDS = usual
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024, slowest


def main():
    """Run from the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--no-giants", action="store_true", help="leave out the files near 64 MB")
    options = parser.parse_args()
    tally, slowest = run(options.count, options.seed, progress=True)
    for outcome, number in sorted(tally.items()):
        print(f"{number:8d} {outcome}")
    print(f"{options.count} inputs, none wrong; slowest {slowest:.2f} s")
    if not options.no_giants:
        run_giants()
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    print(f"largest resident memory {memory / 2**20:.0f} MB")
    if memory > MAX_MEMORY:
        sys.exit(f"more than {MAX_MEMORY // 2**20} MB")


if __name__ == "__main__":
    main()
