"""The report's data, and its appendix: numbers between, formulas, every value, provenance."""

import hashlib
from dataclasses import dataclass, field
from pathlib import Path

from rocking.assessment.code_checks import CHECKS
from rocking.assessment.document import Heading, Paragraph, Table
from rocking.assessment.family import Candidate, Family
from rocking.assessment.selection import fit_of
from rocking.assessment.sources import FORMULAS
from rocking.assessment.values import values


@dataclass
class Data:
    """What a report is made of.

    Attributes
    ----------
    config : dict
        Resolved configuration.
    given : list of str
        Keys that the user stated.
    tables : dict of str to DataFrame
        By file name; verdicts and yade of all models.
    demand_said, program, commit : str
    provenance : list of (what, value)
    family, weakest
        `family.Family`, and its `Candidate` that fails first.
    fit, range_s
        Of the selected motions' mean, see `selection.fit_of`.
    """

    config: dict
    given: list
    tables: dict
    demand_said: str
    program: str
    commit: str
    provenance: list
    family: Family = field(init=False)
    weakest: Candidate = field(init=False)
    fit: tuple | None = field(init=False)
    range_s: tuple = field(init=False)

    def __post_init__(self):
        """Find the weakest mechanism of the tables among the façade's."""
        self.family = Family(self.config)
        found = self.tables["mechanisms"]
        found = found[found["kind"] == "as stated"].sort_values("pga_fails_g")
        least = found["mechanism"].iloc[0]
        self.weakest = next(one for one in self.family.all() if one.name == least)
        self.fit, self.range_s = fit_of(self.tables["selected_spectra"])


def _checksum(path):
    """First digits of a file's SHA-256."""
    return f"SHA-256 {hashlib.sha256(Path(path).read_bytes()).hexdigest()[:16]}…"


def provenance(given, made, stations, table, run, seed, dynamic):
    """Inputs and tables with their checksums, and what stands in which file: (what, value)."""
    places, histories = len(set(stations.values())), int(dynamic["histories"].sum())
    return [
        *((f"input {Path(str(f)).name}", f"{f}, {_checksum(f)}") for f in given),
        ("motions", f"{len(stations)} from {places} stations; {table}"),
        ("histories of the suite", f"{histories} by the planar solver (rocking.solver)"),
        ("every key, defaults included", f"results/{run}/config.yaml"),
        ("seed of the intervals", str(seed)),
        *((Path(f).name, _checksum(f)) for f in sorted(map(str, made))),
    ]


def blocks(data, folder):
    """Blocks of the appendix."""
    steps = data.tables["code_steps"]
    several = steps["mechanism"].nunique() > 1
    rows = []
    for (mechanism, key), part in steps.groupby(["mechanism", "check"], sort=False):
        name = CHECKS.get(key, key)
        first = f"{name}; {mechanism}" if several else name
        for r in part.itertuples():
            rows.append((first, r.symbol, r.meaning, f"{r.value:.4g}", r.unit))
            first = ""
    return [
        Heading("Appendix A: numbers between"),
        Table(
            "Every number between input and result.",
            ("check", "symbol", "meaning", "value", "unit"),
            rows,
            (0.26, 0.13, 0.41, 0.12, 0.08),
            f"{folder}/code_steps.csv",
        ),
        Heading("Appendix B: formulas and how they were read"),
        Table(
            "Official wording: the text in a public transcription with page numbers. "
            "Transcription: a formula in the same place, from the page's image.",
            ("document", "number", "formula or rule", "read as"),
            [(f.document, f.number, f.text, f.status) for f in FORMULAS.values()],
            (0.17, 0.15, 0.52, 0.16),
            "",
        ),
        Paragraph(
            "Not applied: the displacement check of New Zealand's guidelines for rocking walls, "
            "which could not be read."
        ),
        Heading("Appendix C: every value"),
        Table(
            "Stated: in the user's file; derived: from other values, or by a rule of the code; "
            "default: neither.",
            ("key", "value", ""),
            values(data.config, data.given),
            (0.4, 0.48, 0.12),
            f"{folder}/values.csv",
        ),
        Heading("Appendix D: provenance"),
        Table("", ("what", "value"), data.provenance, (0.3, 0.7), ""),
    ]
