"""Where the mechanisms of a façade are weakest: feet between changes, hinges, corners.

Every function takes a `family.Family` and returns `Site`s. What a site is ranked by is smooth
between the heights at which the façade changes, and jumps there: it is sampled on both sides of
each change and between, and the best sample is followed down (`_least`). Squat parts are included:
what is too squat to turn never loses its multiplier, and is ranked last.
"""

import itertools
import math

import numpy as np
from scipy.optimize import minimize_scalar

from studies.assess.names import BETWEEN
from studies.assess.sites import CORNERS, LEAST_PART_M, WHOLE_PART, Site

BESIDE_M = 0.02  # of a change: what lies just above it or below
BLOCK_M = 0.1  # least height of a block of vertical bending
APART_M, FEET_APART_M = 0.25, 0.5  # of samples between two changes; of feet that bend
HINGES = 13  # samples of a hinge over a span, closer towards its ends
CORNER_FEET = 12  # samples of a corner's foot
NEAR_M = 0.03  # to which a height is found
EVALUATIONS = 10  # of following one height down
ROUNDS, SETTLED = 5, 0.995  # of following foot and hinge; a round gains more, or is the last
STARTS = 6  # feet from which bending is followed
DIP = 1.1  # times the least sample: from there no bottom of a dip comes below it
NEVER = 1e6  # of what never fails, for arithmetic
WORTH = 0.99  # of the feet either side: a foot between them counts from there on


def _least(measure, low_m, high_m, start, best):
    """Height between two, and its measure, followed down from a sample; no worse than that."""
    if high_m - low_m < NEAR_M:
        return start, best
    least = minimize_scalar(
        lambda z: min(measure(z), NEVER),
        bounds=(low_m, high_m),
        method="bounded",
        options={"xatol": NEAR_M, "maxiter": EVALUATIONS},
    )
    return (float(least.x), float(least.fun)) if least.fun < best else (start, best)


def _sampled(low_m, high_m, apart_m=APART_M):
    """Samples of an interval between two changes: beside its ends, and between.

    A link that gives way early sets d_SLV for some feet and not for others: there what a site is
    ranked by jumps too, so that samples are close.
    """
    if high_m - low_m < 3.0 * BESIDE_M:
        return []
    count = 2 + max(1, math.ceil((high_m - low_m) / apart_m))
    return np.linspace(low_m + BESIDE_M, high_m - BESIDE_M, count).tolist()


def _dips(samples, low_m, high_m):
    """Samples (value, height) below both neighbours and near the least; the heights beside each.

    The least sample alone may lie in a dip whose bottom is higher than another's.
    """
    values = [NEVER, *(min(value, NEVER) for value, _ in samples), NEVER]
    places = [low_m, *(z for _, z in samples), high_m]
    least = min(values)
    for k, sample in enumerate(samples):
        before, value, after = values[k : k + 3]
        if value <= min(before, after, DIP * least):
            yield places[k], sample, places[k + 2]


def parts(family):
    """Parts above every foot, and between two feet the weakest where it is weaker than both."""
    sites, listed_m, top = feet(family), family.feet(), family.masonry.top_m
    if family.slv is None:  # α0 has no minimum between two feet
        return sites
    listed = {site.foot_m: family.measure(site) for site in sites}
    ends = [*listed_m, top - LEAST_PART_M]
    for low, high in itertools.pairwise(ends):
        part = f"{BETWEEN}_{low}_and_{float(round(high, 6))}"

        def measure(z, part=part):
            return family.measure(Site(part, float(z)))

        heights = _sampled(low, high)
        if heights and high == ends[-1]:  # where the list ends and nothing changes
            heights.append(high)
        samples = [(measure(z), z) for z in heights]
        if not samples:
            continue
        best, at = min(
            _least(measure, below + NEAR_M, above - NEAR_M, z, value)[::-1]
            for below, (value, z), above in _dips(samples, low, high)
        )
        if best < WORTH * min(listed[low], listed.get(high, math.inf)):
            sites.append(Site(part, at, at_foot=BETWEEN))
    return sorted(sites, key=lambda site: site.foot_m)


def feet(family):
    """Parts above every foot."""
    parts = {z: f"above_{z}" if z else WHOLE_PART for z in family.feet()}
    return [Site(parts[z], z, at_foot=keys) for z, keys in family.feet().items()]


def spans(family):
    """Vertical bending between every two levels that hold, of each the weakest that falls."""
    pairs = itertools.combinations(family.levels(), 2)
    sites = [bending(family, low, high) for low, high in pairs]
    return [site for site in sites if site is not None]


