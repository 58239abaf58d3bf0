"""Map of the observed over the predicted critical step, over damping and stiffness."""

import pandas as pd
from rocking.figures import style
from rocking.figures.panels import heat_map, panels
from rocking.runtime.script import run

TITLES = {"stack": "stack of ten blocks"}


def main(job):
    limits = pd.read_csv(job.input.limits)
    limits["damping_ms"] = 1e3 * limits["beta_s"]
    scenes = list(dict.fromkeys(limits["scene"]))
    figure, axes = panels(len(scenes), len(scenes), (3.0, 3.2), around=(0.8, 0.0), sharey=True)
    for axis, scene in zip(axes.flat, scenes, strict=True):
        part = limits[limits["scene"] == scene]
        grid = part.pivot(index="damping_ms", columns="stiffness_factor")
        steps = grid["dt_crit_observed_s"].map("{:.2g}".format)
        off = 100.0 * (grid["ratio"] - 1.0)
        image = heat_map(axis, off, steps, cmap="RdBu_r", vmin=-5.0, vmax=5.0)
        axis.set(title=TITLES.get(scene, scene), xlabel="stiffness factor [-]")
    axes[0, 0].set_ylabel("damping β [ms]")
    figure.colorbar(image, ax=axes, label="observed − predicted critical step [%]")
    figure.suptitle("in each field: observed critical step [s]", fontsize=8)
    style.save(figure, job.output)


run(main, globals())
