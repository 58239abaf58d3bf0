"""Masonry between two lines along a façade: what does not move over its whole width.

Heights and places are as of `Masonry`: z over the base, x along the façade from its middle.
"""

import itertools

from rocking.mechanics.mechanism import gauss

NEAR_M = 1e-9


def strips(masonry, low_m, high_m, ends, cuts=()):
    """Spans of masonry between two heights: (z, height, x0, x1), two Gauss points an interval.

    `ends` are two places, or a function of the height that returns them. Intervals end where width
    or thickness changes, where a gable's edge passes a fixed end, and at further `cuts`. Where the
    ends are straight lines between those, sums of what is up to cubic in z are exact.
    """
    edges = {low_m, high_m, *masonry.edges_m, *cuts}
    if not callable(ends) and masonry.gable_m > NEAR_M:
        half = 0.5 * masonry.width_m
        edges |= {masonry.top_m - masonry.gable_m * abs(x) / half for x in ends}
    inside = sorted(z for z in edges if low_m - NEAR_M <= z <= high_m + NEAR_M)
    for a, b in itertools.pairwise(inside):
        if b - a < NEAR_M:
            continue
        for z in gauss(a, b):
            left, right = ends(z) if callable(ends) else ends
            for x0, x1 in _spans(masonry, z, left, right):
                yield z, 0.5 * (b - a), x0, x1


def _spans(masonry, z, left, right):
    """Parts of a line between two ends that are masonry."""
    half = 0.5 * masonry.width_m
    if masonry.gable_m > NEAR_M and z > masonry.top_m - masonry.gable_m:
        half *= (masonry.top_m - z) / masonry.gable_m
    at, right = max(left, -half), min(right, half)
    spans = []
    for x0, x1, z0, z1 in sorted(masonry.shape.openings):
        if z0 <= z <= z1 and x1 > at and x0 < right:
            if x0 > at:
                spans.append((at, x0))
            at = max(at, x1)
    return [*spans, (at, right)] if right - at > NEAR_M else spans


def masses(masonry, low_m, high_m, ends, cuts=()):
    """Weights of `strips`: (weight_n, x_m, y_m, z_m), two Gauss points a span.

    Cornices count before masonry; where an opening is behind one it is left out.
    """
    weights = []
    for z, height, x0, x1 in strips(masonry, low_m, high_m, ends, cuts):
        back, front = masonry.faces(z)
        weight = 0.5 * (x1 - x0) * height * (front - back) * masonry.unit_weight
        weights += [(weight, x, 0.5 * (back + front), z) for x in gauss(x0, x1)]
        for y0, y1 in masonry.projecting(z):
            weight = 0.5 * (x1 - x0) * height * (y1 - y0) * masonry.unit_weight
            weights += [(weight, x, 0.5 * (y0 + y1), z) for x in gauss(x0, x1)]
    return weights


def on_crack(masonry, x_m, low_m, high_m):
    """Pieces of a vertical line that are masonry on either side: (z, height) at Gauss points."""
    beside = {z for x0, x1, *zs in masonry.shape.openings if x0 <= x_m <= x1 for z in zs}
    inside = sorted({low_m, high_m, *(z for z in beside if low_m < z < high_m)})
    pieces = []
    for a, b in itertools.pairwise(inside):
        middle = 0.5 * (a + b)
        rows = masonry.shape.openings
        if not any(x0 <= x_m <= x1 and z0 < middle < z1 for x0, x1, z0, z1 in rows):
            pieces += [(z, 0.5 * (b - a)) for z in gauss(a, b)]
    return pieces


def length(masonry, height_m, ends):
    """Length of masonry between two ends at a height [m]."""
    return sum(b - a for a, b in _spans(masonry, height_m, *ends))
