"""Motions that drive a planar scene: linear between samples, and tabulated at the whole steps.

One motion that drives many histories is tabulated once, to its end. Where each history has its own
they are tabulated as they march, `STRIDE` steps of eight motions at a time.
"""

import math
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from rocking.runtime.compiled import inlined, looped

from .vectors import choose, put, take

STRIDE = 256  # steps between two looks at which histories have ended
KEPT = 12_000_000  # numbers in the tables of one motion that are kept, 100 MB: of a dense scan all


class Samples(NamedTuple):
    """Motions for a factor of one, one after the other in each array; ends at rest."""

    begin: np.ndarray  # (motions + 1,) where each begins
    time_s: np.ndarray
    field_m_s2: np.ndarray  # (samples, 2) ground and vertical
    field_m_s3: np.ndarray  # their rates up to the next sample
    apart_m_s3: np.ndarray  # (samples, supports) relative to the ground; none if a chain carries
    apart_m_s2: np.ndarray
    speed_m_s: np.ndarray
    place_m: np.ndarray


class SteppedMotions(NamedTuple):
    """Motions at whole steps: `columns` rows a step, as `tabulate` writes them."""

    samples: Samples
    step_s: float
    rows: np.ndarray  # of one motion to its end, or STRIDE steps of a motion a lane
    flat: np.ndarray  # the same memory
    near: np.ndarray  # (motions, rows) of several STRIDE steps of each
    from_step: np.ndarray  # (motions,), int: with which these begin


@dataclass(frozen=True)
class Motions:
    """Accelerations that drive a planar scene, linear between samples, at rest before them.

    Parameters
    ----------
    time_s : array_like, shape (nt,)
    ground_m_s2 : array_like, shape (nt,)
        Of the reference support, positive outward.
    supports_m_s2 : array_like, shape (m, nt)
        Absolute, in the order of `moving_supports(scene)`.
    vertical_m_s2 : array_like, shape (nt,), or None
        Of ground and walls alike, positive upward; scaled by the size of the others' factor.
    alone_m_s2 : array_like, shape (n, nt)
        Of what carries the supports, absolute, without what leans on it. It drives nothing and
        tells how long it moves.

    Raises
    ------
    ValueError
        If shapes differ, times do not ascend or a value is not finite.
    """

    time_s: np.ndarray
    ground_m_s2: np.ndarray
    supports_m_s2: Any = ()
    vertical_m_s2: Any = None
    alone_m_s2: Any = ()
    _tables: dict = field(default_factory=dict, init=False, repr=False, compare=False)
    _kept: dict = field(default_factory=dict, init=False, repr=False, compare=False)

    def __post_init__(self):
        """Check, and let every acceleration end at zero."""
        time = np.asarray(self.time_s, float)
        ground = np.asarray(self.ground_m_s2, float)
        vertical = 0.0 * ground if self.vertical_m_s2 is None else self.vertical_m_s2
        supports = np.asarray(self.supports_m_s2, float)
        alone = np.asarray(self.alone_m_s2, float)
        rows = [ground, np.asarray(vertical, float), *supports, *alone]
        if time.ndim != 1 or time.size < 2 or any(row.shape != time.shape for row in rows):
            raise ValueError("motions: expected accelerations of the length of time_s, at least 2")
        if not (np.all(np.isfinite(rows)) and np.all(np.diff(time) > 0.0)):
            raise ValueError("motions: expected finite accelerations at ascending times")
        end = 2.0 * time[-1] - time[-2]
        rows = [np.append(row, 0.0) for row in rows]
        for name, value in (
            ("time_s", np.append(time, end)),
            ("ground_m_s2", rows[0]),
            ("vertical_m_s2", rows[1]),
            ("supports_m_s2", np.reshape(rows[2 : 2 + len(supports)], (-1, time.size + 1))),
            ("alone_m_s2", np.reshape(rows[2 + len(supports) :], (-1, time.size + 1))),
        ):
            object.__setattr__(self, name, value)

    def later_peak(self, alone=False):
        """Largest |acceleration| of ground and supports from each sample on [m/s²]; kept.

        `alone`: of what carries the supports too.
        """
        key = "later", alone
        if key not in self._kept:
            rows = [self.ground_m_s2[None], self.supports_m_s2, self.alone_m_s2]
            envelope = np.abs(np.vstack(rows if alone else rows[:2])).max(axis=0)
            self._kept[key] = np.maximum.accumulate(envelope[::-1])[::-1]
        return self._kept[key]

    def peak_speed(self):
        """Largest |velocity| of ground and supports at a factor of one [m/s]; kept."""
        if "speed" not in self._kept:
            rows = np.vstack([self.ground_m_s2, self.supports_m_s2])
            gain = 0.5 * np.diff(self.time_s) * (rows[:, 1:] + rows[:, :-1])
            self._kept["speed"] = float(np.abs(np.cumsum(gain, axis=1)).max())
        return self._kept["speed"]

    def table(self, step_s, supports=True):
        """`SteppedMotions` of this motion alone; those of supports relative to the ground, exact.

        The last are kept up to `KEPT` numbers: a scan asks for some amplitudes at a time, in each
        of its layouts and steps again.
        """
        kept = self._tables
        if (step_s, supports) not in kept:
            samples = samples_of([self], supports)
            rows = np.zeros((last_step(self, step_s) + 1) * columns(samples))
            begin = np.zeros(1, np.int64)
            table = SteppedMotions(samples, step_s, rows, rows, rows.reshape(1, -1), begin)
            tabulate_all(table)
            kept[step_s, supports] = table
            while len(kept) > 1 and sum(table.rows.size for table in kept.values()) > KEPT:
                kept.pop(next(iter(kept)))
        return kept[step_s, supports]

    def arrays(self, supports=True):
        """What this motion adds to `Samples`; kept."""
        if supports not in self._kept:
            dt, apart = np.diff(self.time_s), []
            for row in self.supports_m_s2 if supports else ():
                a = row - self.ground_m_s2
                v = np.concatenate(([0.0], np.cumsum(0.5 * dt * (a[1:] + a[:-1]))))
                u = v[:-1] * dt + dt**2 * (2.0 * a[:-1] + a[1:]) / 6.0
                apart.append((_rate(a, dt), a, v, np.concatenate(([0.0], np.cumsum(u)))))
            of_supports = np.reshape(apart, (len(apart), 4, self.time_s.size)).transpose(1, 2, 0)
            field = np.stack([self.ground_m_s2, self.vertical_m_s2])
            every = field.T, _rate(field, dt).T, *of_supports
            self._kept[supports] = (self.time_s, *map(np.ascontiguousarray, every))
        return self._kept[supports]


