"""Progress and time left of long studies, and what is printed of them."""

import io
import logging
import random
import re
import time
from types import SimpleNamespace

import pytest
from rocking.runtime.progress import Progress, Task, count_lines, opening, planning, spoken
from rocking.runtime.terminal import thin_out
from snakemake_interface_logger_plugins.common import LogEvent

GOOD = 0.15  # error of the time left over the time of the whole


def grow(path, lines):
    with open(path, "a") as handle:
        handle.write("row\n" * lines)


class Machine:
    """Works off jobs (rule, model, seconds) in order, so many at a time, on a clock of its own."""

    def __init__(self, jobs, at_a_time):
        free, self.now, self.spans, self.tasks = [0.0] * at_a_time, 0.0, [], []
        for number, (rule, model, seconds) in enumerate(jobs):
            began = min(free)
            free[free.index(began)] = began + seconds
            self.spans.append((began, began + seconds))
            self.tasks.append(Task(rule, lambda n=number: self.state(n), model))
        self.end = max(free)
        self.progress = Progress(self.tasks, clock=lambda: self.now)

    def state(self, number):
        began, ended = self.spans[number]
        return "done" if ended <= self.now else "running" if began <= self.now else "waiting"

    def until(self, share):
        """Error of the time left at a share of the whole, over the whole."""
        while self.now < share * self.end:
            self.now += 2.0
            self.progress.look()
        return (self.progress.left_s() - (self.end - self.now)) / self.end


@pytest.mark.parametrize("slow", [0.3, 1.0, 4.0])
def test_other_targets_beside_the_curves_do_not_mislead(slow):
    """Forty short figures first, then curves and ensembles of two models: they weigh what they do.

    Counting jobs would announce a tenth of the time; counting curves alone misses the ensembles.
    """
    kinds = [("ida", "W1", 12), ("ida", "W2", 28)]
    jobs = [("figure", "", 2 * slow)] * 40
    jobs += [(rule, model, seconds * slow) for _ in range(30) for rule, model, seconds in kinds]
    machine = Machine(jobs, 2)
    errors = [machine.until(share) for share in (0.3, 0.5, 0.7, 0.9)]
    assert max(map(abs, errors)) < GOOD


def test_what_nobody_measured_before_is_learned():
    """A hundred jobs of eighty seconds each, ten at a time."""
    machine = Machine([("building_modal", "", 80.0)] * 100, 10)
    errors = [machine.until(share) for share in (0.35, 0.6, 0.85)]
    assert max(map(abs, errors)) < GOOD


def test_models_that_wait_are_told_from_those_that_were_measured():
    """Four jobs of W1 and W1c say what W3 takes, though nobody named the rule before."""
    jobs = [("own_study", model, s) for model, s in (("W1", 8), ("W1c", 50)) for _ in range(4)]
    machine = Machine([*jobs, *[("own_study", "W3", 150)] * 4, ("figure", "", 2)], 2)
    errors = [machine.until(share) for share in (0.3, 0.6, 0.9)]
    assert max(map(abs, errors)) < GOOD


def test_one_long_job_at_the_end_is_not_shared_out():
    """Of two cores one idles at the end: what is left is the longest job, not half of it."""
    whole = ("complete_ida", "", 420.0)
    machine = Machine([whole, *[("ida", "W3", 210.0)] * 2, whole], 2)
    assert abs(machine.until(0.5)) < GOOD


def test_known_runs_say_how_far_a_job_is(tmp_path):
    """A grid of ten, three of them kept from before: two more in 60 s, so 150 s for five."""
    now, journal = [0.0], tmp_path / "a.jsonl"
    grow(journal, 3)
    progress = Progress([Task("ida", lambda: "running", "W1", journal, 10)], clock=lambda: now[0])
    assert progress.line() == ""
    grow(journal, 2)
    now[0] = 60.0
    assert progress.left_s() == 150.0
    assert progress.line() == "progress: 0 of 1 jobs, 2 runs in YADE, about 2 min left"


def test_a_job_far_beyond_its_kind_is_not_said_to_end_soon():
    """A scan of a thin façade runs for ten minutes where seconds are usual."""
    now = [0.0]
    progress = Progress([Task("planar_ida", lambda: "running", "W2m")], clock=lambda: now[0])
    progress.line()
    for now[0] in (120.0, 300.0):
        assert progress.left_s() >= now[0]  # no sign that it is in its second half
        assert "at least about" in progress.line()
    usual = Progress([Task("ida", lambda: "running", "W1")], clock=lambda: now[0])
    usual.line()
    now[0] += 5.0
    assert "at least" not in usual.line()


def test_kept_runs_shorten_a_job_that_waits(tmp_path):
    journal = tmp_path / "a.jsonl"
    grow(journal, 9)
    whole, resumed = (
        Progress([Task("ida", lambda: "waiting", "W1", path, None)]).left_s()
        for path in (None, journal)
    )
    assert resumed == pytest.approx(whole * 11 / 20)  # 9 of some 20


def test_nothing_is_said_when_all_is_done():
    machine = Machine([("ida", "W1", 10.0)], 1)
    machine.until(1.0)
    assert machine.progress.line() == ""


