"""The assessment of one façade as a page that opens offline and as a PDF."""

import hashlib
import json
from importlib.metadata import version
from pathlib import Path

import pandas as pd
from rocking.assessment import pages
from rocking.assessment.appendix import Data
from rocking.assessment.content import blocks
from rocking.assessment.document import page
from rocking.assessment.family import Family
from rocking.assessment.selection import ABOVE, BELOW
from rocking.assessment.values import values
from rocking.runtime.script import run
from rocking.tables import write_table


def checksum(path):
    """First digits of a file's SHA-256."""
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()[:16]


def provenance(job, config, histories):
    """Versions, inputs with their checksums, and what stands in which file."""
    p = job.params
    inputs = [str(f) for f in (*job.input.site, job.input.table)]
    rows = [
        *((f"input {Path(f).name}", f"{f}, SHA-256 {checksum(f)}…") for f in inputs),
        (
            "motions",
            f"{len(p.stations)} from {len(set(p.stations.values()))} stations; {p.table}",
        ),
        ("histories of the suite", f"{histories} by the planar solver (rocking.solver)"),
        ("every key, defaults included", f"results/{p.run}/config.yaml"),
        ("seed of the intervals", str(config["seed"])),
    ]
    made = sorted(map(str, (*job.input.tables, *job.input.verdicts, *job.input.yade)))
    return rows + [(Path(f).name, f"SHA-256 {checksum(f)}…") for f in made]


def demand_said(config, sites):
    """Where the demand is from, in words."""
    own = config["assessment"]
    if own["spectrum"]:
        return f"the spectrum in {own['spectrum']}"
    if own["ag_g"] is not None:
        return (
            f"the spectrum of NTC 2018 for a_g = {own['ag_g']:g} g, F0 = {own['f0']:g}, "
            f"T_C* = {own['tc_star_s']:g} s, subsoil {own['soil']}, topography {own['topography']}"
        )
    return (
        f"that of {', '.join(Path(str(s)).name for s in sites)} once in "
        f"{own['return_period_years']:g} years, with the median shape of the motions' spectra"
    )


def fit_of(spectra):
    """Least and largest deviation of the mean from the target, and whether they are in bounds."""
    if spectra.empty:
        return None, (0.0, 0.0)
    ratio = spectra["mean_g"] / spectra["target_g"] - 1.0
    low, high = float(ratio.min()), float(ratio.max())
    fits = low >= -BELOW - 1e-3 and high <= ABOVE + 1e-3
    return (low, high, fits), (spectra["period_s"].min(), spectra["period_s"].max())


def _all(paths):
    """Tables of all models in one; those without rows add none."""
    found = [pd.read_csv(path) for path in paths]
    found = [table for table in found if len(table)]
    return pd.concat(found, ignore_index=True) if found else pd.DataFrame()


def main(job):
    config = json.loads(json.dumps(dict(job.params.config)))
    tables = {Path(str(p)).stem: pd.read_csv(p) for p in job.input.tables}
    tables |= {"verdicts": _all(job.input.verdicts), "yade": _all(job.input.yade)}
    family = Family(config["facade"], config["return_wall"], config["assessment"])
    stated = tables["mechanisms"][tables["mechanisms"]["kind"] == "as stated"]
    least = stated.sort_values("pga_fails_g").iloc[0]["mechanism"]
    fit, range_s = fit_of(tables["selected_spectra"])
    data = Data(
        config,
        list(job.params.given),
        tables,
        family,
        next(one for one in family.all() if one.name == least),
        demand_said(config, job.input.site),
        f"rocking-facades {version('rocking-facades')}",
        job.params.commit[:12],
        fit,
        range_s,
        provenance(job, config, int(tables["dynamic"]["histories"].sum())),
    )
    body = blocks(data, f"results/{job.params.run}/assessment")
    Path(job.output.html).write_text(page(body), encoding="utf-8")
    pages.write(job.output.pdf, body, config["assessment"]["title"] or job.params.run)
    rows = values(config, data.given)
    write_table(rows, job.output.values, ["key", "value", "standing"])


run(main, globals())
