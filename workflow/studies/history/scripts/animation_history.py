"""Animation of a history, from YADE's state, with the façade's displacement beside it (GIF)."""

import json

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation, PillowWriter
from rocking.figures import style
from rocking.runtime.script import run
from rocking.tables import read_json
from studies.shared import drawings

from yade_scripts.model.registry import MODELS

LONGEST_FRAMES = 160


def window(frames):
    """Frames worth showing: from before the façade first leaves the wall to its fall."""
    d = np.abs(np.array(frames["d_over_b"]))
    moving = np.flatnonzero(d > 0.02)
    first = max(0, (moving[0] if len(moving) else 0) - 10)
    last = len(d)
    each = max(1, int(np.ceil((last - first) / LONGEST_FRAMES)))
    return list(range(first, last, each))


def main(job):
    config = json.loads(job.params.config)
    frames = read_json(job.input.frames)
    time_s, d = np.array(frames["time_s"]), np.array(frames["d_over_b"])
    shown = window(frames)
    walls, h = config["return_wall"]["count"], config["facade"]["height_m"]
    look = drawings.FrameLook(config["facade"]["thickness_m"], ((-3.4, 4.6), (-0.7, h + 0.9)))
    figure, (left, right) = plt.subplots(1, 2, figsize=(6.4, 4.0), width_ratios=(1.35, 1.0), dpi=90)
    right.plot(time_s, d, color=style.GREY, lw=0.8)
    right.axhline(1.0, color="k", ls=":", lw=0.8)
    (line,) = right.plot([], [], color=MODELS[frames["model"]].colour)
    (dot,) = right.plot([], [], "o", color=MODELS[frames["model"]].colour)
    right.set(
        xlim=(time_s[shown[0]], time_s[shown[-1]]),
        xlabel="time [s]",
        ylabel="top displacement d/b [-]",
        ylim=(-0.1, 1.1 * d.max()),
    )
    sign = style.SIGNS[frames["direction"]]
    figure.suptitle(f"{frames['model']}, {frames['record']}{sign}, PGA {frames['pga_g']:.3g} g")

    def update(k):
        i = shown[k]
        left.clear()
        drawings.draw(left, frames, i, walls, config, look)
        left.set_title(f"t = {time_s[i]:.2f} s, d/b = {d[i]:.2f}")
        line.set_data(time_s[: i + 1], d[: i + 1])
        dot.set_data([time_s[i]], [d[i]])
        return line, dot

    figure.supxlabel(style.origins(job.input.facts, 6.4), fontsize=6.5)
    movie = FuncAnimation(figure, update, frames=len(shown), blit=False)
    movie.save(job.output[0], writer=PillowWriter(fps=20), dpi=90)
    plt.close(figure)


run(main, globals())
