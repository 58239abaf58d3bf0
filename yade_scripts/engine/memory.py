"""A ceiling on the memory of a process that makes many runs.

YADE keeps the motions of a finished run (its conversion of lists leaks what they hold; about 50 B
a sample and support, 10 MB a run with five supports and 42,000 samples). Entry points whose
finished runs are in a journal start themselves afresh when that has added up, and go on from there.
"""

import os
import sys

GROWTH_MB = 250.0
_PAGE_MB = os.sysconf("SC_PAGE_SIZE") / 2**20


def resident_mb():
    """Memory of this process [MB]; 0 where /proc does not say."""
    try:
        with open("/proc/self/statm", encoding="utf-8") as handle:
            return int(handle.read().split()[1]) * _PAGE_MB
    except (OSError, ValueError, IndexError):
        return 0.0


class Ceiling:
    """Tells when this process has grown by more than `growth_mb` since its first run."""

    def __init__(self, growth_mb=GROWTH_MB):
        """Set the ceiling; the first call of `reached` sets what growth counts from."""
        self.growth_mb, self.first_mb = growth_mb, None

    def reached(self):
        """Whether it has grown by that much; call once after every run."""
        now = resident_mb()
        if self.first_mb is None:
            self.first_mb = now
        return now - self.first_mb > self.growth_mb


def start_afresh():
    """Replace this process by a new one with the same command line; does not return."""
    sys.stderr.flush()
    os.execv(sys.executable, [sys.executable, *sys.orig_argv[1:]])
