"""Drawings to scale: the façade with all its measures, and its weakest mechanism turned."""

import numpy as np
from matplotlib.patches import Polygon, Rectangle

from studies.assess import drawn_bodies, names
from yade_scripts.model.facades import ALONG
from yade_scripts.model.floors import place_of
from yade_scripts.model.ties import rods_at

SMALL = 6.5  # points, of numbers
AROUND_MM, MARGIN_MM = 23.0, 22.0  # paper for numbers: on either side, above and below
SECTION_MM = -42.0, 26.0  # paper of the section, from the inner face


def spread(values, gap, low, high):
    """Places of labels near their ascending values, no nearer than `gap`, within low and high.

    More of them than fit share the room evenly.
    """
    count = len(values)
    gap = min(gap, (high - low) / max(count - 1, 1))
    places = list(values)
    for _ in range(200):
        moved = False
        for k in range(count - 1):
            short = gap - (places[k + 1] - places[k])
            if short > 1e-9:
                places[k], places[k + 1], moved = (
                    places[k] - 0.5 * short,
                    places[k + 1] + 0.5 * short,
                    True,
                )
        places = [
            min(max(v, low + k * gap), high - (count - 1 - k) * gap) for k, v in enumerate(places)
        ]
        if not moved:
            break
    return places


def _levels(axis, at, levels, reach, side, gap, span):
    """Heights beside a drawing: a line from its edge to what is told of each."""
    values = sorted(levels)
    for z, place in zip(values, spread(values, gap, *span), strict=True):
        x = [at, at + 0.35 * side * reach, at + 0.8 * side * reach, at + side * reach]
        axis.plot(x, [z, z, place, place], color="0.55", lw=0.4)
        start = {"ha": "left" if side > 0 else "right", "va": "center", "size": SMALL}
        axis.text(at + 1.05 * side * reach, place, levels[z], **start)


def _places(axis, say, at, values, *room):
    """Places along the width below a drawing, from its left edge; `room`: reach, gap, span."""
    reach, gap, span = room
    values = sorted(values)
    left = values[0]
    for x, place in zip(values, spread(values, gap, *span), strict=True):
        z = [at, at - 0.35 * reach, at - 0.8 * reach, at - reach]
        axis.plot([x, x, place, place], z, color="0.55", lw=0.4)
        told = say.number(x - left, ".2f")
        axis.text(place, at - 1.1 * reach, told, size=SMALL, rotation=90, ha="center", va="top")


def _steps(masonry, z):
    """Whether a face steps at a height."""
    return not np.allclose(masonry.faces(z), masonry.faces(z, above=False))


def _titled(axis, x, z, words):
    """Title within the axes, where no layout cuts it off."""
    axis.text(x, z, words, size=7.5, ha="center", va="bottom")


def _elevation(axis, say, family, candidate, scale):
    """`scale`: metres a millimetre of paper."""
    m, facade = family.masonry, family.facade
    half, h, top = 0.5 * m.width_m, m.height_m, m.top_m
    outline = [(-half, 0.0), (half, 0.0)]
    if m.gable_m > 1e-9:
        outline += [(half, h), (0.0, top), (-half, h)]
    else:
        outline += [(half, top), (-half, top)]
    axis.add_patch(Polygon(outline, fc="0.88", ec="0", lw=1.0))
    for x0, x1, z0, z1 in m.shape.openings:
        axis.add_patch(Rectangle((x0, z0), x1 - x0, z1 - z0, fc="1", ec="0", lw=0.7))
    steps = [z0 for z0, z1 in drawn_bodies.pieces(m)[1:] if z1 <= m.top_m - m.gable_m]
    for z in steps:
        axis.plot([-half, half], [z, z], color="0.4", lw=0.6, ls=":")
    for row in facade.floors:
        axis.plot([-half, half], [row.height_m] * 2, color="0.2", lw=0.8, ls="--")
    for row in facade.ties:
        z = row.height_m
        across = rods_at(row, m.width_m)
        axis.plot(across, [z] * len(across), "x", color="0", ms=4.5, mew=1.3)
    for outline in drawn_bodies.on_elevation(family, candidate):
        axis.add_patch(Polygon(outline, fc="none", ec="0", lw=1.1, ls="--"))
    if family.base_m > 0.0:
        below = (-half, -family.base_m)
        axis.add_patch(Rectangle(below, 2 * half, family.base_m, fc="1", ec="0.5", hatch="//"))
    ground = -family.base_m
    axis.plot([-half - 4 * scale, half + 4 * scale], [ground] * 2, color="0", lw=1.2)
    span = ground, max(top, ground + 3.0 * scale)
    levels: dict[float, list] = {
        0.0: [],
        round(h, 3): ["eaves"] if top > h else [],
        round(top, 3): [],
    }
    for key, heights in (
        ("floor", [row.height_m for row in facade.floors]),
        ("step", [z for z in steps if _steps(m, z)]),
        ("tie", [row.height_m for row in facade.ties]),
        ("ground", [ground] if family.base_m > 0.0 else []),
    ):
        for z in heights:
            if key not in levels.setdefault(round(z, 3), []):
                levels[round(z, 3)].append(key)
    named = {}
    for z, keys in levels.items():
        there = ", ".join(say(f"figure.{key}") for key in keys)
        named[z] = f"{say.number(z, '.2f')} {there}"
    gap = 2.9 * scale
    _levels(axis, -half, named, 5.0 * scale, -1, gap, span)
    edges = {round(z, 3) for o in m.shape.openings for z in o[2:]}
    if edges:
        told = {z: say.number(z, ".2f") for z in edges}
        _levels(axis, half, told, 5.0 * scale, 1, gap, span)
    edges_m = {-half, half, *(round(x, 3) for o in m.shape.openings for x in o[:2])}
    _places(axis, say, ground, edges_m, 4.0 * scale, gap, (-half - 2 * scale, half + 2 * scale))
    _titled(axis, 0.0, top + 3.0 * scale, say("figure.elevation"))


