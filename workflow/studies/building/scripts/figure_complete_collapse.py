"""The façade comes away from the complete building: side views of one run, as YADE computed it."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from rocking.figures import style
from rocking.runtime.script import run
from rocking.tables import read_json
from studies.building.drawing import JOINT, MASONRY
from studies.shared.drawings import outline

VIEWS = (0.0, 0.25, 0.6, 1.0)  # of the largest d/b
FACADE = "façade"
BOX = ("centre_m", "size_m")
GREY = (0.62, 0.66, 0.72)


def main(job):
    frames = read_json(job.input.frames)
    blocks, d = frames["blocks"], np.array(frames["d_over_b"])
    free = [i for i, block in enumerate(blocks) if block["free"]]
    near = max(blocks[i]["centre_m"][0] + 0.5 * blocks[i]["size_m"][0] for i in free)
    wall = [
        i
        for i in free
        if blocks[i]["name"] != FACADE
        and blocks[i]["centre_m"][0] + 0.5 * blocks[i]["size_m"][0] > near - 0.05
    ]
    facade = next(i for i in free if blocks[i]["name"] == FACADE)
    last = int(np.argmax(np.abs(d)))
    chosen = [int(np.argmax(np.abs(d[: last + 1]) >= v * abs(d[last]))) for v in VIEWS]
    figure, axes = plt.subplots(1, len(chosen), figsize=(7.2, 2.3), sharey=True)
    for axis, frame in zip(axes, chosen, strict=True):
        moved = frames["moved"][frame]
        for indices, colour in ((wall, MASONRY), ([facade], GREY)):
            shapes = [outline(*(blocks[i][k] for k in BOX), moved[i]) for i in indices]
            look = {"facecolors": [colour], "edgecolors": [JOINT], "linewidths": 0.3}
            axis.add_collection(PolyCollection(shapes, **look))
        axis.axhline(0.0, color="0.3", lw=0.8)
        axis.set(
            xlim=(-0.4, 8.2),
            ylim=(-0.3, 7.0),
            aspect="equal",
            xlabel="y [m]",
            title=f"t = {frames['time_s'][frame]:.2f} s\nd/b = {abs(d[frame]):.2f}",
        )
    axes[0].set_ylabel("z [m]")
    source = style.provenance(read_json(job.input.facts))
    case = f"{frames['model']}, {job.wildcards.record} {job.wildcards.direction}"
    figure.suptitle(f"{case}, {frames['pga_g']:.3g} g: {source}", fontsize=8)
    style.save(figure, job.output, job.input.facts)


run(main, globals())
