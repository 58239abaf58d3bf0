"""The report's data, and its appendix: numbers between, formulas, every value, provenance."""

from dataclasses import dataclass, field

from rocking.assessment.code_checks import CHECKS
from rocking.assessment.document import Heading, Paragraph, Table
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
    family, weakest
        `family.Family`, and its `Candidate` that fails first.
    demand_said, program, commit : str
    fit : (low, high, fits) or None
        Of the selected motions' mean.
    range_s : tuple of float
        Periods of that fit.
    provenance : list of (what, value)
    """

    config: dict
    given: list
    tables: dict
    family: object
    weakest: object
    demand_said: str
    program: str
    commit: str
    fit: tuple | None
    range_s: tuple
    provenance: list = field(default_factory=list)


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
