"""Map of the observed over the predicted critical step, over damping and stiffness."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking.figures import style
from rocking.runtime.script import run


def main(job):
    limits = pd.read_csv(job.input.limits)
    scenes = list(dict.fromkeys(limits["scene"]))
    figure, axes = plt.subplots(
        1,
        len(scenes),
        figsize=(3.0 * len(scenes) + 0.8, 3.2),
        sharey=True,
        squeeze=False,
        layout="constrained",
    )
    for axis, scene in zip(axes[0], scenes, strict=True):
        part = limits[limits["scene"] == scene]
        grid = part.pivot(index="beta_s", columns="stiffness_factor", values="ratio")
        image = axis.imshow(
            100.0 * (grid.to_numpy() - 1.0),
            origin="lower",
            aspect="auto",
            cmap="RdBu_r",
            vmin=-5.0,
            vmax=5.0,
        )
        steps = part.pivot(
            index="beta_s", columns="stiffness_factor", values="dt_crit_observed_s"
        ).to_numpy()
        for (i, j), step in np.ndenumerate(steps):
            axis.text(j, i, f"{step:.2g}", ha="center", va="center", fontsize=6)
        axis.set_xticks(range(grid.shape[1]), [f"{v:.2g}" for v in grid.columns])
        axis.set_yticks(range(grid.shape[0]), [f"{1e3 * v:.3g}" for v in grid.index])
        axis.grid(False)
        title = {"stack": "stack of ten blocks"}.get(scene, scene)
        axis.set(title=title, xlabel="stiffness factor (-)")
    axes[0, 0].set_ylabel("damping β (ms)")
    figure.colorbar(image, ax=axes, label="observed − predicted critical step (%)")
    style.save(figure, job.output)


run(main, globals())
