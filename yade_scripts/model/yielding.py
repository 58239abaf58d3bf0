"""Floor motions of a building that yields: at every amplitude others.

What shakes a scene is asked for at a factor in one place, `floor_motions.scaled`. Columns of an
elastic chain are scaled there; those of a chain that yields are computed for the factor, from the
ground's. They are a dictionary as any other, for a factor of one as if the chain were elastic, so
whoever needs the ground, or names, has them; how they shake only `at` and `at_all` say.
"""

import copy

import numpy as np

from yade_scripts.lists import listed
from yade_scripts.model import storeys
from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2
from yade_scripts.model.motion import GROUND, VERTICAL, along
from yade_scripts.model.registry import MODELS

MOST_APART = 1.25  # ratio of intensities between which tabulated floors are mixed
ALIKE = 1e-3  # of its peak, by which a ground motion may differ from another one, scaled
EVEN = 1e-3  # of a step, by which times may differ from evenly spaced ones: files round them


class Moved(dict):
    """Columns as they shake, and in `states` what the chain has come to, by its ground.

    `scaled` says that they are the columns for a factor of one times the factor.
    """

    states: dict
    scaled: bool


class ByAmplitude(dict):
    """Columns of floor motions that at every factor are others; its own are for a factor of one."""

    def at(self, factor):
        """`Moved` at a factor on the ground's motion; its sign turns the horizontal columns."""
        return self.at_all([factor])[0]

    def at_all(self, factors):
        """`Moved`, one a factor."""
        raise NotImplementedError

    @property
    def identity(self):
        """What the floors depend on beside the columns, as bytes."""
        raise NotImplementedError

    def _times(self, factor):
        """Columns times a factor."""
        size = {VERTICAL: abs(factor)}
        moved = Moved({name: size.get(name, factor) * v for name, v in self.items()})
        moved.states, moved.scaled = {}, True
        return moved


class TabulatedFloors(ByAmplitude):
    """Floor motions that another program computed at some intensities, by PGA.

    Parameters
    ----------
    levels : sequence of dict
        Columns on one time axis, of one ground motion at ascending amplitudes. A factor of one is
        the lowest.

    Between two intensities the floors are mixed in proportion, each scaled to the PGA; below the
    lowest they are scaled. Above the highest they are not known.

    Raises
    ------
    ValueError
        In one line, for another ground motion, other columns, or intensities too far apart.
    """

    def __init__(self, levels):
        """Take over the columns of the lowest; check the others against them."""
        super().__init__(levels[0])
        self.levels = levels
        first = self[GROUND]
        self.sizes = np.array([(level[GROUND] @ first) / (first @ first) for level in levels])
        for level, size in zip(levels, self.sizes, strict=True):
            off = np.abs(level[GROUND] - size * first).max() if size > 0.0 else np.inf
            if off > ALIKE * size * np.abs(first).max():
                raise ValueError("the ground's motion is not that of the lowest intensity, scaled")
            if list(level) != list(self):
                raise ValueError(f"columns {listed(level)}; expected {listed(self)}")
        ratios = self.sizes[1:] / self.sizes[:-1]
        if np.any(ratios <= 1.0) or np.any(ratios > MOST_APART):
            raise ValueError(
                f"intensities: expected ascending ones, at most a factor of {MOST_APART:g} apart, "
                f"got steps of {listed(f'{ratio:.3g}' for ratio in ratios)}"
            )

    @property
    def highest_m_s2(self):
        """Peak of the ground's acceleration at the highest intensity."""
        return float(np.abs(self[GROUND]).max() * self.sizes[-1])

    @property
    def identity(self):
        """All that was tabulated."""
        return b"".join(v.tobytes() for level in self.levels for v in level.values())

    def at_all(self, factors):
        """`Moved`, one a factor; ValueError above the highest intensity."""
        all_moved = []
        for factor in factors:
            size = abs(factor)
            if size > self.sizes[-1] * (1.0 + 1e-9):
                peak = float(np.abs(self[GROUND]).max()) / STANDARD_GRAVITY_M_S2
                raise ValueError(
                    f"floor motions at a PGA of {size * peak:.4g} g: expected at most "
                    f"{self.sizes[-1] * peak:.4g} g, the highest of their table"
                )
            moved = self._times(factor)
            if size > self.sizes[0]:
                k = min(int(np.searchsorted(self.sizes, size)), len(self.sizes) - 1)
                low, high = self.sizes[k - 1], self.sizes[k]
                share = (size - low) / (high - low)
                for name in self:
                    if name in (GROUND, VERTICAL):
                        continue
                    below, above = self.levels[k - 1][name] / low, self.levels[k][name] / high
                    moved[name] = factor * ((1.0 - share) * below + share * above)
                moved.scaled = False
            all_moved.append(moved)
        return all_moved