def _rate(values, dt):
    """Change of values up to the next sample [1/s]; none after the last."""
    return np.append(np.diff(values) / dt, 0.0 * values[..., -1:], axis=-1)


@looped
def _fill(samples, first, time_s, ground, vertical, supports):
    """Write one motion into `Samples` from a place on: as `Motions.arrays` has it, digit by digit.

    `supports` (m, nt), of as many as the samples have.
    """
    last, count = time_s.size - 1, samples.place_m.shape[1]
    for i in range(last + 1):
        at, k = first + i, min(i + 1, last)
        dt = time_s[k] - time_s[i] if i < last else 1.0
        samples.time_s[at] = time_s[i]
        samples.field_m_s2[at, 0], samples.field_m_s2[at, 1] = ground[i], vertical[i]
        samples.field_m_s3[at, 0] = (ground[k] - ground[i]) / dt
        samples.field_m_s3[at, 1] = (vertical[k] - vertical[i]) / dt
        for j in range(count):
            now, after = supports[j, i] - ground[i], supports[j, k] - ground[k]
            samples.apart_m_s2[at, j], samples.apart_m_s3[at, j] = now, (after - now) / dt
            if i == 0:
                samples.speed_m_s[at, j] = samples.place_m[at, j] = 0.0
            if i < last:
                v = samples.speed_m_s[at, j]
                samples.speed_m_s[at + 1, j] = v + 0.5 * dt * (after + now)
                way = v * dt + dt * dt * (2.0 * now + after) / 6.0
                samples.place_m[at + 1, j] = samples.place_m[at, j] + way


