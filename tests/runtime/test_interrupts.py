"""No signal that ends a run is lost, and none lets it stand still."""

import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

from rocking.runtime import interrupts

ROOT = Path(__file__).resolve().parents[2]

RUN = """
import signal, threading, time
from types import SimpleNamespace
from rocking.runtime import interrupts
from snakemake.scheduling.job_scheduler import JobScheduler

own = SimpleNamespace(_lock=threading.Lock(), _open_jobs=threading.Semaphore(0), _user_kill=None)
own.exit_gracefully = lambda *_: JobScheduler.exit_gracefully(own)
signal.signal(signal.SIGTERM, own.exit_gracefully)
signal.signal(signal.SIGINT, signal.default_int_handler)
interrupts.heed(own)


class Dropped:
    def __del__(self):
        signal.raise_signal(signal.SIGINT)


def lock_held():
    with own._lock:  # Snakemake's handler would wait for it, here in the thread that holds it
        signal.raise_signal(signal.SIGTERM)
    assert own._open_jobs.acquire(timeout=20.0)
    print(own._user_kill)


def dropped():
    try:
        Dropped()
        for _ in range(2000):  # a signal just before a sleep is seen after it
            time.sleep(0.01)
    except KeyboardInterrupt:
        print("interrupted")


lock_held()
dropped()
"""


def test_signals_at_the_worst_moments():
    """SIGTERM while the scheduler's lock is held; Ctrl-C in a destructor, where Python drops it."""
    done = subprocess.run(
        [sys.executable, "-c", RUN],
        env={**os.environ, "PYTHONPATH": f"{ROOT}:{ROOT / 'workflow'}"},
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.stdout.split() == ["graceful", "interrupted"], done.stderr
    assert "Exception ignored" not in done.stderr
    assert done.stderr.splitlines() == ["SIGTERM: ending"]


def test_an_end_says_for_which_jobs_it_waits():
    def job(rule, **wildcards):
        return SimpleNamespace(rule=SimpleNamespace(name=rule), wildcards_dict=wildcards)

    jobs = [job("ida", run="main", model=f"W{n}") for n in range(6)]
    said = interrupts.waiting(SimpleNamespace(running=jobs))
    assert "(ida main W0, ida main W1, ida main W2, ida main W3 and 2 more)" in said
    assert interrupts.waiting(SimpleNamespace(running=set())) == "SIGTERM: ending"
