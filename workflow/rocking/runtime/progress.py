"""How far a study is and how long it will take, by the work that remains.

Snakemake counts jobs, of which one takes a second and another an hour. Here every job of the DAG
weighs what jobs of its kind (rule and model) took in this run. Of a kind of which none has ended
nothing is promised. A thread of the main process looks every few seconds and prints a line a
minute.
"""

import sys
import threading
import time
from collections import Counter, defaultdict
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from statistics import fmean

from yade_scripts.lists import listed
from yade_scripts.model import registry

INTERVAL_S = 60.0
LOOK_S = 2.0
SHORT_S = 2.0  # a table or a figure, until one has ended
FAR, LONG_S = 3.0, 60.0  # a job beyond so many times its kind, and beyond so long, is one apart
RUNS = 20  # of a job whose journal says how many were kept, and nobody how many it takes


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
        return f"about {minutes} min"
    return f"about {minutes // 60} h {minutes % 60} min"


CURVE_S, CURVE_KB = 0.009, 80  # of a curve's three jobs in Snakemake's plan, on one core
MANY = 2000  # curves: half a minute


def planning(curves):
    """Line about the plan of so many curves, which is silent; empty where it takes seconds."""
    if curves < MANY:
        return ""
    memory_gb = curves * CURVE_KB / 1e6
    return (
        f"planning: {curves:,} curves; to plan them all takes {spoken(curves * CURVE_S)}"
        f" and {memory_gb:.1g} GB of memory"
    )


@dataclass
class Task:
    """One job: its kind, how to ask for its state, and its journal of finished runs if it has one.

    `state` returns "waiting", "running" or "done"; `runs` is the number of runs the job takes,
    None where its strategy decides on the way. `costly` are those whose rule has a benchmark.
    """

    rule: str
    state: Callable[[], str]
    model: str = ""
    journal: str | Path | None = None
    runs: int | None = None
    costly: bool = False
    kept: int = 0
    began_s: float | None = None
    took_s: float | None = None

    @property
    def kind(self):
        """Rule and model."""
        return self.rule, self.model

    @property
    def added(self):
        """Finished runs that its journal has beyond those kept before."""
        return count_lines(self.journal) - self.kept if self.journal else 0

    @property
    def share(self):
        """Part of the job that earlier runs left to do."""
        return max(1.0 - self.kept / (self.runs or RUNS), 0.1)


