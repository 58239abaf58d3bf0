"""Figure 3: top acceleration, response and power spectra of SBDEM and equal chains."""

import matplotlib.pyplot as plt
import numpy as np
from rocking.figures import style
from rocking.records import G_M_S2, read_csv
from rocking.runtime.script import run
from rocking.tables import read_json
from studies.building.case import translation_mode
from studies.building.comparison import against_chains
from studies.building.modes import Modes

SHADES = ("#fdae6b", "#e6a100", "#009E73", "#0072B2", "#7b3294")

IN_TIME = ("SBDEM", "1DOF", "4DOF")  # drawn over time
CURVES = (  # panel, what it shows, its unit
    ("t", "acceleration", G_M_S2),
    ("r", "response_spectrum", G_M_S2),
    ("p", "power_spectrum", 1.0),
)


def main(job):
    settings = dict(job.params.building)
    modes = Modes.load(job.input.modes)
    period = float(modes.period_s[translation_mode(modes)])
    record, facts = read_csv(job.input.record), read_json(job.input.facts)
    reference, chains = against_chains(job.input.history, record, period, settings)
    figure, axes = plt.subplot_mosaic("tt;rp", figsize=(7.0, 5.4))
    drawn = [("SBDEM", reference, {}, {"color": "black", "lw": 1.4, "zorder": 1})]
    for (n, motion_and_errors), colour in zip(chains.items(), SHADES, strict=True):
        drawn.append((f"{n}DOF", *motion_and_errors, {"color": colour, "lw": 0.8}))
    for name, motion, errors, line in drawn:
        for key, quantity, factor in CURVES:
            if key == "t" and name not in IN_TIME:
                continue
            x, y = motion.curves[quantity]
            label = name + (f", WME {errors[quantity]:.3f}" if errors else "")
            axes[key].plot(x, y / factor, label=label, **line)
    time_s, top_m_s2 = reference.curves["acceleration"]
    middle, high = time_s[np.argmax(np.abs(top_m_s2))], 1.1 * np.abs(top_m_s2).max() / G_M_S2
    axes["t"].set(xlabel="time [s]", xlim=(max(0.0, middle - 3.0), middle + 4.0))
    axes["t"].set(ylabel="top acceleration [g]", ylim=(-high, 1.5 * high))
    longest = min(1.5, settings["wme_longest_period_s"])
    axes["r"].set(xlabel="period [s]", xlim=(0, longest), ylim=(0, None))
    axes["r"].set_ylabel("pseudo-acceleration, 5 % damping [g]")
    axes["p"].set(xlabel="frequency [Hz]", xlim=(0, 15), ylim=(0, None))
    axes["p"].set_ylabel("power spectral density [(m/s²)²/Hz]")
    for letter, ax in zip("abc", axes.values(), strict=True):
        ax.legend(loc="upper right", ncols=3 if letter == "a" else 1)
        ax.set_title(f"({letter})", loc="left")
    figure.suptitle(f"{style.provenance(facts)}: SBDEM and chains with T1 = {period:.3f} s")
    style.save(figure, job.output, job.input.facts)


run(main, globals())
