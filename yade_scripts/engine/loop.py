"""The one place where YADE steps, is stopped, and calls back into Python.

YADE's own `Omega.run` steps in a thread of its own, whose runners need Python's lock: whoever
waits for that thread with the lock held, as `Omega.reset` does, waits for ever. Here the
main thread itself takes every step. There is no second thread to wait for, the digits are the
same, and a step costs no more: what the call costs, the lock's passing to and fro did before.

A run ends in one way only, after a whole step: when its steps are done, when a runner calls
`stop` or raises, or when a signal that Python handles has come.

A runner inside a step costs some 8 µs a call, for YADE compiles its command anew every time.
What may as well be called between two steps is a `Visit`, which costs a tenth of that.
"""

import itertools
import math
import signal
from collections.abc import Callable
from dataclasses import dataclass

import __main__

SIGNALS = (signal.SIGINT, signal.SIGTERM)
CALLS = "_yade_calls"  # YADE looks names up in `__main__`

_ending: list = []  # why the run is to end after the present step; read at every step
_errors: list = []
_calls: list = []
_visits: list = []


@dataclass
class Visit:
    """A function that `run` calls between two steps.

    What it raises ends the run and is raised by `run`. `period` is the steps to the next call, read
    after each call, so that the function may change it; inf ends it. `due` counts the steps taken
    (`Omega.iter`) at the next call.
    """

    function: Callable
    period: float
    due: float = 0


def reset(omega):
    """Empty YADE and forget the runners and visits of what it held."""
    omega.reset()
    _calls.clear()
    _visits.clear()


def between(function, period, *, first=0):
    """Call a function between steps: after the first `first` ones, then as its `Visit` says.

    Positions and `Omega.time` agree at a call; velocities are those half a step before, forces
    those a whole step before. Of visits due at once the latest made comes first: samples see the
    step as it was, before guides and bonds prepare the next one.
    """
    _visits.insert(0, Visit(function, max(1, period), first))
    return _visits[0]


def _visit(taken):
    """Call what is due after so many steps; return the steps to the next call."""
    next_due = math.inf
    for visit in _visits:
        if visit.due <= taken:
            try:
                visit.function()
            except BaseException as error:
                _errors.append(error)
                _ending.append(True)
            visit.due = taken + visit.period
        if visit.due < next_due:
            next_due = visit.due
    return next_due - taken


def runner(function, period, *, at_start=True):
    """Engine by which YADE calls a Python function every `period` steps, and at the first.

    What the function raises ends the run and is raised by `run`.
    """
    from yade.wrapper import PyRunner

    def guarded():
        try:
            function()
        except BaseException as error:  # YADE would make a RuntimeError of it
            _errors.append(error)
            _ending.append(True)

    setattr(__main__, CALLS, _calls)
    _calls.append(guarded)
    return PyRunner(
        command=f"{CALLS}[{len(_calls) - 1}]()", iterPeriod=max(1, period), initRun=at_start
    )


def from_engines(omega):
    """Let YADE's own run, as its viewer starts it, call what `run` calls between steps.

    It pauses where a run would end.
    """

    def before_step():
        _ending.clear()
        _visit(omega.iter)
        if _ending:
            omega.pause()

    omega.engines = [runner(before_step, 1), *omega.engines]


def stop():
    """End the run after the present step; for runners."""
    _ending.append(True)


def run(omega, steps):
    """Take so many steps, or fewer where something ends the run.

    What a runner raised is raised, or what the handler of a signal raises.
    """
    _ending.clear()
    _errors.clear()
    came: list = []

    def note(number, frame):  # a handler may interrupt a runner: it waits for the step's end
        came.append((number, frame))
        _ending.append(True)

    handlers = {n: h for n in SIGNALS if callable(h := signal.getsignal(n))}
    try:
        for number in handlers:
            signal.signal(number, note)
        step = omega.step
        gap = _visit(omega.iter)
        while steps > 0 and not _ending:
            gap = min(gap, steps)
            for _ in itertools.repeat(None, gap):
                step()
                if _ending:
                    break
            steps -= gap
            gap = _visit(omega.iter)
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
    for number, frame in came:
        handlers[number](number, frame)
    if _errors:
        raise _errors[0]
