"""Explicit run in YADE against modal superposition, rattling identified, and its figure.

Two explicit runs: without dead load, and with gravity that acts from the first
step on, as in a run that starts from the drawing. The second rings vertically;
the modal solution with the same sudden gravity shows the same ringing, which
identifies it. Writes tables/building_explicit.csv and figures/fig03_rattling….
"""

import json

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking import style
from rocking.building.case import build_model, read_plan
from rocking.building.comparison import top_motion
from rocking.building.history import modal_history
from rocking.building.modes import Solver
from rocking.records import G_M_S2, read_csv
from rocking.script import run

import smdof

GRAVITY_M_S2 = 9.81
MODES = 300


def main(job):
    settings = dict(job.params.building)
    with open(job.input.fit) as handle:
        load = json.load(handle)["floor_load_kg_m2"]
    with open(job.input.scene) as handle:
        notes = json.load(handle)["notes"]
    building = build_model(settings, read_plan(job.input.plan), "SBDEM", load, notes["coarsening"])
    modes = Solver(building.scene).modes(MODES)
    record = read_csv(job.input.record)
    top = building.scene.index(building.scene.monitor)
    explicit = {
        name: np.loadtxt(path, delimiter=",", skiprows=1)
        for name, path in (("without dead load", job.input.plain),
                           ("sudden gravity", job.input.loaded))
    }  # fmt: skip
    keep = record.time_s <= explicit["sudden gravity"][-1, 0] + record.dt_s
    ground = record.acceleration_m_s2[keep]
    modal = {
        name: modal_history(modes, [top], ground, record.dt_s, notes["rate_1_s"], gravity_m_s2=g)
        for name, g in (("without dead load", 0.0), ("sudden gravity", GRAVITY_M_S2))
    }
    rows = []
    for name, one in explicit.items():
        for other, two in modal.items():
            for quantity, column, values in (
                ("acceleration", 1, two.acceleration_m_s2[0]),
                ("displacement", 2, two.displacement_m[0]),
            ):
                grid = smdof.common_grid(two.time_s, values, one[:, 0], one[:, column])
                rows.append((job.wildcards.record, building.scene.notes["bricks"],
                             len(building.scene.nodes), notes["step_s"], len(one), name, other,
                             quantity, smdof.weighted_mean_error(*grid)))  # fmt: skip
    columns = ["record", "bricks", "pairs", "step_s", "steps", "explicit", "modal", "quantity",
               "wme"]  # fmt: skip
    pd.DataFrame(rows, columns=columns).to_csv(
        job.output.table, index=False, float_format="%.6g", lineterminator="\n"
    )
    vertical = modes.period_s[modes.largest("z")]
    _figure(job, explicit, modal, float(vertical))


def _figure(job, explicit, modal, vertical_s):
    figure, axes = plt.subplot_mosaic("ae;pp", figsize=(7.0, 5.0), width_ratios=(1.0, 1.4))
    lines = (
        ("YADE, sudden gravity", explicit["sudden gravity"][:, :2].T, "#D55E00", 1.0),
        ("YADE, without dead load", explicit["without dead load"][:, :2].T, "#56B4E9", 1.0),
        ("modal, without dead load", (modal["without dead load"].time_s,
                                      modal["without dead load"].acceleration_m_s2[0]),
         "black", 0.7),
    )  # fmt: skip
    for name, (x, y), colour, width in lines:
        dashes = "--" if name.startswith("modal") else "-"
        axes["a"].plot(x, y / G_M_S2, dashes, color=colour, lw=width)
        axes["e"].plot(x, y / G_M_S2, dashes, color=colour, lw=width, label=name)
        spectrum = top_motion(x, y, 0.5, 25.0).curves["power_spectrum"]
        axes["p"].semilogy(*spectrum, dashes, color=colour, lw=width, label=name)
    start = explicit["sudden gravity"][explicit["sudden gravity"][:, 0] <= 1.0, 1] / G_M_S2
    axes["a"].set(xlabel="time [s]", ylabel="top acceleration [g]", xlim=(0, 1.0),
                  ylim=(1.15 * start.min(), 1.15 * start.max()))  # fmt: skip
    axes["a"].set_title("(a) First second: rattling")
    axes["e"].set(xlabel="time [s]", ylabel="top acceleration [g]")
    axes["e"].set_title("(b) Whole run")
    axes["e"].legend(loc="lower right")
    power = top_motion(*lines[0][1], 0.5, 25.0).curves["power_spectrum"][1]
    axes["p"].set(xlabel="frequency [Hz]", ylabel="power spectral density [(m/s²)²/Hz]",
                  xlim=(0, 25), ylim=(power.max() * 1e-7, power.max() * 3))  # fmt: skip
    axes["p"].axvline(1.0 / vertical_s, color="0.5", lw=0.8, ls=":")
    axes["p"].annotate(f"vertical mode, T = {vertical_s:.3f} s", (1.0 / vertical_s, power.max()),
                       xytext=(4, 0), textcoords="offset points", fontsize=7, va="top")  # fmt: skip
    axes["p"].set_title("(c) Power spectra of the top acceleration")
    with open(job.input.facts) as handle:
        figure.suptitle(f"SBDEM, explicit and modal: {style.provenance(json.load(handle))}")
    style.save(figure, (job.output.png, job.output.pdf))


run(main, globals())