def samples_of(motions, supports):
    """`Samples` of some motions; `supports`: whether theirs are wanted too."""
    begin = np.cumsum([0, *(motion.time_s.size for motion in motions)])
    if len(motions) == 1:
        return Samples(begin, *motions[0].arrays(supports))
    size, count = begin[-1], len(motions[0].supports_m_s2) if supports else 0
    shapes = (size, (size, 2), (size, 2), *((size, count),) * 4)
    samples = Samples(begin, *map(np.empty, shapes))
    for first, motion in zip(begin[:-1], motions, strict=True):
        rows = motion.time_s, motion.ground_m_s2, motion.vertical_m_s2, motion.supports_m_s2
        _fill(samples, first, *map(np.ascontiguousarray, rows))
    return samples


def last_step(motions, step_s):
    """Step from which on a motion has ended: what moves then coasts."""
    return math.ceil(motions.time_s[-1] / step_s)


@inlined
def columns(samples):
    """Rows of a step: ground, vertical, and place and speed of each support."""
    return 2 + 2 * samples.place_m.shape[1]


@inlined
def _before(time_s, begin, end, now_s):
    """Sample at or before a time; the first and the last but one where there is none."""
    low, high = begin, end - 2
    while low < high:
        middle = (low + high + 1) // 2
        if time_s[middle] <= now_s:
            low = middle
        else:
            high = middle - 1
    return low


@inlined
def tabulate(table, motion, first, steps):
    """Write a motion at so many steps from `first` on into its row of `near`.

    Between samples an acceleration a + γs makes a velocity v + as + γs²/2 and a place
    u + vs + as²/2 + γs³/6; from the last step of a motion on its last row stands.
    """
    samples, step_s, row = table.samples, table.step_s, table.near[motion]
    time_s, field, rise = samples.time_s, samples.field_m_s2, samples.field_m_s3
    begin, end = samples.begin[motion], samples.begin[motion + 1]
    from_s, until_s, supports = time_s[begin], time_s[end - 1], samples.place_m.shape[1]
    last, at = math.ceil(until_s / step_s), 0
    i = _before(time_s, begin, end, step_s * first)
    for k in range(first, first + steps):
        now = step_s * min(k, last)
        while i < end - 2 and time_s[i + 1] <= now:
            i += 1
        near, s = (i, max(now, from_s) - time_s[i]) if now < until_s else (end - 1, 0.0)
        for j in range(2):
            row[at] = rise[near, j] * s + field[near, j]
            at += 1
        s, coasts = min(now, until_s) - time_s[i], max(now - until_s, 0.0)
        square, cube = s * s, s * s * s
        for j in range(supports):
            slope, a = samples.apart_m_s3[i, j], samples.apart_m_s2[i, j]
            v, u = samples.speed_m_s[i, j], samples.place_m[i, j]
            speed = v + a * s + 0.5 * slope * square
            place = u + v * s + 0.5 * a * square + slope * cube / 6.0
            row[at], row[at + supports] = place + speed * coasts, speed
            at += 1
        at += supports


@looped
def tabulate_all(table):
    """Write one motion to its end."""
    tabulate(table, 0, 0, table.rows.size // columns(table.samples))


@inlined
def to_lanes(table, motion, histories, first):
    """Write steps from `first` on of each lane's motion into the rows that lanes read.

    `motion`: of each history; `histories`: those of the lanes, −1: none. A motion that several of
    them have is tabulated once.
    """
    near, width = table.near, len(histories)
    for lane in range(width):
        which = motion[max(histories[lane], 0)]
        if table.from_step[which] != first:
            table.from_step[which] = first
            tabulate(table, which, first, STRIDE)
    for at in range(near.shape[1]):
        for lane in range(width):
            table.flat[at * width + lane] = near[motion[max(histories[lane], 0)], at]


@inlined
def drive(table, at, factor, late, k, past_s, supports):
    """Move the driven supports to step k: their place, velocity, and way since the step before.

    `at`: the step's first row. They coast where the motion has ended (`late`); `past_s` is the
    step, and zero at the first.
    """
    count = table.samples.place_m.shape[1]
    for j in range(count):
        speed = factor * take(table.rows, at + 2 + count + j)
        old = take(supports.y, j)
        place = choose(late, old + past_s * speed, factor * take(table.rows, at + 2 + j))
        put(supports.y, j, place)
        put(supports.vy, j, speed)
        put(supports.dy, j, place - old if k > 0 else 0.0 * place)
