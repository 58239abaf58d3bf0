"""Explicit run in YADE against modal superposition, rattling identified, and its figure.

Two explicit runs: without dead load, and with gravity that acts from the first
step on, as in a run that starts from the drawing. The second rings vertically;
the modal solution with the same sudden gravity shows the same ringing, which
identifies it.
"""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking.figures import style
from rocking.records import G_M_S2, read_csv
from rocking.runtime.script import run
from rocking.tables import headed, read_json, write_table
from studies.building.case import fitted_model
from studies.building.comparison import top_motion
from studies.building.explicit import differences, modal_histories, read_histories, second_along_y
from studies.building.modes import Solver
from studies.building.yade.explicit_building import corner

MODES = 300
HIGHEST_HZ = 150.0
POINTS = ("top floor", "wall corner")
RUNS = (
    ("YADE", "sudden gravity", "#D55E00", "-"),
    ("modal", "sudden gravity", "black", ":"),
    ("YADE", "without dead load", "#0072B2", "-"),
)


def main(job):
    settings, given = dict(job.params.building), job.input
    notes = read_json(given.scene)["notes"]
    building = fitted_model(settings, given.plan, given.fit, "SBDEM", notes["coarsening"])
    modes = Solver(building.scene).modes(MODES)
    points = [building.scene.index(building.scene.monitor), corner(building.scene)]
    explicit = read_histories(given.plain, given.loaded)
    until_s = explicit["sudden gravity"][-1, 0]
    modal = modal_histories(modes, points, read_csv(given.record), notes["rate_1_s"], until_s)
    facts = {
        "record": job.wildcards.record,
        "bricks": building.scene.notes["bricks"],
        "pairs": len(building.scene.nodes),
        "step_s": notes["step_s"],
        "steps": len(explicit["sudden gravity"]),
    }
    columns = ["explicit", "modal", "point", "quantity", "wme"]
    table = pd.DataFrame(differences(explicit, modal, POINTS), columns=columns)
    write_table(headed(table, **facts), job.output.table)
    _figure(job, explicit, modal, float(modes.period_s[second_along_y(modes)]))


def _figure(job, explicit, modal, second_s):
    figure, axes = plt.subplots(2, 2, figsize=(7.0, 5.4), width_ratios=(1.0, 1.25))
    for row, point in enumerate(POINTS):
        history, power = axes[row]
        peak = 0.0
        for source, load, colour, line in RUNS:
            x, y = modal[load].time_s, modal[load].acceleration_m_s2[row]
            if source == "YADE":
                x, y = explicit[load][:, 0], explicit[load][:, 1 + row]
            name = f"{source}, {load}"
            history.plot(x, y / G_M_S2, line, color=colour, lw=1.0, label=name)
            peak = max(peak, np.abs(y[x <= 1.0]).max() / G_M_S2)
            spectrum = top_motion(x, y, 0.5, HIGHEST_HZ).curves["power_spectrum"]
            power.loglog(*spectrum, line, color=colour, lw=1.0)
        history.set(xlabel="time [s]", ylabel=f"acceleration along y, {point} [g]")
        history.set(xlim=(0, 1.0), ylim=(-1.1 * peak, 1.1 * peak))
        power.set(xlabel="frequency [Hz]", ylabel="power density [(m/s²)²/Hz]")
        power.set(xlim=(0.5, HIGHEST_HZ), ylim=(1e-5, None))
        power.axvline(1.0 / second_s, color="0.5", lw=0.8, ls="--")
        words, across = f"second mode along y,\nT = {second_s:.3f} s", power.get_xaxis_transform()
        power.text(1.05 / second_s, 0.97, words, transform=across, fontsize=7, va="top")
        history.set_title(f"({'ac'[row]}) {point}, first second", loc="left")
        power.set_title(f"({'bd'[row]}) {point}, power spectrum of the run", loc="left")
    figure.suptitle(f"SBDEM, explicit and modal: {style.provenance(read_json(job.input.facts))}")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    style.save(figure, job.output, job.input.facts)


run(main, globals())
