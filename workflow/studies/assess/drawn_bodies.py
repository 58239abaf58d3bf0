"""Outlines of what a mechanism takes, for drawings: on the elevation, and wedges on the section."""

import math

import numpy as np

NEAR_M = 1e-9


def pieces(masonry):
    """Heights (z0, z1) between which the section is one trapezoid: a storey of thickness, a taper.

    Its faces are those of `Masonry.faces` at its ends; a gable's is the last.
    """
    eaves = masonry.height_m
    spans = [s[:2] for s in masonry.shape.storeys if not masonry.tapers or s[0] > eaves - NEAR_M]
    spans = [(0.0, eaves), *spans] if masonry.tapers else spans
    return [*spans, (eaves, masonry.top_m)] if masonry.gable_m > NEAR_M else spans


def trapezoid(masonry, low_m, high_m):
    """Corners (y, z) of the section between two heights of one of `pieces`."""
    (y0, y1), (y2, y3) = masonry.faces(low_m), masonry.faces(high_m, above=False)
    return [(y0, low_m), (y1, low_m), (y3, high_m), (y2, high_m)]


def on_elevation(family, candidate):
    """Outlines (x, z) of what takes a part of the width; none of what takes all of it."""
    if candidate.side:
        return [_corner(family, candidate)]
    if candidate.left_m is None:
        return []
    if candidate.middle_m is not None:
        return _hanging(family, candidate)
    low, left, right = candidate.foot_m, candidate.left_m, candidate.right_m
    return [[(left, low), (right, low), *_top(family.masonry, left, right)]]


def _top(masonry, left, right):
    """Upper edge of what stands between two places, from right to left."""
    half, eaves = 0.5 * masonry.width_m, masonry.height_m
    if masonry.gable_m <= NEAR_M:
        return [(right, masonry.top_m), (left, masonry.top_m)]
    places = sorted({left, right, *([0.0] if left < 0.0 < right else [])}, reverse=True)
    return [(x, eaves + masonry.gable_m * (1.0 - abs(x) / half)) for x in places]


def _hanging(family, candidate):
    """Both bodies of horizontal bending."""
    foot, top, middle = candidate.foot_m, candidate.top_m, candidate.middle_m
    outlines = []
    for end in (candidate.left_m, candidate.right_m):
        edge = _top(family.masonry, *sorted((end, middle)))
        edge = edge if end < middle else edge[::-1]
        outlines.append([(middle, foot), *edge, (end, top)])
    return outlines


def _corner(family, candidate):
    """What a corner takes of the elevation, up to its crack (`Masonry.wedge`)."""
    m, foot = family.masonry, candidate.foot_m
    edge = 0.5 * m.width_m * candidate.side
    reach = (m.height_m - foot) * np.tan(np.radians(family.settings["corner_crack_deg"]))
    inner = edge * (1.0 - 2.0 * min(reach / m.width_m, 1.0))
    met = foot + (m.height_m - foot) * min(m.width_m / reach, 1.0)
    return [(edge, foot), (edge, m.height_m), (inner, m.height_m), (inner, met)]


def on_section(family, candidate):
    """Outlines (y, z) of a wedge of the return walls: at rest, and turned with its façade."""
    if not candidate.crack_deg:
        return []
    m, foot = family.masonry, candidate.foot_m
    tangent = math.tan(math.radians(candidate.crack_deg))
    heights = sorted({foot, m.height_m, *(z for z in m.edges_m if foot < z < m.height_m)})
    front, back = [], []
    for a, b in zip(heights, heights[1:], strict=False):
        y = m.faces(0.5 * (a + b))[0]
        front += [(y, a), (y, b)]
        back += [(y - (z - foot) * tangent, z) for z in (a, b)]
    outline = front + back[::-1]
    move = candidate.mechanism.pieces[0][2]
    theta = 0.5 * candidate.mechanism.ultimate()[0]
    return [outline, [tuple(v.real for v in move(point)(theta)) for point in outline]]
