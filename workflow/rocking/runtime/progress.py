"""How far the incremental dynamic analyses of a study are, and how long they will take.

Snakemake counts jobs, of which one may take an hour. The journals know every finished run; a
thread of the main process reads their lengths now and then and prints one line.
"""

import sys
import threading
import time
from pathlib import Path

INTERVAL_S = 60.0
USUAL_RUNS = 16  # of an adaptive curve, until one has been finished


def count_lines(path):
    """Lines of a file; 0 where it is not there."""
    try:
        with open(path, "rb") as handle:
            return sum(chunk.count(b"\n") for chunk in iter(lambda: handle.read(1 << 16), b""))
    except OSError:
        return 0


def spoken(seconds):
    """Return a duration in the two units that matter."""
    minutes = round(seconds / 60)
    if minutes < 1:
        return "less than a minute"
    if minutes < 120:
        return f"{minutes} min"
    return f"{minutes // 60} h {minutes % 60} min"


class Progress:
    """Progress of the curves of a study.

    Parameters
    ----------
    curves : list of (table, journal, runs)
        Path of the finished table, path of its journal, and the number of runs it takes
        (None where the strategy decides on the way).
    """

    def __init__(self, curves, clock=time.monotonic):
        """Note what there is already: only what this run adds says how fast it is."""
        self.curves, self.clock, self.began = list(curves), clock, clock()
        self.before = {journal: count_lines(journal) for _, journal, _ in self.curves}

    def line(self):
        """Return one line; empty while nothing is known or when nothing is left."""
        added, left, finished, lengths = 0, [], 0, []
        for table, journal, runs in self.curves:
            new = count_lines(journal) - self.before[journal]
            added += new
            if Path(table).exists():
                finished += 1
                lengths.append(count_lines(table) - 1)
            else:
                left.append((runs, new))
        if not left or not added:
            return ""
        usual = round(sum(lengths) / len(lengths)) if lengths else USUAL_RUNS
        runs_left = sum(max((runs or usual) - new, 1) for runs, new in left)
        seconds = (self.clock() - self.began) / added * runs_left
        return (
            f"progress: {finished} of {len(self.curves)} curves, {added} runs since the start, "
            f"about {runs_left} to go, about {spoken(seconds)} left"
        )

    def watch(self, interval_s=INTERVAL_S, stream=None):
        """Print the line now and then from a thread that ends with the process."""

        def loop():
            said = ""
            while True:
                time.sleep(interval_s)
                text = self.line()
                if text and text != said:
                    print(text, file=stream or sys.stderr, flush=True)
                said = text

        threading.Thread(target=loop, name="progress", daemon=True).start()
