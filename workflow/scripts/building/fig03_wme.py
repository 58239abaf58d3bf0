"""Figure 3: top acceleration, response and power spectra of SBDEM and equal chains."""

import matplotlib.pyplot as plt
import numpy as np
from rocking.building.case import translation_mode
from rocking.building.comparison import N_DOF, chain_top, top_motion
from rocking.building.modes import Modes
from rocking.figures import style
from rocking.records import G_M_S2, read_csv
from rocking.runtime.script import run
from rocking.tables import read_json

SHADES = ("#fdae6b", "#e6a100", "#009E73", "#0072B2", "#7b3294")


def main(job):
    settings = dict(job.params.building)
    modes = Modes.load(job.input.modes)
    period = float(modes.period_s[translation_mode(modes)])
    ranges = (settings["wme_longest_period_s"], settings["wme_highest_frequency_hz"])
    data = np.loadtxt(job.input.history, delimiter=",", skiprows=1)
    record = read_csv(job.input.record)
    facts = read_json(job.input.facts)
    reference = top_motion(data[:, 0], data[:, 2], *ranges)
    figure, axes = plt.subplot_mosaic("tt;rp", figsize=(7.0, 5.4))
    drawn = [("SBDEM", reference, {"color": "black", "lw": 1.4, "zorder": 1})]
    for n, colour in zip(N_DOF, SHADES, strict=True):
        chain = chain_top(
            record.acceleration_m_s2, record.dt_s, n, period, settings["damping_ratio"]
        )
        motion = top_motion(*chain, *ranges)
        error = reference.wme(motion)
        drawn.append((f"{n}DOF", motion, {"color": colour, "lw": 0.8}))
        drawn[-1] += (error,)
    peak = np.argmax(np.abs(data[:, 2]))
    middle = data[peak, 0]
    for name, motion, line, *error in drawn:
        for key, quantity, factor in (
            ("t", "acceleration", G_M_S2),
            ("r", "response_spectrum", G_M_S2),
            ("p", "power_spectrum", 1.0),
        ):
            if key == "t" and name not in ("SBDEM", "1DOF", "4DOF"):
                continue
            x, y = motion.curves[quantity]
            label = name + (f", WME {error[0][quantity]:.3f}" if error else "")
            axes[key].plot(x, y / factor, label=label, **line)
    high = 1.1 * np.max(np.abs(data[:, 2])) / G_M_S2
    axes["t"].set(
        xlabel="time [s]",
        ylabel="top acceleration [g]",
        ylim=(-high, 1.5 * high),
        xlim=(max(0.0, middle - 3.0), middle + 4.0),
    )
    axes["r"].set(
        xlabel="period [s]",
        ylabel="pseudo-acceleration, 5 % damping [g]",
        xlim=(0, min(1.5, ranges[0])),
        ylim=(0, None),
    )
    axes["p"].set(
        xlabel="frequency [Hz]",
        ylabel="power spectral density [(m/s²)²/Hz]",
        xlim=(0, 15),
        ylim=(0, None),
    )
    for letter, ax in zip("abc", axes.values(), strict=True):
        ax.legend(loc="upper right", ncols=3 if letter == "a" else 1)
        ax.set_title(f"({letter})", loc="left")
    figure.suptitle(f"{style.provenance(facts)}: SBDEM and chains with T1 = {period:.3f} s")
    style.save(figure, job.output, job.input.facts)


run(main, globals())
