"""Figure 2: translation along y and rotation about z of CBDEM and SBDEM."""

import matplotlib.pyplot as plt
import numpy as np
from rocking.figures import style
from rocking.runtime.script import run
from studies.building import drawing
from studies.building.case import PAPER_PERIODS_S, fitted_model, translation_mode, twist_mode
from studies.building.modes import Modes

LARGEST_M = 0.7  # drawn displacement of the block that moves most


def main(job):
    settings = dict(job.params.building)
    figure, axes = plt.subplots(2, 2, figsize=(7.0, 7.6))
    colours = plt.get_cmap("viridis")
    letters = iter("abcd")
    for row, (name, choose, direction) in enumerate(
        (("translation along y", translation_mode, "y"), ("rotation about z", twist_mode, "rz"))
    ):
        for column, model in enumerate(("CBDEM", "SBDEM")):
            ax = axes[row, column]
            modes = Modes.load(job.input.cbdem if model == "CBDEM" else job.input.sbdem)
            building = fitted_model(settings, job.input.plan, job.input.fit, model)
            mode = choose(modes)
            motion = drawing.block_motion(modes, mode, len(building.scene.blocks))
            size = np.linalg.norm(motion[:, :3], axis=1).max()
            look = {"scale": LARGEST_M / size, "colour_map": colours, "edge_width": 0.08}
            drawing.draw(ax, building, motion=motion, **look)
            title = f"({next(letters)}) {model}, mode {mode + 1}: {name}, "
            title += f"T = {modes.period_s[mode]:.3f} s"
            if job.params.paper:
                title += f" (study {PAPER_PERIODS_S[model, direction]:.2f} s)"
            title += (
                f"\neffective mass along y {modes.effective_ratio[mode, 1]:.2f},"
                f" inertia about z {modes.effective_ratio[mode, 5]:.2f}"
            )
            ax.set_title(title, fontsize=7)
    bar = figure.colorbar(
        plt.cm.ScalarMappable(cmap=colours), ax=axes, shrink=0.4, aspect=30, location="bottom"
    )
    bar.set_label("displacement over the largest [-]")
    style.save(figure, job.output)


run(main, globals())