def _section(axis, say, family, candidate, scale):
    m, facade = family.masonry, family.facade
    parts = drawn_bodies.pieces(m)
    for z0, z1 in parts:
        grey, width = ("0.75", 0.9) if z1 <= m.top_m - m.gable_m else ("0.9", 0.7)
        axis.add_patch(Polygon(drawn_bodies.trapezoid(m, z0, z1), fc=grey, ec="0", lw=width))
    for z0, z1, y0, y1 in m.shape.cornices:
        axis.add_patch(Rectangle((y0, z0), y1 - y0, z1 - z0, fc="0.75", ec="0", lw=0.7))
    for _, z in family.thrusts:
        away = {"arrowstyle": "->", "lw": 1.0, "color": "0"}
        y = m.faces(z)[1]
        axis.annotate("", (y + 7 * scale, z), (y, z), arrowprops=away)
    depth = 14 * scale
    axis.add_patch(Rectangle((-depth, 0.0), depth, m.height_m, fc="0.97", ec="0.7", hatch="//"))
    b, top = facade.thickness_m, m.top_m
    ground = -family.base_m
    if family.base_m > 0.0:
        axis.add_patch(Rectangle((-depth, ground), depth + b, family.base_m, fc="1", ec="0.5"))
    axis.plot([-1.2 * depth, b + 16 * scale], [ground] * 2, color="0", lw=1.2)
    if not candidate.side:
        _turned(axis, family, candidate)
    for outline in drawn_bodies.on_section(family, candidate):
        axis.add_patch(Polygon(outline, fc="none", ec="0", lw=0.9, ls="--"))
    edge = family._edge(candidate.foot_m, family.settings["hinge_inset_m"])
    axis.plot(edge, candidate.foot_m, "o", ms=3.5, color="0")
    held: dict[float, list] = {}
    for row in facade.ties:
        z = row.height_m
        axis.plot([-depth, m.faces(z)[1]], [z, z], color="0", lw=1.3)
        held.setdefault(z, []).append(say("figure.tie_of", force_kn=1e-3 * row.rod[1]))
    for row in facade.floors:
        z = place_of(row, m.shape)[2]
        middle = 0.5 * sum(m.faces(z, above=False))
        axis.plot([-depth, middle], [z, z], color="0.2", lw=0.9, ls="--")
        along = row.joists == ALONG
        told = say("figure.floor_along") if along else say("figure.floor_of", load_kn=row.load_kn)
        told += say("figure.anchors", force_kn=row.anchor_kn) if row.anchor_kn else ""
        held.setdefault(z, []).append(told)
    for force, z in family.thrusts:
        held.setdefault(z, []).append(say("figure.thrust_of", force_kn=1e-3 * force))
    values = sorted(held)
    span = ground, max(top, ground + 3.0 * scale)
    for z, place in zip(values, spread(values, 3.2 * scale, *span), strict=True):
        axis.plot([-depth, -1.15 * depth], [z, place], color="0.55", lw=0.4)
        axis.text(-1.2 * depth, place, ", ".join(held[z]), size=SMALL, ha="right", va="center")
    _places(axis, say, ground, {0.0, b}, 4.0 * scale, 2.9 * scale, (-4 * scale, b + 4 * scale))
    line, told = {"arrowstyle": "-", "lw": 0.4, "color": "0.55"}, ""
    for z, at_m in _measured(m, parts):
        y0, y1 = m.faces(at_m, above=False)
        told, before = say("figure.thick", thickness_m=y1 - y0), told
        if told == before:
            continue
        at, place = (0.5 * (y0 + y1), z), (y1 + 9 * scale, z)
        axis.annotate(told, at, place, size=SMALL, va="center", arrowprops=line)
    _titled(axis, 0.5 * sum(SECTION_MM) * scale, top + 3.0 * scale, say("figure.section"))


