"""Draws docs/pictures/models.svg: what drives what, what can be pushed and what is glued.

    python docs/drawings/models.py

A side view of each model, outward to the left. The page docs/models.md explains it in words.
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.patches import FancyArrowPatch, Patch, Rectangle

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT)]

from yade_scripts.model.registry import COMPLETE, MODELS  # noqa: E402

PICTURE = ROOT / "docs" / "pictures" / "models.svg"
HEIGHT, THICKNESS, DEPTH, GAP, FLOORS = 4.0, 0.5, 1.1, 0.06, 4
FACADE, DRIVEN, CARRIED, GLUE, GROUND = "#C9826B", "#AEB8C2", "#7FB3D5", "#222222", "#D55E00"
TITLES = {
    "W1": "walls move with the ground",
    "W1c": "… and the joint is bonded",
    "W2": "each wall block moves with its floor",
    "W2c": "… and the joint is bonded",
    "W3": "bricks interlock, floors drive them",
    "W2m": "wall blocks carry the building's mass",
    "W3m": "bricks interlock and carry the mass",
    "CB": "every brick, only the ground driven",
}


def arrow(axis, x, y, length=0.55, colour=GROUND):
    """Double arrow: a motion that is prescribed."""
    style = {"zorder": 4, "arrowstyle": "<|-|>", "mutation_scale": 7, "color": colour, "lw": 1.2}
    axis.add_patch(FancyArrowPatch((x - length / 2, y), (x + length / 2, y), **style))


def spring(axis, x, low, high):
    """Zigzag between two storeys: a spring and a dashpot of the chain."""
    n = 7
    ys = [low + (high - low) * k / n for k in range(n + 1)]
    xs = [x] + [x + (0.09 if k % 2 else -0.09) for k in range(1, n)] + [x]
    axis.plot(xs, ys, color="#1F4E79", lw=1.0, solid_joinstyle="round")


def block(axis, x, y, width, height, colour, **more):
    """One rigid block."""
    axis.add_patch(Rectangle((x, y), width, height, fc=colour, ec="0.25", lw=0.7, **more))


def walls(axis, kind):
    """Return wall of a model: one block, one a floor, or interlocking bricks."""
    left = THICKNESS + GAP
    colour = CARRIED if kind.two_way else DRIVEN
    storey = HEIGHT / FLOORS
    if kind.walls == "one":
        block(axis, left, 0.0, DEPTH, HEIGHT, colour)
        arrow(axis, left + DEPTH / 2, HEIGHT / 2)
    if kind.walls == "floors":
        for k in range(FLOORS):
            block(axis, left, k * storey, DEPTH, storey, colour)
    if kind.walls == "bricks":
        courses = 20
        high = HEIGHT / courses
        for k in range(courses):
            reach = left + 0.3 * DEPTH if k % 2 else left  # of the façade's header into the wall
            block(axis, reach, k * high, left + DEPTH - reach, high, colour)
            if k % 2:
                block(axis, THICKNESS, k * high, reach - THICKNESS, high, FACADE, zorder=3)
    if kind.walls in ("floors", "bricks") and not kind.two_way:
        for k in range(FLOORS):
            arrow(axis, left + 0.58 * DEPTH, (k + 0.5) * storey, 0.4 + 0.14 * k)
    if kind.two_way:
        at = left + DEPTH + 0.3
        for k in range(FLOORS):
            low = (k - 0.5) * storey if k else 0.0
            spring(axis, at, low, (k + 0.5) * storey)
            axis.plot([left + DEPTH, at], [(k + 0.5) * storey] * 2, color="#1F4E79", lw=0.8)
            axis.plot(at, (k + 0.5) * storey, "o", color="#1F4E79", ms=5)
    if kind.bonded:
        axis.plot([THICKNESS + GAP / 2] * 2, [0, HEIGHT], color=GLUE, lw=3.2)


def building(axis):
    """Every brick of the building behind a cracked façade."""
    left, courses = THICKNESS + GAP, 12
    high = HEIGHT / courses
    for k in range(courses):
        offset = 0.0 if k % 2 else -0.16
        x = left
        edges = [left + 0.32 * j + offset for j in range(1, 7)]
        for edge in [e for e in edges if left < e < left + 1.75] + [left + 1.75]:
            block(axis, x, k * high, edge - x, high, CARRIED)
            x = edge
    for level in (0.5, 1.0):
        block(axis, left + 0.1, level * HEIGHT - 0.1, 1.75, 0.1, "#1F4E79")


def panel(axis, name):
    """One model."""
    kind = MODELS.get(name) or COMPLETE[name]
    block(axis, -0.6, -0.32, 3.4, 0.3, "0.85")
    block(axis, 0.0, 0.0, THICKNESS, HEIGHT, FACADE, zorder=2)
    building(axis) if kind.walls == "building" else walls(axis, kind)
    if kind.walls == "bricks":
        axis.add_patch(Rectangle((0, 0), THICKNESS, HEIGHT, fill=False, ec="0.25", lw=0.7))
    arrow(axis, 0.9, -0.55, 0.9)
    axis.set(xlim=(-0.8, 3.0), ylim=(-0.95, HEIGHT + 0.25), aspect="equal")
    axis.set_axis_off()
    axis.set_title(f"{name}\n{TITLES[name]}", fontsize=8.5)


def main():
    """Draw the picture."""
    plt.rcParams.update({"svg.hashsalt": "models", "svg.fonttype": "path"})
    figure, axes = plt.subplots(2, 4, figsize=(10, 6.6))
    for axis, name in zip(axes.flat, TITLES, strict=True):
        panel(axis, name)
    handles = [
        Patch(fc=FACADE, ec="0.25", label="façade: moves freely"),
        Patch(fc=DRIVEN, ec="0.25", label="motion prescribed: cannot be pushed"),
        Patch(fc=CARRIED, ec="0.25", label="has mass: can be pushed"),
        plt.Line2D([], [], color=GLUE, lw=3.2, label="bonded until it breaks"),
        plt.Line2D([], [], color=GROUND, marker="<", lw=1.2, ms=5, label="prescribed motion"),
        plt.Line2D([], [], color="#1F4E79", marker="o", lw=1.2, ms=5, label="mass on its springs"),
    ]
    figure.legend(handles=handles, ncols=3, loc="lower center", frameon=False, fontsize=9)
    figure.subplots_adjust(0.01, 0.1, 0.99, 0.93, 0.05, 0.2)
    PICTURE.parent.mkdir(exist_ok=True)
    figure.savefig(PICTURE, metadata={"Date": None})


if __name__ == "__main__":
    main()
