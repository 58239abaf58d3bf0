"""Interrupt YADE runs at random moments, under load, and see that each ends and none remains.

    .venv/bin/python tests/trials/interruptions/trials.py --count 240 --load 10 --seed 1

A trial of `Ctrl-C` or of an `error` in a runner holds if the run ends within LIMIT_S and a
further run in the same process reaches its end; of `SIGTERM`, and of the workflow's death
(`orphan`), if the process is gone. The last line counts what did not hold.
"""

import argparse
import collections
import json
import os
import random
import selectors
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "workflow"), str(ROOT / "tests" / "cases")]

from yade_process import PYTHON, resolved  # noqa: E402

MODELS = ("W1", "W2c", "W3")
KINDS = ("Ctrl-C", "error", "SIGTERM", "orphan")
LIMIT_S = 60.0  # eleven busy processes a core: everything takes ten times as long
LATEST_S = 0.5  # of a random moment, after the run has been set going
FURTHER_S = 0.02
BUSY = "while True: pass"


class Hang(Exception):
    """What should have happened did not within LIMIT_S."""


class Victim:
    """One process of `victim.py`, in a session of its own."""

    def __init__(self, model, kind, seed, root=ROOT):
        job = {**resolved(), "model": model, "beta_s": 0.00276, "kind": kind, "seed": seed}
        self.workflow = subprocess.Popen(["sleep", "3600"])
        self.said = tempfile.TemporaryFile()  # noqa: SIM115
        self.process = subprocess.Popen(
            [PYTHON, str(HERE / "victim.py"), str(root)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self.said,
            start_new_session=True,
            env={**os.environ, "ROCKING_RUN_PID": str(self.workflow.pid)},
        )
        self.process.stdin.write(json.dumps(job).encode())
        self.process.stdin.close()
        self.seen, self.lines = b"", collections.deque()
        self.ready = selectors.DefaultSelector()
        self.ready.register(self.process.stdout, selectors.EVENT_READ)

    def expect(self, word):
        """Next line of the process, which must begin with `word`."""
        end = time.monotonic() + LIMIT_S
        while not self.lines:
            if not self.ready.select(max(0.0, end - time.monotonic())):
                raise Hang(f"no '{word}'")
            data = os.read(self.process.stdout.fileno(), 4096)
            if not data:
                status = self.process.wait(LIMIT_S)
                self.said.seek(0)
                last = self.said.read().decode().strip().rpartition("\n")[2]
                raise Hang(f"ended with {status} before '{word}': {last}")
            *whole, self.seen = (self.seen + data).split(b"\n")
            self.lines.extend(line.decode() for line in whole)
        line = self.lines.popleft()
        if not line.startswith(word):
            raise Hang(f"'{line}' for '{word}'")
        return line

    def gone(self, status):
        """See that the process ends with `status`."""
        try:
            found = self.process.wait(LIMIT_S)
        except subprocess.TimeoutExpired:
            raise Hang("still there") from None
        if found != status:
            raise Hang(f"status {found} for {status}")

    def close(self):
        """End both processes; tell whether one of the victim's session remained."""
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.process.stdout.close()
        self.said.close()
        self.workflow.kill()
        self.workflow.wait()
        try:
            os.killpg(self.process.pid, 0)
        except ProcessLookupError:
            return False
        return True


def interrupt(victim, kind, moment_s):
    """One trial; raises Hang. A victim of Ctrl-C or of an error can be used again."""
    victim.expect("on")
    if kind == "error":
        victim.expect("ended ValueError")
    else:
        time.sleep(moment_s)
    if kind == "Ctrl-C":
        victim.process.send_signal(signal.SIGINT)
        victim.expect("ended KeyboardInterrupt")
    elif kind == "SIGTERM":
        victim.process.terminate()
        return victim.gone(-signal.SIGTERM)
    elif kind == "orphan":
        victim.workflow.kill()
        return victim.gone(143)
    reached = float(victim.expect("after").split()[1])
    if abs(reached - FURTHER_S) > 0.006:  # a sample
        raise Hang(f"a further run ended at {reached} s")


def trials(count, seed, kinds=KINDS, models=MODELS, root=ROOT, say=lambda line: None):
    """Carry out `count` trials; return what went wrong, one line each.

    Three quarters are interruptions of a run that lives on, ten in a row in one process.
    """
    draw = random.Random(seed)
    wrong, done = [], 0
    again = [kind for kind in kinds if kind in ("Ctrl-C", "error")]
    once = [kind for kind in kinds if kind not in again]
    while done < count:
        model = models[done % len(models)] if count < 10 else draw.choice(models)
        kind = draw.choice(once if once and (not again or draw.random() < 0.75) else again)
        rounds = min(10, count - done) if kind in again else 1
        began, victim = time.monotonic(), Victim(model, kind, draw.random(), root)
        found = []
        try:
            for _ in range(rounds):
                done += 1
                interrupt(victim, kind, draw.uniform(0.0, LATEST_S))
        except Hang as hang:
            found.append(str(hang))
        finally:
            if victim.close():
                found.append("left a process")
        for what in found:
            wrong.append(f"{model} {kind}: {what}")
            say(wrong[-1])
        say(f"{done} of {count}: {model} {kind} × {rounds}, {time.monotonic() - began:.0f} s")
    return wrong


def main():
    """Make the load, carry out the trials, say how they went."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=240)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--load", type=int, default=10, help="busy processes beside")
    parser.add_argument("--root", default=ROOT, help="checkout whose package is tried")
    parser.add_argument("--kinds", default=",".join(KINDS))
    args = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # by way of what ends the others
    load = [subprocess.Popen([sys.executable, "-c", BUSY]) for _ in range(args.load)]
    try:
        wrong = trials(args.count, args.seed, args.kinds.split(","), root=args.root, say=say)
    finally:
        for process in load:
            process.kill()
            process.wait()
    say(f"{args.count} interruptions, {len(wrong)} did not hold")
    return 1 if wrong else 0


def say(line):
    print(line, flush=True)


if __name__ == "__main__":
    sys.exit(main())
