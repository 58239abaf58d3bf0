"""Ground and floor motions of one record: histories and response spectra."""

import json

import matplotlib.pyplot as plt
import numpy as np
from rocking.figures import style
from rocking.figures.panels import plain_log
from rocking.records import G_M_S2
from rocking.runtime.script import run
from rocking.tables import read_json

from smdof.spectra import response_spectrum
from yade_scripts.model import floor_motions


def main(job):
    facts = read_json(job.input.facts)
    chain = json.loads(job.params.smdof)["smdof"]
    time, columns = floor_motions.read(job.input.motion)
    columns.pop(floor_motions.VERTICAL, None)
    motions = np.array(list(columns.values())) / G_M_S2
    colours = [style.GREY, *plt.colormaps["viridis"](np.linspace(0.85, 0.1, len(motions) - 1))]
    labels = [name.replace("floor", "floor ") for name in columns]

    figure, axes = plt.subplots(1, 2, width_ratios=(1.6, 1.0), figsize=(7.0, 3.8))
    gap = 1.15 * np.ptp(motions[-1])
    for level, (motion, colour) in enumerate(zip(motions, colours, strict=True)):
        axes[0].plot(time, motion + level * gap, color=colour, lw=0.7)
    axes[0].set(xlabel="time [s]", yticks=[level * gap for level in range(len(motions))])
    axes[0].set_yticklabels(
        [f"{name}\n{np.abs(m).max():#.3g} g" for name, m in zip(labels, motions, strict=True)]
    )
    axes[0].set_title("absolute acceleration, peak beside each", loc="left")
    length = style.round_length(0.5 * gap)
    axes[0].plot([time[-1]] * 2, [0.0, length], color="k", lw=1.5)
    place = {"xytext": (-3, 0), "textcoords": "offset points", "ha": "right", "va": "center"}
    axes[0].annotate(f"{length:g} g", (time[-1], 0.5 * length), **place)
    periods = np.geomspace(0.03, 4.0, 140)
    for motion, colour in zip(motions, colours, strict=True):
        spectrum = response_spectrum(motion * G_M_S2, time[1] - time[0], periods)
        axes[1].loglog(periods, spectrum.psa_m_s2 / G_M_S2, color=colour)
    axes[1].axvline(chain["period_s"], color="k", lw=0.7, ls=":")
    axes[1].annotate(
        f"T1 = {chain['period_s']:g} s",
        (chain["period_s"], 0.02),
        rotation=90,
        xycoords=("data", "axes fraction"),
        xytext=(3, 0),
        textcoords="offset points",
    )
    axes[1].set(xlabel="period [s]", ylabel="pseudo-acceleration, 5 % damping [g]")
    plain_log(axes[1].yaxis, (1.0, 2.0, 5.0))
    axes[1].set_title("spectra, in the same colours", loc="left")
    figure.suptitle(
        f"{style.provenance(facts)} through {len(motions) - 1} lumped masses, "
        f"{100 * chain['damping_ratio']:g} % {chain['damping_model']} damping"
    )
    style.save(figure, job.output, job.input.facts)


run(main, globals())
