"""Drawings to scale: the façade with openings and ties, and its weakest mechanism turned."""

import numpy as np
from matplotlib.patches import FancyArrowPatch, Polygon, Rectangle

from yade_scripts.model.floors import place_of
from yade_scripts.model.holds import rod

PAPER = {"fc": "1", "ec": "none", "pad": 0.8}  # behind words that lie on lines


def _dimension(axis, start, end, words, offset=(0.0, 0.0), **style):
    arrow = FancyArrowPatch(start, end, arrowstyle="<->", mutation_scale=7, lw=0.7, color="0.2")
    axis.add_patch(arrow)
    middle = 0.5 * (np.add(start, end)) + np.array(offset)
    axis.text(*middle, words, size=7, ha="center", va="center", **style)


def _elevation(axis, family, candidate):
    m, section = family.masonry, family.section
    half, h, top = 0.5 * m.width_m, m.height_m, m.top_m
    outline = [(-half, 0.0), (half, 0.0)]
    if m.gable_m > 1e-9:
        outline += [(half, h), (0.0, top), (-half, h)]
    else:
        outline += [(half, top), (-half, top)]
    axis.add_patch(Polygon(outline, fc="0.88", ec="0", lw=1.1))
    for x0, x1, z0, z1 in m.shape.openings:
        axis.add_patch(Rectangle((x0, z0), x1 - x0, z1 - z0, fc="1", ec="0", lw=0.8))
    for z0, *_ in m.shape.storeys[1:]:
        axis.plot([-half, half], [z0, z0], color="0.4", lw=0.6, ls=":")
    for row in section["ties"]:
        z = row["height_m"]
        across = np.linspace(-0.8 * half, 0.8 * half, row["count"]) if row["count"] > 1 else [0.0]
        axis.plot(across, [z] * len(across), "x", color="0", ms=5, mew=1.4)
    for row in section["floors"]:
        axis.plot([-half, half], [row["height_m"]] * 2, color="0.2", lw=0.9, ls="--")
    if "corner" in candidate.name:
        corner = _corner(family, candidate)
        axis.add_patch(Polygon(corner, fc="none", ec="0", lw=1.1, ls="--"))
    if family.base_m > 0.0:
        axis.add_patch(
            Rectangle(
                (-half, -family.base_m), 2 * half, family.base_m, fc="1", ec="0.5", hatch="//"
            )
        )
    ground = -family.base_m
    axis.plot([-1.2 * half, 1.2 * half], [ground] * 2, color="0", lw=1.4)
    _dimension(
        axis,
        (-half, ground - 0.06 * top),
        (half, ground - 0.06 * top),
        f"w = {m.width_m:g} m",
        (0.0, -0.05 * top),
    )
    axis.set_title("elevation", size=8)


def _corner(family, candidate):
    """Outline of what a corner takes of the elevation, up to its crack (`Masonry.wedge`)."""
    m, foot = family.masonry, candidate.foot_m
    edge = 0.5 * m.width_m * (-1.0 if candidate.name.startswith("left") else 1.0)
    reach = (m.height_m - foot) * np.tan(np.radians(family.settings["corner_crack_deg"]))
    inner = edge * (1.0 - 2.0 * min(reach / m.width_m, 1.0))
    met = foot + (m.height_m - foot) * min(m.width_m / reach, 1.0)
    return [(edge, foot), (edge, m.height_m), (inner, m.height_m), (inner, met)]