class YieldingFloors(ByAmplitude):
    """Columns of the chain of a case that yields; `march` is that of `storeys`, or one alike."""

    def __init__(self, time_s, columns, case, march=storeys.march):
        """Take over columns of `floor_motions.read`; ValueError if times are not evenly spaced."""
        super().__init__(columns)
        step = (time_s[-1] - time_s[0]) / (len(time_s) - 1)
        if np.abs(np.diff(time_s) - step).max() > EVEN * step:
            raise ValueError("floors of a building that yields: expected times evenly spaced")
        self.march, self.chain = march, storeys.chain_of(case, step)
        self.height_m = storeys.storey_height(case)
        self.start: dict = {}
        self._first: dict = {}

    @property
    def identity(self):
        """What the floors depend on beside the columns, as bytes."""
        yielding = self.chain.storeys
        parts = [*self.chain[1:-1], yielding.k_n_m, yielding.yield_m, *self.start.values()]
        parts.append(np.array([yielding.law, *yielding[3:]]))
        return b"".join(np.asarray(part, float).tobytes() for part in parts)

    def following(self, moved):
        """Return the columns of the same chain after what has `moved` it: it starts damaged."""
        other = copy.copy(self)
        other.start = {name: state for name, state in moved.states.items() if state is not None}
        return other

    def at_all(self, factors):
        """`Moved`, one a factor."""
        all_moved = [self._times(factor) for factor in factors]
        floors = [f"floor{j}" for j in range(1, len(self.chain.square_1_s2) + 1)]
        for name in (GROUND, along(GROUND)):
            if name in self:
                names = floors if name == GROUND else [along(floor) for floor in floors]
                self._move(name, names, factors, all_moved)
        return all_moved

    def _move(self, ground, names, factors, all_moved):
        """Give the columns over one ground what its chain does where it yields."""
        weak = np.flatnonzero(self.weak(factors, ground)).tolist()
        for moved in all_moved:
            moved.states[ground] = None
        if not weak:
            return
        some = [factors[k] for k in weak]
        rows, states = self.march(self.chain, self[ground], some, self.start.get(ground))
        for k, floors, state in zip(weak, rows, states, strict=True):
            all_moved[k].update(zip(names, floors, strict=True))
            all_moved[k].states[ground], all_moved[k].scaled = state, False

    def weak(self, factors, ground=GROUND):
        """Whether a storey yields at each factor, or has before, shape (n,)."""
        if self.start.get(ground) is not None:
            return np.ones(len(factors), bool)
        drift = np.abs(np.asarray(factors, float))[:, None] * self._elastic(ground)
        return np.any(drift > self.chain.storeys.yield_m, axis=1)

    def _elastic(self, ground):
        """Largest drift of each storey for a factor of one, did it not yield [m]."""
        if ground not in self._first:
            strong = self.chain.storeys._replace(yield_m=self.chain.storeys.yield_m + 1e9)
            chain = self.chain._replace(storeys=strong)
            _, states = self.march(chain, self[ground], [1.0], floors=False)
            self._first[ground] = storeys.largest_drift(states[0])
        return self._first[ground]

    def drift_ratios(self, factors):
        """Largest drift of any storey over its height at each factor, no façade before it."""
        factors = np.asarray(factors, float)
        ratios = np.abs(factors) * self._elastic(GROUND).max() / self.height_m
        weak = np.flatnonzero(self.weak(factors))
        if weak.size:
            start = self.start.get(GROUND)
            _, states = self.march(self.chain, self[GROUND], factors[weak], start, floors=False)
            ratios[weak] = storeys.largest_drift(states).max(axis=1) / self.height_m
        return ratios


def following(columns, moved):
    """Columns after what has `moved` their building; others than those that yield as they are."""
    both = isinstance(columns, YieldingFloors) and isinstance(moved, Moved)
    return columns.following(moved) if both else columns


def content(columns, names):
    """Bytes of what shakes a scene whose motions have these names, whatever the factor."""
    if isinstance(columns, ByAmplitude):
        given = b"".join(columns[name].tobytes() for name in sorted(columns))
        return given + columns.identity
    return b"".join(columns[name].tobytes() for name in names)


def drives(case):
    """Whether the walls of a case move as floors of a chain that yields, which nothing pushes."""
    kind = MODELS.get(case["model"])  # a whole building has its own
    one_way = kind is not None and kind.chain and not kind.two_way
    return one_way and storeys.yields(case["smdof"])


def of_case(case, time_s, columns, march=storeys.march):
    """Columns that shake a case: `YieldingFloors` where its chain yields and drives its walls.

    Where its walls carry the masses of the chain these yield in the scene. Of floors of another
    program walls that are no floors need the ground alone, at any amplitude.
    """
    kind = MODELS.get(case["model"])
    if isinstance(columns, TabulatedFloors) and kind is not None and not kind.chain:
        return {name: columns[name] for name in (GROUND, VERTICAL) if name in columns}
    if not drives(case) or isinstance(columns, ByAmplitude):
        return columns
    return YieldingFloors(time_s, columns, case, march)
