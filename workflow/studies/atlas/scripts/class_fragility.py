"""Fragility of a class of façades by the formula: a table, and NRML for OpenQuake."""

from pathlib import Path

from rocking.formula.law import base_of, read
from rocking.runtime.script import run
from rocking.tables import write_table
from studies.atlas import classes
from studies.shared.hazard import imt_of
from studies.shared.nrml import document


def main(job):
    settings, known = job.params.settings, read(job.input.law)
    facades, base = classes.sampled(settings), base_of(**job.params.facade, law=known)
    rows = [
        classes.fragility(facades, model, measure, base, known)
        for model in job.params.models
        for measure in ("pga_g", "pgv_cm_s")
    ]
    write_table(rows, job.output.table, classes.COLUMNS)
    write_table(facades, job.output.facades)
    words = (
        f"Out-of-plane collapse of a class of masonry facades, run {job.wildcards.run}, by formula"
    )
    for measure in ("pga_g", "pgv_cm_s"):
        fits = classes.curves([row for row in rows if row["measure"] == measure])
        name = f"facade_class_{job.wildcards.run}_{measure}"[:100].replace(".", "_")
        text = document(name, words, imt_of(measure, 0.0), fits)
        Path(job.output[measure]).write_text(text, encoding="utf-8")


run(main, globals())