def _section(axis, family, candidate):
    m, section = family.masonry, family.section
    for z0, z1, y0, y1 in m.shape.storeys:
        axis.add_patch(Rectangle((y0, z0), y1 - y0, z1 - z0, fc="0.75", ec="0", lw=0.9))
    if m.gable_m > 1e-9:
        y0, y1 = m.shape.storeys[-1][2:]
        axis.add_patch(Rectangle((y0, m.height_m), y1 - y0, m.gable_m, fc="0.9", ec="0", lw=0.7))
    depth = 0.16 * m.top_m
    axis.add_patch(Rectangle((-depth, 0.0), depth, m.height_m, fc="0.95", ec="0.6", hatch="//"))
    b, top = section["thickness_m"], m.top_m
    ground = -family.base_m
    if family.base_m > 0.0:
        axis.add_patch(Rectangle((-depth, ground), depth + b, family.base_m, fc="1", ec="0.5"))
    axis.plot([-1.3 * depth, b + 0.35 * top], [ground] * 2, color="0", lw=1.4)
    theta = 0.5 * candidate.mechanism.ultimate()[0]
    corner = "corner" in candidate.name
    for low, high, move in () if corner else candidate.mechanism.pieces:
        for z0, z1, y0, y1 in [*m.shape.storeys, (m.height_m, top, *m.shape.storeys[-1][2:])]:
            a, c = max(z0, low), min(z1, high)
            if c - a < 1e-6:
                continue
            ends = [(y0, a), (y1, a), (y1, c), (y0, c)]
            turned = [tuple(v.real for v in move(end)(theta)) for end in ends]
            axis.add_patch(Polygon(turned, fc="none", ec="0", lw=0.9, ls="--"))
    edge = family._edge(candidate.foot_m, family.settings["hinge_inset_m"])
    axis.plot(edge, candidate.foot_m, "o", ms=4, color="0")
    for row in section["ties"]:
        z = row["height_m"]
        back, front = m.faces(z)
        axis.plot([-depth, front], [z, z], color="0", lw=1.3)
        words = f"{1e-3 * rod(row)[1]:.3g} kN"
        axis.text(front + 0.02 * top, z, words, size=6.5, va="center", bbox=PAPER)
    for row in section["floors"]:
        y = place_of(row, m.shape)[1]
        axis.annotate(
            f"{row['load_kn']:g} kN",
            (y, row["height_m"]),
            (y - 0.05 * top, row["height_m"] + 0.06 * top),
            size=6.5,
            ha="right",
            bbox=PAPER,
            arrowprops={"arrowstyle": "->", "lw": 0.7},
        )
    right = b + 0.33 * top
    _dimension(axis, (right, 0.0), (right, top), f"{top:g} m", (0.06 * top, 0.0), rotation=90)
    below = ground - 0.06 * top
    _dimension(axis, (0.0, below), (b, below), f"b = {b:g} m", (0.0, -0.05 * top))
    axis.set_title("section", size=8)


def facade(family, candidate):
    """Elevation with openings, floors (dashed) and ties (crosses), and the section beside it.

    Parameters
    ----------
    family : rocking.assessment.family.Family
    candidate : rocking.assessment.family.Candidate
        Drawn turned by half of the rotation at which its multiplier vanishes.
    """

    def draw(figure):
        m = family.masonry
        wide = max(1.3 * m.width_m, 0.3 * m.top_m)
        start, end = -0.22 * m.top_m, section_end(family)
        axes = figure.subplots(1, 2, width_ratios=(wide, end - start))  # at one scale
        _elevation(axes[0], family, candidate)
        _section(axes[1], family, candidate)
        low = -family.base_m - 0.16 * m.top_m
        for axis in axes:
            axis.set_aspect("equal")
            axis.set_ylim(low, 1.08 * m.top_m)
            axis.set_axis_off()
        axes[0].set_xlim(-0.5 * wide, 0.5 * wide)
        axes[1].set_xlim(start, end)

    return draw


def section_end(family):
    """Right end of the section's axis."""
    return family.section["thickness_m"] + 0.45 * family.masonry.top_m


def words(family, candidate):
    """What the drawing shows, in words."""
    m = family.masonry
    openings, ties = len(m.shape.openings), len(family.section["ties"])
    gable = f" to the eaves, gable {m.gable_m:g} m" if m.gable_m > 1e-9 else ""
    return (
        f"Façade {m.width_m:g} m wide, {m.height_m:g} m high{gable}, "
        f"{family.section['thickness_m']:g} m thick at its base, "
        f"{openings} opening{'' if openings == 1 else 's'}, "
        f"{ties} row{'' if ties == 1 else 's'} of ties; weakest mechanism: {candidate.name}."
    )