def _measured(masonry, parts):
    """Heights at which a thickness is said, and of which: of every part, both ends of a taper."""
    middles = [(0.5 * (z0 + z1),) * 2 for z0, z1 in parts if z1 <= masonry.top_m - masonry.gable_m]
    if not masonry.tapers:
        return middles
    h = masonry.height_m
    return [(0.1 * h, 0.0), (0.9 * h, h), *middles[1:]]


def _turned(axis, family, candidate):
    """Section of a mechanism at half of the rotation at which its multiplier vanishes."""
    masonry, theta = family.masonry, 0.5 * candidate.mechanism.ultimate()[0]
    for low, high, move in family.pieces(candidate):
        for z0, z1 in drawn_bodies.pieces(masonry):
            a, c = max(z0, low), min(z1, high)
            if c - a < 1e-6:
                continue
            ends = drawn_bodies.trapezoid(masonry, a, c)
            turned = [tuple(v.real for v in move(end)(theta)) for end in ends]
            axis.add_patch(Polygon(turned, fc="none", ec="0", lw=0.9, ls="--"))


def scale_of(family, wide_mm, high_mm):
    """Metres of the façade a millimetre of paper, at which it fits with all its numbers."""
    m, beside = family.masonry, 2 * AROUND_MM + SECTION_MM[1] - SECTION_MM[0]
    tall = m.top_m + family.base_m
    return max(tall / (high_mm - MARGIN_MM), m.width_m / (wide_mm - beside))


def height_mm(family, wide_mm, high_mm):
    """Paper that the drawing takes, at most `high_mm`: a wide façade needs less."""
    tall = family.masonry.top_m + family.base_m
    return min(high_mm, tall / scale_of(family, wide_mm, high_mm) + MARGIN_MM)


def facade(say, family, candidate, paper_mm, figure):
    """Elevation with openings, floors (dashed) and ties (crosses), and the section beside it.

    The mechanism is drawn turned by half of the rotation at which its multiplier vanishes; the
    paper is so wide and at most so high [mm], and one scale serves both drawings.
    """
    m = family.masonry
    scale = scale_of(family, *paper_mm)
    ends = (
        (-0.5 * m.width_m - AROUND_MM * scale, 0.5 * m.width_m + AROUND_MM * scale),
        (SECTION_MM[0] * scale, SECTION_MM[1] * scale),
    )
    axes = figure.subplots(1, 2, width_ratios=[b - a for a, b in ends])  # at one scale
    _elevation(axes[0], say, family, candidate, scale)
    _section(axes[1], say, family, candidate, scale)
    for axis, end in zip(axes, ends, strict=True):
        axis.set_aspect("equal")
        axis.set_ylim(-family.base_m - 12.0 * scale, m.top_m + 8.0 * scale)
        axis.set_xlim(*end)
        axis.set_axis_off()


def words(say, family, candidate):
    """What the drawing shows, in words."""
    m = family.masonry
    gable = say("figure.to_eaves", gable_m=m.gable_m) if m.gable_m > 1e-9 else ""
    return say(
        "figure.words",
        width_m=m.width_m,
        height_m=m.height_m,
        gable=gable,
        thickness_m=family.facade.thickness_m,
        openings=say.count("figure.openings", len(m.shape.openings)),
        ties=say.count("figure.ties", len(family.facade.ties)),
        name=names.name(candidate, say),
    )
