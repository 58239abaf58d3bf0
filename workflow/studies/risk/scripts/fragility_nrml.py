"""Fragility of every model by one measure, as OpenQuake reads it (NRML 0.5)."""

from pathlib import Path

import numpy as np
from rocking.runtime.script import run
from rocking.tables import read_frame
from studies.shared.fragility import Fragility
from studies.shared.hazard import imt_of
from studies.shared.nrml import document


def main(job):
    w = job.wildcards
    table = read_frame(job.input.fragility)
    known = np.isfinite(table["median"]) & np.isfinite(table["dispersion"])
    table = table[(table["im"] == w.im) & known]
    if table.empty:  # OpenQuake takes no fragilityModel without a function
        Path(job.output[0]).write_text(
            "<!-- no motion felled the facade: no fragility function -->\n", encoding="utf-8"
        )
        return
    fits = {row.model: Fragility(row.median, row.dispersion) for row in table.itertuples()}
    name = f"rocking_facade_{w.run}_{w.im}"[:100]
    words = f"Out-of-plane collapse of a rocking masonry facade, run {w.run}; taxonomy: its model"
    imt = imt_of(w.im, job.params.period_s)
    text = document(name.replace(".", "_"), words, imt, fits, discrete=w.form == "discrete")
    Path(job.output[0]).write_text(text, encoding="utf-8")


run(main, globals())
