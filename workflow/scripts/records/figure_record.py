"""One accelerogram: acceleration, velocity, displacement and response spectrum."""

import matplotlib.pyplot as plt
import numpy as np
from rocking.figures import style
from rocking.records import G_M_S2, integrate, measures, read_csv
from rocking.runtime.script import run
from rocking.tables import read_json

from smdof.spectra import response_spectrum


def main(job):
    record = read_csv(job.input.record)
    facts = read_json(job.input.facts)
    velocity, displacement = integrate(record.acceleration_m_s2, record.dt_s)
    peaks = measures(record)
    figure, axes = plt.subplot_mosaic("as;vs;ds", width_ratios=(1.7, 1.0))
    for key, values, label, peak in (
        ("a", record.acceleration_m_s2 / G_M_S2, "acceleration [g]", f"{peaks['pga_g']:.3g} g"),
        ("v", velocity * 100, "velocity [cm/s]", f"{peaks['pgv_cm_s']:.3g} cm/s"),
        ("d", displacement * 100, "displacement [cm]", f"{peaks['pgd_cm']:.3g} cm"),
    ):
        axes[key].plot(record.time_s, values, lw=0.8)
        axes[key].set_ylabel(label)
        axes[key].text(
            0.99, 0.95, f"peak {peak}", transform=axes[key].transAxes, ha="right", va="top"
        )
    axes["d"].set_xlabel("time [s]")
    periods = np.geomspace(0.02, 5.0, 160)
    spectrum = response_spectrum(record.acceleration_m_s2, record.dt_s, periods)
    axes["s"].loglog(periods, spectrum.psa_m_s2 / G_M_S2)
    axes["s"].set(xlabel="period [s]", ylabel="pseudo-acceleration, 5 % damping [g]")
    figure.suptitle(f"{style.provenance(facts)}, baseline treatment: {facts['baseline']}")
    style.save(figure, job.output, job.input.facts)


run(main, globals())
