"""Sensitivity of W3's static capacity: λ0 in YADE and of the kinematic curve, by variant."""

import matplotlib.pyplot as plt
from rocking.figures import style
from rocking.figures.panels import ticks
from rocking.runtime.script import run
from rocking.tables import read_frame

from yade_scripts.model.registry import MODELS

GROUPS = (
    ("header", "header joint"),
    ("study", "the study's rule"),
    ("lower", "inclined joints"),
    ("overlap", "overlap"),
    ("friction", "friction"),
    ("joints", "joint stiffness"),
    ("course", "course height"),
    ("numerical", "numerical band"),
)
NUMERICAL = ("half_step", "nodes_9", "nodes_33", "half_speed", "full_model")


def group_of(name):
    """Group of a variant, by the first word of its name."""
    if name in NUMERICAL:
        return "numerical"
    return name.split("_")[0]


def main(job):
    table = read_frame(job.input.table)
    table = table[table["case"].str.startswith("W3 ")].copy()
    table["name"] = table["case"].str[3:]
    default = table[table["name"] == "default"].iloc[0]
    figure, axis = plt.subplots(figsize=(6.2, 5.6))
    y, places, labels = 0.0, [], []
    for key, title in GROUPS:
        rows = table[[group_of(n) == key for n in table["name"]]]
        if rows.empty:  # no such course fills the façade
            continue
        y -= 0.6
        look = {"fontsize": 7.5, "fontweight": "bold", "backgroundcolor": "white"}
        axis.text(0.155, y, title, va="center", **look)
        for _, row in rows.iterrows():
            y -= 1.0
            ends = row[["lambda0_kinematic", "lambda0_dem"]]
            axis.plot(ends, [y, y], color=style.GREY, lw=1)
            axis.plot(row["lambda0_dem"], y, "o", color=MODELS["W3"].colour)
            axis.plot(row["lambda0_kinematic"], y, "|", color="k", ms=9, mew=1.5)
            places.append(y)
            labels.append(row["name"].removeprefix(key + "_").replace("_", " "))
        y -= 0.6
    axis.plot([], [], "o", color=MODELS["W3"].colour, label="YADE, base corrected")
    axis.plot([], [], "|", color="k", ms=9, mew=1.5, label="kinematic curve")
    axis.axvline(default["lambda0_dem"], color=MODELS["W3"].colour, ls=":", lw=1, label="default")
    axis.set(ylim=(y, 0.5), xlim=(0.15, 5.0), xscale="log", xlabel="λ$_0$ up to d/b = 0.5 [-]")
    ticks(axis.yaxis, places, labels)
    ticks(axis.xaxis, (0.2, 0.3, 0.5, 1.0, 2.0, 5.0))
    axis.legend(loc="lower right")
    style.save(figure, job.output)


run(main, globals())
