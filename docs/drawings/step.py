"""Draws docs/pictures/step.svg: what one step of the compiled planar solver does.

    python docs/drawings/step.py

Left the façade and what acts on it, right the same step in time. The page docs/solver.md explains
it in words; the numbers in circles are those of its list.
"""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import FancyArrowPatch, Polygon, Rectangle

PICTURE = Path(__file__).resolve().parents[1] / "pictures" / "step.svg"
FACADE, WALL, CHAIN, FORCE, GROUND = "#C9826B", "#7FB3D5", "#1F4E79", "#D55E00", "0.85"
HEIGHT, THICKNESS, TILT, NODES = 4.0, 0.7, 0.075, 9


def arrow(axis, start, end, colour="0.2", bend=0.0, **more):
    """Arrow from one point to another."""
    style = {"arrowstyle": "-|>", "mutation_scale": 9, "lw": 1.2, "shrinkA": 0, "shrinkB": 0}
    bow = f"arc3,rad={bend}"
    axis.add_patch(FancyArrowPatch(start, end, color=colour, connectionstyle=bow, **(style | more)))


def number(axis, x, y, text):
    """A step of the list, in a circle."""
    mark = {"boxstyle": "circle,pad=0.2", "fc": "white", "ec": "0.2", "lw": 0.9}
    axis.text(x, y, text, ha="center", va="center", fontsize=8, bbox=mark, zorder=9)


def turned(points):
    """Points of the façade, which turns outward, to the left, about its outer edge."""
    cos, sin = np.cos(TILT), np.sin(TILT)
    return np.asarray(points) @ np.array([[cos, sin], [-sin, cos]])


def joint(axis, places, depth, along, normal):
    """Nodes of a joint: open ones hollow, those that touch with their forces."""
    for place, deep in zip(places, depth, strict=True):
        touches = deep > 0.0
        axis.plot(
            *place, "o", ms=3.6, mfc=FORCE if touches else "white", mec="0.2", mew=0.7, zorder=6
        )
        if touches:
            size = 0.12 + 6.0 * deep
            arrow(axis, place - size * normal, place, FORCE, lw=0.9, mutation_scale=6, zorder=5)
    ends = places[[0, -1]] + 0.16 * along * np.array([[-1.0], [1.0]])
    axis.plot(*ends.T, color="0.35", lw=0.8, ls=":", zorder=4)


def spring(axis, x, low, high):
    """Zigzag between two masses."""
    ys = np.linspace(low, high, 9)
    xs = x + 0.08 * np.array([0, 0, 1, -1, 1, -1, 1, 0, 0])
    axis.plot(xs, ys, color=CHAIN, lw=1.0)


def in_space(axis):
    """Façade, joints, a tie, wall blocks on the masses of a chain."""
    axis.add_patch(Rectangle((-0.6, -0.3), 4.3, 0.3, fc=GROUND, ec="none"))
    arrow(axis, (1.2, -0.16), (1.9, -0.16), "0.2")
    axis.text(2.0, -0.16, "ground", va="center", fontsize=7.5)
    body = [(0, 0), (THICKNESS, 0), (THICKNESS, HEIGHT), (0, HEIGHT)]
    axis.add_patch(Polygon(turned(body), fc=FACADE, ec="0.25", lw=0.8))
    base = turned([(x, 0.0) for x in np.linspace(0.0, THICKNESS, NODES)])
    joint(axis, base, 0.02 - base[:, 1], np.array([1.0, 0.0]), np.array([0.0, -1.0]))
    centre = turned([(THICKNESS / 2, HEIGHT / 2)])[0]
    arrow(axis, centre, centre - (0.0, 0.75), "0.15")
    axis.text(centre[0] + 0.04, centre[1] - 0.85, "weight", fontsize=7, ha="center", va="top")
    for k in range(2):
        low, back = 2.0 * k, 0.74 + 0.05 * k
        axis.add_patch(Rectangle((back, low + 0.04), 1.1, 1.9, fc=WALL, ec="0.25", lw=0.8))
        heights = np.linspace(low + 0.1, low + 1.88, NODES)
        places = np.stack([np.full(NODES, back), heights], axis=1)
        face = THICKNESS * np.cos(TILT) - heights * np.sin(TILT)
        joint(axis, places, face - back + 0.015, np.array([0.0, 1.0]), np.array([-1.0, 0.0]))
        axis.plot([back + 1.1, 2.5], [low + 1.0] * 2, color=CHAIN, lw=0.9)
        axis.plot(2.5, low + 1.0, "o", color=CHAIN, ms=8)
        spring(axis, 2.5, 0.0 if k == 0 else 1.0, low + 1.0)
    tie = turned([(THICKNESS, 3.75)])[0]
    axis.plot([tie[0], 0.79], [tie[1], 3.72], color="0.15", lw=1.4, zorder=7)
    for x, y, text in ((2.84, 2.05, "1"), (-0.32, 2.6, "2"), (0.28, -0.5, "3"), (0.62, 4.3, "3")):
        number(axis, x, y, text)
    number(axis, centre[0] - 0.1, centre[1] + 0.3, "4")
    axis.text(2.72, 2.35, "masses that\ncarry the walls\nfeel them", fontsize=7.5)
    axis.text(
        0.5, -0.5, "nodes that touch push;\nopen ones are passed over", va="center", fontsize=7.5
    )
    axis.text(0.8, 4.3, "ties, floors", va="center", fontsize=7.5)
    axis.set(xlim=(-0.9, 3.8), ylim=(-0.8, 4.6), aspect="equal")
    axis.axis("off")


