"""The assessment of one façade as a page that opens offline and as a PDF."""

import hashlib
import json
from importlib.metadata import version
from pathlib import Path

import pandas as pd
from rocking.assessment import pages
from rocking.assessment.content import blocks
from rocking.assessment.document import page
from rocking.runtime.script import run

TABLES = ("checks", "steps", "curve", "sensitivity", "mechanisms", "spectra")
TABLES += ("dynamic", "curves", "dynamic_sensitivity")


def checksum(path):
    """First digits of a file's SHA-256."""
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()[:16]


def provenance(job, settings, histories):
    """Versions, inputs with their checksums, and what stands in which file."""
    p = job.params
    inputs = [str(f) for f in (*job.input.site, job.input.table)]
    rows = [
        ("program", f"rocking-facades {version('rocking-facades')}"),
        *((f"input {Path(f).name}", f"{f}, SHA-256 {checksum(f)}…") for f in inputs),
        (
            "motions",
            f"{len(p.stations)} from {len(set(p.stations.values()))} stations, directions "
            f"{', '.join(settings['directions'])}; {p.table}",
        ),
        ("dynamic histories", f"{histories} by the planar solver (rocking.solver)"),
        ("every key, defaults included", f"results/{p.run}/config.yaml"),
        ("seed of the intervals", str(settings["seed"])),
    ]
    rows += [(Path(f).name, f"SHA-256 {checksum(f)}…") for f in sorted(map(str, job.input.tables))]
    return rows


def main(job):
    settings = json.loads(job.params.settings)
    tables = {name: pd.read_csv(path) for name, path in zip(TABLES, job.input.tables, strict=True)}
    scene = json.loads(Path(job.input.scene).read_text())
    histories = int(tables["dynamic"]["histories"].sum())
    folder = f"results/{job.params.run}/assessment"
    body = blocks(settings, tables, scene["beta_s"], provenance(job, settings, histories), folder)
    Path(job.output.html).write_text(page(body), encoding="utf-8")
    pages.write(job.output.pdf, body, settings["assessment"]["title"] or job.params.run)


run(main, globals())