def bending(family, low_m, high_m):
    """Vertical bending between two levels that hold, the weakest that falls; None where none does.

    Its foot lies between the lower level and the next one.
    """
    next_m = min(z for z in family.levels() if z > low_m)
    feet_m = [low_m, *(z for z in family.feet() if low_m < z < next_m)]
    if family.slv is None:
        return span(family, feet_m, low_m, high_m)
    for a, b in itertools.pairwise([*feet_m, next_m]):
        feet_m = [*feet_m, *_sampled(a, b, FEET_APART_M)]
    return span(family, feet_m, low_m, high_m, next_m)


def span(family, feet, low_m, high_m, next_m=None):
    """Bending up to one level, the weakest by foot and hinge; None where none falls.

    Feet to begin with, of which the best moves up to `next_m`; None keeps it.
    """
    part, memo = f"from_{float(low_m)}_to_{float(high_m)}", {}

    def measure(foot, hinge):
        key = round(float(foot), 4), round(float(hinge), 4)
        if key not in memo:
            site = Site(part, float(foot), float(hinge), high_m)
            memo[key] = family.measure(site)
        return memo[key]

    samples = [
        (measure(foot, hinge), foot, hinge)
        for foot in feet
        for hinge in _hinges(family, foot, high_m)
    ]
    firsts: dict[float, tuple] = {}  # of every foot its weakest hinge
    for value, foot, hinge in sorted(samples):
        firsts.setdefault(foot, (value, foot, hinge))
    starts = [start for start in list(firsts.values())[:STARTS] if math.isfinite(start[0])]
    if not starts:
        return None
    best = min(_followed(family, measure, (low_m, high_m, next_m), feet, start) for start in starts)
    return Site(part, best[1], best[2], high_m)


def _followed(family, measure, ends_m, feet, start):
    """Measure, foot and hinge, each followed down in turn from a start (measure, foot, hinge).

    `ends_m` are the levels that hold and the height up to which the foot moves, or None.
    """
    (low_m, high_m, next_m), (best, foot, hinge) = ends_m, start
    for _ in range(1 if next_m is None else ROUNDS):
        before, near = best, sorted({foot, high_m, *_hinges(family, foot, high_m), hinge})
        below = max((z for z in near if z < hinge - 2.0 * BESIDE_M), default=foot)
        above = min((z for z in near if z > hinge + 2.0 * BESIDE_M), default=high_m)
        middle, ends = hinge, (max(below, foot + BLOCK_M), min(above, high_m - BLOCK_M))
        for low, high in ((ends[0], middle), (middle, ends[1])):  # where it jumps one side is blind
            hinge, best = _least(lambda z, foot=foot: measure(foot, z), low, high, hinge, best)
        if next_m is not None:
            last = min(next_m, hinge - BLOCK_M)
            below = max((z for z in feet if z < foot), default=low_m)
            above = min((z for z in feet if z > foot), default=last)
            ends = max(below, low_m), min(above, last)
            foot, best = _least(lambda z, hinge=hinge: measure(z, hinge), *ends, foot, best)
        if best > SETTLED * before:
            break
    return best, foot, hinge


def _hinges(family, foot_m, high_m):
    """Heights at which a span is tried, closer towards its ends, and every change between."""
    low, high = foot_m + BLOCK_M, high_m - BLOCK_M
    if high <= low:
        return []
    angles = np.linspace(0.0, math.pi, HINGES)
    hinges = {float(z) for z in low + 0.5 * (1.0 - np.cos(angles)) * (high - low)}
    for z, _ in family.changes():
        hinges |= {near for near in (z, z - BESIDE_M, z + BESIDE_M) if low < near < high}
    return sorted(hinges)


def corners(family):
    """Both corners, each at its weakest foot; none without a return wall at the ends.

    No tie holds them. A hip rafter's thrust pushes off the top of any dry corner, which what joins
    rafter and walls prevents: with one a corner turns from the base, or above a level that holds
    where it stands at rest.
    """
    if family.wall["count"] < 2:  # a single wall stands in the middle
        return []
    last = family.height_m - LEAST_PART_M
    edges = [z for z in family.masonry.edges_m if 0.0 < z < last]
    samples = sorted({*np.linspace(0.0, last, CORNER_FEET).tolist(), *edges})
    thrust = bool(family.settings["hip_thrust_kn"])
    if thrust:
        samples = [z for z in family.levels() if z < last]
    sites = []
    for side, word in CORNERS.items():

        def measure(z, side=side):
            if not family.corner_masses(side, float(z)):
                return math.inf  # openings up to the eaves
            return family.measure(Site("", float(z), side=side))

        values = [measure(z) for z in samples]
        if thrust:
            values[1:] = [value if value > 0.0 else math.inf for value in values[1:]]
        k = int(np.argmin(values))
        foot = samples[k]
        if not thrust:
            ends = samples[max(k - 1, 0)], samples[min(k + 1, len(samples) - 1)]
            foot, _ = _least(measure, *ends, foot, values[k])
        if family.corner_masses(side, foot):
            sites.append(Site(f"{word}_corner", foot, side=side))
    return sites