def in_time(axis):
    """Leapfrog: places at whole steps, rates between."""
    rows = {"place": 3.0, "rate": 2.0, "acceleration": 1.0}
    for name, y in rows.items():
        axis.axhline(y, color="0.85", lw=0.8, zorder=0)
        axis.text(-1.45, y, name, va="center", ha="right", fontsize=8)
    for x, text in ((-1, "k − 1"), (0, "k"), (1, "k + 1")):
        axis.axvline(x, color="0.9", lw=0.8, zorder=0)
        axis.text(x, 3.45, text, ha="center", fontsize=8)
        axis.plot(x, 3.0, "o", color=FACADE, ms=9, mec="0.25")
    for x in (-0.5, 0.5):
        axis.plot(x, 2.0, "s", color=FACADE, ms=8, mec="0.25")
    axis.plot(0, 2.0, "s", mfc="white", mec="0.25", ms=8)
    axis.plot([-1, 0], [1, 1], "^", color=FACADE, ms=9, mec="0.25")
    arrow(axis, (-0.5, 2.0), (-0.1, 2.0), bend=-0.4)
    arrow(axis, (-0.93, 1.07), (-0.07, 1.9), "0.55")
    number(axis, -0.3, 2.28, "2")
    arrow(axis, (0.05, 2.85), (0.05, 1.15), FORCE, bend=-0.28)
    number(axis, 0.42, 2.42, "3")
    arrow(axis, (0.0, 1.88), (0.0, 1.16), FORCE)
    number(axis, -0.2, 1.5, "4")
    arrow(axis, (-0.42, 1.93), (0.4, 1.93), bend=0.45)
    arrow(axis, (0.08, 1.05), (0.47, 1.84), "0.55")
    arrow(axis, (0.52, 2.12), (0.95, 2.88), bend=-0.2)
    arrow(axis, (0.12, 3.0), (0.87, 3.0), bend=-0.3)
    number(axis, 0.88, 2.35, "6")
    axis.text(0.0, 0.62, "(M + ½hC) a = f + ½hC a⁻", ha="center", fontsize=8.5)
    axis.text(0.0, 0.36, "hollow: predicted by the last acceleration", ha="center", fontsize=7.5)
    for lane in range(8):
        axis.add_patch(
            Rectangle((-1.0 + 0.25 * lane, -0.3), 0.21, 0.3, fc=FACADE, ec="0.25", lw=0.6)
        )
    axis.text(
        0.0, -0.5, "each number is eight: eight amplitudes of one motion", ha="center", fontsize=7.5
    )
    number(axis, 1.25, -0.15, "5")
    axis.text(1.38, -0.15, "who fell\nor rests\nstops", va="center", fontsize=7.5)
    axis.set(xlim=(-2.4, 1.9), ylim=(-0.75, 3.7))
    axis.axis("off")


def main():
    """Draw the picture."""
    plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "step", "font.size": 8})
    figure, (space, time) = plt.subplots(1, 2, figsize=(9.0, 4.4), layout="constrained")
    in_space(space)
    in_time(time)
    figure.savefig(PICTURE, metadata={"Date": None})


if __name__ == "__main__":
    main()