def test_the_thread_prints(tmp_path):
    began, said = time.monotonic(), io.StringIO()
    tasks = [Task("ida", lambda: "running", "W1", costly=True), Task("figure", lambda: "waiting")]
    Progress(tasks).watch(0.02, 0.01, said)
    while "progress: 0 of 2 jobs" not in said.getvalue() and time.monotonic() < began + 5.0:
        time.sleep(0.01)
    assert "progress: 0 of 2 jobs" in said.getvalue()
    text = opening([*tasks, *tasks], ["main"], 2)
    assert text == "main: 4 jobs on 2 cores: 2 ida, 2 short"


@pytest.mark.parametrize("asked", ["", "dryrun", "verbose", "printshellcmds"])
def test_the_terminal_shows_what_matters_and_the_file_all(tmp_path, asked):
    logger, screen = logging.Logger("trial"), io.StringIO()
    logger.addHandler(logging.StreamHandler(screen))
    file = logging.FileHandler(tmp_path / "log")
    logger.addHandler(file)
    settings = dict.fromkeys(("dryrun", "verbose", "printshellcmds"), False)
    thin_out(SimpleNamespace(**settings | ({asked: True} if asked else {})), logger)
    logger.info("rule ida:", extra={"event": LogEvent.JOB_INFO})
    logger.info("Select jobs to execute...")
    logger.error("Error in rule ida", extra={"event": LogEvent.JOB_ERROR})
    logger.info("Complete log(s): x")
    file.close()
    everything = (tmp_path / "log").read_text()
    assert everything.count("\n") == 4
    few = "Error in rule ida\nComplete log(s): x\n"
    assert screen.getvalue() == (everything if asked else few)


def test_durations_and_missing_files(tmp_path):
    assert [spoken(s) for s in (5, 90, 6000, 90_000)] == [
        "less than a minute",
        "about 2 min",
        "about 100 min",
        "about 25 h 0 min",
    ]
    assert count_lines(tmp_path / "none") == 0


class Forecasts(Machine):
    """A machine whose jobs of some rules are costly, and what it says at a share of the whole."""

    def __init__(self, jobs, at_a_time, costly):
        super().__init__(jobs, at_a_time)
        for task in self.tasks:
            task.costly = task.rule in costly

    def said(self, share):
        """Return the line, the seconds it stands for, and the seconds that are left."""
        self.until(share)
        return self.progress.line(), self.progress.left_s(), self.end - self.now


def studies(seed):
    """Studies whose kinds nobody named: seconds scatter by half, of a model by a factor of its own.

    A risk of three models one after the other; a strengthening in one long job after short ones;
    curves of a small block that take long, beside figures.
    """
    rng = random.Random(seed)

    def jobs(rule, model, seconds, count):
        own = seconds * rng.lognormvariate(0.0, 0.8)
        return [(rule, model, own * rng.lognormvariate(0.0, 0.4)) for _ in range(count)]

    risk = [j for m, s in (("W1", 6), ("W2", 10), ("W2m", 60)) for j in jobs("scan", m, s, 40)]
    tables = jobs("table", "", 1.5, 20)
    rng.shuffle(mixed := jobs("scan", "W2m", 30, 40) + jobs("figure", "", 2, 40))
    return [risk + tables, [*tables, ("strengthen", "", 900.0), *tables], mixed]


@pytest.mark.parametrize("cores", [1, 2, 8])
def test_after_the_first_tenth_a_time_is_within_a_factor_of_two_or_not_said(cores):
    """One that is said as the least promises nothing; a minute more or less does not matter."""
    promised = 0
    for seed in range(8):
        for jobs in studies(seed):
            machine = Forecasts(jobs, cores, {"scan", "strengthen"})
            for share in (0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9):
                line, forecast_s, left_s = machine.said(share)
                if "no forecast" in line or "at least" in line:
                    continue
                promised += 1
                assert 0.5 * left_s - 60.0 < forecast_s < 2.0 * left_s + 60.0, (seed, share, line)
    assert promised > 84  # of 168 moments


def test_a_long_job_of_which_nothing_is_known_gets_no_time():
    """Formerly "less than a minute", for minutes: what nobody measured counted as a table."""
    machine = Forecasts([*[("table", "", 2.0)] * 5, ("strengthen", "", 600.0)], 2, {"strengthen"})
    line, _, _ = machine.said(0.05)
    assert line.endswith("no forecast before one of each has ended: strengthen")
    machine = Forecasts([("scan", "W1", 9.0)] * 90 + [("scan", "W2m", 90.0)] * 9, 2, {"scan"})
    line, _, _ = machine.said(0.1)
    assert re.search(r"at least about \d+ min left, without scan of W2m$", line)


def test_what_one_model_took_promises_nothing_of_another():
    """Formerly "at least about 22 min" of six: jobs of W3 took a seventh of what is usual."""
    jobs = [("ida", "W1", 6.0)] * 20 + [("ida", "W3", 30.0)] * 20
    machine = Forecasts(jobs, 2, {"ida"})
    line, _, _ = machine.said(0.05)
    assert line.endswith("no forecast before one of each has ended: ida of W3")
    line, forecast_s, left_s = machine.said(0.4)
    assert "at least" not in line
    assert 0.5 * left_s < forecast_s < 2.0 * left_s


def test_a_long_plan_is_said_before_it_begins():
    """4,400 curves took 31 to 35 s and 0.4 GB (docs/large.md)."""
    assert planning(1056) == ""
    assert planning(4400) == (
        "planning: 4,400 curves; to plan them all takes about 1 min and 0.4 GB of memory"
    )
    assert "about 12 min and 6 GB" in planning(80_000)
