"""Figure 6: the Shawa wall on its shake-table motions, tilted and with a gap."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D
from rocking.figures import style
from rocking.figures.panels import ticks
from rocking.runtime.script import run
from rocking.tables import read_json
from studies.calibration.shake_table import largest_mm, relative_mm, rest_mm
from studies.shared.restitution import read_archive

TRIAL_MS = 0.94  # β found by trial and error for an early test (Shawa et al., 2012)
LAWS = {"eq5": ("eq. 5", "#0072B2", "-"), "fitted": ("fitted law", "#D55E00", "--")}


def main(job):
    tests = read_json(job.input.tests)
    runs = list(zip(tests, read_archive(job.input.histories), strict=True))
    names = list(dict.fromkeys(t["about"]["record"] for t in tests))
    scales = sorted({t["about"]["scale"] for t in tests})
    shown = min(scales, key=lambda s: abs(s - 1.0))
    size = {"figsize": (7.4, 2.1 * len(names) + 0.4), "width_ratios": (1.25, 1.25, 1.0)}
    figure, axes = plt.subplots(len(names), 3, squeeze=False, **size)
    for row, name in zip(axes, names, strict=True):
        mine = [(t, d) for t, d in runs if has(t, record=name)]
        row[1].sharey(row[0])
        for axis, direction in zip(row, ("pos", "neg"), strict=False):
            histories(axis, mine, direction, shown)
            places(axis, mine[0][0])
        peaks(row[2], mine, scales)
        about = mine[0][0]["about"]
        first = f"{name} ({about['source']}), φ = {about['tilt_deg']:g}°, ×{shown:g}, +"
        row[0].set_title(first, loc="left")
        row[1].set_title(f"×{shown:g}, −", loc="left")
        row[2].set_title("peaks [mm]", loc="left")
    handles = axes[0, 0].get_legend_handles_labels()[0]
    look = {"c": "0.3", "ls": ""}
    handles += [Line2D([], [], marker="o", label="peak, +", **look)]
    handles += [Line2D([], [], marker="v", label="peak, −", mfc="none", **look)]
    title = f"β found by trial in the tests: {TRIAL_MS:g} ms; grey band: motions as recorded"
    figure.legend(handles=handles, loc="outside lower center", ncols=3, title=title)
    for axis in axes[-1, :2]:
        axis.set_xlabel("time [s]")
    axes[-1, 2].set_xlabel("factor on the motion [-]")
    for axis in axes[:, 0]:
        axis.set_ylabel("top displacement [mm]")
    style.save(figure, job.output)


def places(axis, test):
    """Mark what the study states of a test: the tilt's upright position and the return wall."""
    upright, gap = -rest_mm(test), 1e3 * test["config"]["facade"]["gap_m"]
    for level, text, line in ((upright, "upright", ":"), (upright - gap, "return wall", "--")):
        axis.axhline(level, c="0.45", ls=line, lw=0.8, label=text)


def has(test, **wanted):
    """Whether a test is of these values."""
    return all(test["about"][key] == value for key, value in wanted.items())


def histories(axis, mine, direction, shown):
    for test, done in mine:
        if not has(test, scale=shown, direction=direction):
            continue
        d, (law, colour, line) = relative_mm(test, done), LAWS[test["about"]["law"]]
        label = f"{law}, β = {1e3 * test['beta_s']:.2f} ms"
        axis.plot(done["time_s"], d, c=colour, ls=line, lw=0.8, label=label)
        if done["status"] == "overturned":
            axis.plot(done["time_s"][-1], d[-1], "x", c=colour, ms=6)


def peaks(axis, mine, scales):
    b = 1e3 * mine[0][0]["config"]["facade"]["thickness_m"]
    for law, (_, colour, line) in LAWS.items():
        for direction, marker, fill in (("pos", "o", colour), ("neg", "v", "none")):
            tests = [(t, d) for t, d in mine if has(t, law=law, direction=direction)]
            places = sorted((t["about"]["scale"], largest_mm(t, d)) for t, d in tests)
            x, y = np.reshape(places, (-1, 2)).T
            axis.plot(x, y, marker, c=colour, mfc=fill, ls=line, lw=0.7)
    axis.axhline(b, c="0.5", ls=":", lw=0.9)
    axis.axvline(1.0, c="0.8", lw=4.0, zorder=0)  # as recorded: what the tests are taken to be
    axis.text(scales[0], b, "overturned", va="bottom", fontsize=6.5, color="0.4")
    axis.set_ylim(0.0, 1.12 * b)
    ticks(axis.xaxis, scales)


run(main, globals())