class Progress:
    """Progress of the jobs of a DAG, each a `Task`; `clock` returns seconds."""

    def __init__(self, tasks, clock=time.monotonic):
        """Note what there is already: only what this run adds says how fast it is."""
        self.tasks, self.clock, self.began = list(tasks), clock, clock()
        self.busy_s, self.seen, self.overdue = 0.0, self.began, False
        for task in self.tasks:
            task.kept = count_lines(task.journal) if task.journal else 0

    def look(self):
        """Note which jobs began and ended since the last look."""
        now, running = self.clock(), 0
        for task in self.tasks:
            if task.took_s is not None:
                continue
            state = task.state()
            if state == "running":
                task.began_s = now if task.began_s is None else task.began_s
                running += 1
            elif state == "done":
                # one that came and went between two looks was a short one
                task.took_s = now - (task.began_s or max(self.seen, now - SHORT_S))
        self.busy_s += running * (now - self.seen)
        self.seen = now

    def expected_s(self):
        """Seconds of a whole job of every kind, as measured.

        Of a kind of which none has ended, what other models of its rule took says how long.
        """
        measured, others = defaultdict(list), defaultdict(list)
        for task in self.tasks:
            if task.took_s is not None:
                whole = task.took_s / task.share
                measured[task.kind].append(whole)
                others[task.rule].append(whole / registry.cost(task.model))

        def mean(task):
            if same_kind := measured[task.kind]:
                return fmean(same_kind)
            known = others.get(task.rule)
            return fmean(known) * registry.cost(task.model) if known else SHORT_S

        return {task.kind: mean(task) for task in self.tasks}

    def left_s(self, kinds=None):
        """Seconds until all is done: work that remains over jobs at a time, or the longest job.

        With `kinds`, pairs of rule and model, of these alone. A job far beyond its kind goes on
        for as long again: of a duration that nothing is known about, what has passed is as likely
        its first half as its second.
        """
        expected, now, left = self.expected_s(), self.clock(), []
        self.overdue = False
        for task in self.tasks:
            if task.took_s is not None or not (kinds is None or task.kind in kinds):
                continue
            whole = expected[task.kind] * task.share
            if task.began_s is None:
                left.append(whole)
                continue
            elapsed = now - task.began_s
            if task.runs and (new := task.added) > 0:
                left.append(elapsed / new * max(task.runs - task.kept - new, 0))
            elif elapsed > max(FAR * whole, LONG_S):
                left.append(elapsed)
                self.overdue = True
            else:  # who has taken long already goes on for a while
                left.append(max(whole - elapsed, 0.25 * max(whole, elapsed)))
        at_a_time = max(self.busy_s / max(now - self.began, 1e-9), 1.0)
        return max(sum(left) / at_a_time, max(left, default=0.0))

    def unknown(self):
        """Kinds of jobs left that may take long and have no forecast, sorted.

        A kind has a forecast once one of its jobs has ended, or once runs of a job whose number of
        runs is known have ended. The time of another model forecasts nothing: it is wrong by
        factors of three to six.
        """
        known = {t.kind for t in self.tasks if t.took_s is not None}
        known |= {t.kind for t in self.tasks if t.runs and t.added > 0}
        return sorted({t.kind for t in self.tasks if t.took_s is None and t.costly} - known)

    def line(self):
        """Return one line; empty before the first job and after the last.

        Where some of the jobs left have no forecast, the line says "at least". Where none of them
        has, it names their kinds and no time.
        """
        self.look()
        done = sum(t.took_s is not None for t in self.tasks)
        if done == len(self.tasks) or not self.busy_s:
            return ""
        runs = sum(t.added for t in self.tasks)
        added = f", {runs} runs in YADE" if runs else ""
        unknown = self.unknown()
        seconds = self.left_s({t.kind for t in self.tasks} - {*unknown})
        said = f"progress: {done} of {len(self.tasks)} jobs{added}"
        what = listed([f"{rule} of {model}" if model else rule for rule, model in unknown], 2)
        if unknown and seconds < 60.0:
            return f"{said}, no forecast before one of each has ended: {what}"
        least = "at least " if self.overdue or unknown else ""
        beside = f", without {what}" if unknown else ""
        return f"{said}, {least}{spoken(seconds)} left{beside}"

    def watch(self, interval_s=INTERVAL_S, look_s=LOOK_S, stream=None):
        """Print the line now and then from a thread that ends with the process."""

        def loop():
            due = self.clock() + interval_s
            while True:
                time.sleep(look_s)
                self.look()
                if self.clock() >= due:
                    due += interval_s
                    if text := self.line():
                        print(text, file=stream or sys.stderr, flush=True)

        threading.Thread(target=loop, name="progress", daemon=True).start()


def tasks_of(workflow, runs=lambda job: None):
    """Tasks of all jobs that a workflow is about to run.

    Its scheduler must exist, as it does in `onstart`. `runs` returns the number of runs of a job
    with a journal, where it is known beforehand.
    """
    dag, scheduler = workflow.dag, workflow.scheduler

    def state(job):
        if dag.finished(job):
            return "done"
        return "running" if job in scheduler.running else "waiting"

    tasks = [
        Task(
            job.rule.name,
            lambda job=job: state(job),  # type: ignore[misc]
            job.wildcards_dict.get("model", ""),
            getattr(job.params, "journal", None),
            runs(job),
            bool(job.rule.benchmark),
        )
        for job in dag.needrun_jobs()
        if not job.rule.norun
    ]
    for task in tasks:
        task.state()  # where Snakemake differs, it is told here and not in a thread
    return tasks


def opening(tasks, runs, cores):
    """Line that says what a study is about to run, on so many cores if their number is known."""
    counts = Counter(task.rule for task in tasks if task.costly)
    long = [f"{n} {rule}" for rule, n in counts.items()]
    short = len(tasks) - counts.total()
    where = f" on {cores} core{'s' * (cores > 1)}" if cores else ""
    parts = ", ".join([*long, *([f"{short} short"] if short else [])])
    return f"{listed(runs, 4)}: {len(tasks)} jobs{where}: {parts}"
