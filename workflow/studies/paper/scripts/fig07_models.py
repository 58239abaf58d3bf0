"""Figure 7: the models at the same instant, coloured by displacement, from YADE's state."""

import json

import numpy as np
from rocking.figures import style
from rocking.figures.panels import panels
from rocking.runtime.script import run
from rocking.tables import read_json
from studies.shared import drawings

SHOWN_D = 0.6  # d/b
COLUMNS = 4  # models side by side, where more than the study's five are drawn


def first_time(frames):
    """When a façade first reaches d/b = 0.6, or else when it comes nearest."""
    d = np.abs(np.array(frames["d_over_b"]))
    return frames["time_s"][int(np.argmax(d >= min(SHOWN_D, d.max())))]


def main(job):
    config = json.loads(job.params.config)
    shown = config["pictures"]
    frames = [read_json(path) for path in job.input.frames]
    instant = shown["time_s"]
    if instant is None:
        instant = min(first_time(f) for f in frames)
    at = [int(np.argmin(np.abs(np.array(f["time_s"]) - instant))) for f in frames]
    walls, k = config["return_wall"]["count"], shown["magnification"]
    h = config["facade"]["height_m"]
    largest = max(
        drawings.faces(f, i, walls, config)[1].max() for f, i in zip(frames, at, strict=True)
    )
    limits = ((-3.4, 3.1), (-0.7, h + 0.9))
    most = COLUMNS + (len(frames) == COLUMNS + 1)  # one more does not go into a row of its own
    figure, axes = panels(len(frames), most, (1.75, 2.6), around=(0.0, 0.3))
    look = drawings.FrameLook(largest, limits, magnification=k)
    for axis, f, i in zip(axes.flat, frames, at, strict=False):
        drawn = drawings.draw(axis, f, i, walls, config, look)
        axis.set_title(f"{f['model']}: d/b = {abs(f['d_over_b'][i]):.2f}")
    bar = figure.colorbar(drawn, ax=axes.ravel().tolist(), shrink=0.6, pad=0.01)
    bar.set_label("displacement relative to the ground [m]")
    head = frames[0]
    sign = style.SIGNS[head["direction"]]
    figure.suptitle(
        f"{head['record']}{sign}, PGA {head['pga_g']:g} g, t = {instant:.2f} s; "
        f"displacements × {k:g}",
        fontsize=8.5,
    )
    style.save(figure, job.output, job.input.facts)


run(main, globals())
