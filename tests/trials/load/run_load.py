"""A large study, stopped half way and resumed, with its memory and progress over time.

    .venv/bin/python tests/trials/load/run_load.py --records 44 --intensities 15 --output load.csv

The whole study is 44 records × 2 directions × W1, W2 × 15 intensities = 2640 runs; the defaults
are a reduced form of it. Checks that it completes, that what was finished when it was stopped is
kept, that memory does not grow from job to job, and that the time left was announced. The table
has a row a second or more: time_s, runs, curves, processes, largest_mb (of a YADE process) and
total_mb (of all processes of the run).
"""

import argparse
import os
import signal
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import yaml

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT))

from tests.trials.faults.trials import write_atomic_csv  # noqa: E402
from tests.trials.faults.workspace import RESULTS, Workspace  # noqa: E402

COLUMNS = ("time_s", "runs", "curves", "processes", "largest_mb", "total_mb")
G = 9.81


def make_records(folder, count, seed=7):
    """Write `count` accelerograms (enveloped noise and a pulse) and their table."""
    rng = np.random.default_rng(seed)
    time_s = np.arange(0.0, 15.0, 0.01)
    lines = ["record\tfile"]
    for number in range(1, count + 1):
        envelope = np.exp(-(((time_s - 5.0) / 2.5) ** 2))
        noise = np.convolve(rng.standard_normal(len(time_s)), np.hanning(12), "same")
        pulse = np.sin(2 * np.pi * time_s / rng.uniform(0.4, 1.6))
        acceleration = envelope * (noise / np.abs(noise).max() + 0.7 * pulse)
        acceleration *= 0.4 * G / np.abs(acceleration).max()
        name = f"L{number:02d}"
        rows = "".join(f"{t:.2f},{a:.6g}\n" for t, a in zip(time_s, acceleration, strict=True))
        (folder / f"{name}.csv").write_text("time_s,acceleration_m_s2\n" + rows)
        lines.append(f"{name}\t{name}.csv")
    (folder / "load.tsv").write_text("\n".join(lines) + "\n")


def memory_mb(pid):
    try:
        return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * 4096 / 2**20
    except (OSError, ValueError, IndexError):
        return 0.0


def observe(space, process, began, rows, peaks, until=None):
    """Sample a run until it ends or `until(runs)` holds."""
    while process.poll() is None:
        found, yade = space.processes(), space.jobs()
        for pid in yade:
            peaks[pid] = max(peaks.get(pid, 0.0), memory_mb(pid))
        runs = len(space.journal())
        rows.append(
            {
                "time_s": f"{time.monotonic() - began:.0f}",
                "runs": runs,
                "curves": len(list((space.folder / RESULTS / "ida").rglob("*.csv"))),
                "processes": len(found),
                "largest_mb": f"{max(map(memory_mb, yade), default=0):.0f}",
                "total_mb": f"{sum(map(memory_mb, found)):.0f}",
            }
        )
        if until and until(runs):
            return
        time.sleep(1.0)


def main():
    """Run the study; return 0 if everything held."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--records", type=int, default=6)
    parser.add_argument("--intensities", type=int, default=5)
    parser.add_argument("--step-fraction", type=float, default=0.4)
    parser.add_argument("--cores", type=int, default=2)
    parser.add_argument("--output", help="table to write (CSV)")
    args = parser.parse_args()
    top = Path(tempfile.mkdtemp(prefix="rocking-load-"))
    space = Workspace(top / "work").fill()
    make_records(space.folder, args.records)
    grid = [round(float(g), 4) for g in np.linspace(0.05, 0.75, args.intensities)]
    (space.folder / "study.yaml").write_text(
        yaml.safe_dump(
            {
                "run": "trial",
                "records_table": "load.tsv",
                "ida": {"mode": "grid", "grid_g": grid},
                "numerics": {"step_fraction": args.step_fraction},
                "ensemble": {"enabled": "off"},
            }
        )
    )
    whole = args.records * 2 * 2 * args.intensities
    began, rows, peaks = time.monotonic(), [], {}
    cores = ("--cores", str(args.cores))
    process = space.start(*cores)
    observe(space, process, began, rows, peaks, until=lambda runs: runs >= 0.4 * whole)
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGTERM)
    process.wait()
    time.sleep(2.0)
    kept, stopped = space.journal(), time.monotonic()
    process = space.start(*cores, log="resumed.log")
    observe(space, process, began, rows, peaks)
    said = [
        line
        for line in (space.output() + space.output("resumed.log")).splitlines()
        if line.startswith("progress:")
    ]
    finished = space.journal()
    order = [peaks[pid] for pid in peaks]  # in the order of the jobs
    half = len(order) // 2
    early, late = np.median(order[:half]), np.median(order[half:])
    long_enough = stopped - began > 90.0
    checks = {
        f"{whole} runs completed": process.returncode == 0 and len(finished) == whole,
        f"{len(kept)} runs finished before the stop were kept": bool(kept)
        and all(finished.get(key) == row for key, row in kept.items()),
        f"memory a job does not grow ({early:.0f}, then {late:.0f} MB)": late < 1.1 * early,
        f"time left announced ({len(said)} times)": bool(said) or not long_enough,
    }
    if args.output:
        write_atomic_csv(rows, COLUMNS, args.output)
    for name, held in checks.items():
        print("ok  " if held else "FAIL", name)
    print(
        f"{time.monotonic() - began:.0f} s, largest job {max(order):.0f} MB, all processes "
        f"{max(float(r['total_mb']) for r in rows):.0f} MB at most"
    )
    print(*said[-2:], sep="\n")
    if not all(checks.values()):
        print(space.output("resumed.log")[-2000:])
    return int(not all(checks.values()))


if __name__ == "__main__":
    sys.exit(main())
