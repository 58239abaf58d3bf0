"""What `assess` and `code_against_dynamics` make and read."""

import json
from collections.abc import Mapping

from rocking.assessment.site import SpectrumError, pga_at, read_spectrum
from rocking.records import RecordError
from rocking.risk.hazard import HazardError, read_hazard
from yade_scripts.model.registry import MODELS

TABLES = (
    *("code_checks", "code_steps", "capacity_curve", "code_sensitivity", "mechanisms", "spectra"),
    *("dynamic", "dynamic_curves", "dynamic_sensitivity"),
)
STATED = {  # keys that an assessment does not take from the case study
    "facade": ("height_m", "thickness_m", "width_m", "density_kg_m3"),
    "smdof": ("n_dof", "period_s"),
    "assessment": ("confidence_factor",),
}


class Assessment:
    """Files of the code's answer beside the dynamic one.

    Parameters
    ----------
    study : Study
    given : mapping
        The configuration as the user gave it, to tell what is stated from what is a default.
    """

    def __init__(self, study, given):
        """Keep the study and what was given."""
        self.study, self.given = study, given

    def reports(self, run) -> list[str]:
        """What `assess` makes for one run."""
        return [f"results/{run}/assessment/report.{kind}" for kind in ("html", "pdf")]

    def tables(self, wildcards) -> list[str]:
        """Tables of a run's report."""
        return [f"results/{wildcards.run}/assessment/{name}.csv" for name in TABLES]

    def scene(self, wildcards) -> str:
        """Scene whose sensitivity is asked for: that of the last model."""
        run = wildcards.run
        if not self.models(run):
            raise SystemExit("error: models: expected W1, W2 or W2m among them for assess")
        return f"results/{run}/scenes/{self.models(run)[-1]}.json"

    def spectrum(self, wildcards) -> list[str]:
        """File of the site's spectrum, checked; none where the hazard curve stands for it."""
        path = self.study.cfg(wildcards)["assessment"]["spectrum"]
        if path is None:
            return []
        path = self.study.beside(path)
        self._checked("assessment.spectrum", read_spectrum, path)
        return [path]

    def hazard(self, wildcards) -> list[str]:
        """File of the site's hazard curve, checked; none where a spectrum is given alone."""
        resolved = self.study.cfg(wildcards)
        path, settings = resolved["risk"]["hazard"], resolved["assessment"]
        if path is None:
            return []
        path = self.study.beside(path)
        curve = self._checked(
            "risk.hazard",
            read_hazard,
            path,
            resolved["smdof"]["period_s"],
            resolved["risk"]["site"],
        )
        if settings["spectrum"] is None:
            self._checked("risk.hazard", pga_at, curve, settings["return_period_years"])
        return [path]

    def site(self, wildcards) -> list[str]:
        """Files that say how the site shakes; what is missing ends the workflow in one line."""
        self.study.needs_plain(wildcards.run, "the assessment")
        for section, keys in STATED.items():
            part = self.given.get(section)
            for key in keys:
                if not isinstance(part, Mapping) or key not in part:
                    raise SystemExit(
                        f"error: assess: {section}.{key} is not stated; expected it in the "
                        "façade's file, not the case study's default"
                    )
        found = self.spectrum(wildcards) + self.hazard(wildcards)
        if not found:
            raise SystemExit(
                "error: assess: no demand; expected assessment.spectrum (columns period_s,sa_g) or "
                "risk.hazard (columns pga_g,annual_rate)"
            )
        return found

    @staticmethod
    def _checked(key, read, *arguments):
        try:
            return read(*arguments)
        except (SpectrumError, HazardError, RecordError, ValueError) as error:
            raise SystemExit(f"error: {key}: {error}") from None

    def models(self, run) -> list[str]:
        """Models of a run that the planar solver stands in for and whose joint is dry."""
        wanted = self.study.runs[run]["models"]
        return [m for m in wanted if MODELS[m].twin and not MODELS[m].bonded]

    def collapse(self, run) -> list[str]:
        """Collapse tables of a run's models."""
        return [f"results/{run}/assessment/collapse_{m}.csv" for m in self.models(run)]

    def checks(self, run) -> str:
        """Failing PGA of every check, by record."""
        return f"results/{run}/assessment/checks_by_record.csv"

    def stations(self, wildcards) -> dict[str, str]:
        """Station of every record; the record's own name where the table states none."""
        run = wildcards.run
        rows = self.study.tables[run]
        return {n: str(rows[n].about.get("station") or n) for n in self.study.records[run]}

    def compared(self, wildcards=None) -> list[str]:
        """Everything that stands behind the comparison of all runs."""
        return [path for run in self.study.runs for path in (self.checks(run), *self.collapse(run))]

    def facts(self, wildcards=None) -> str:
        """What each run's façade is and which files are its own, as JSON."""
        found = {}
        for run, resolved in self.study.runs.items():
            h, b = (resolved["facade"][k] for k in ("height_m", "thickness_m"))
            found[run] = {
                "height_m": h,
                "slenderness": round(h / b, 2),
                "period_s": resolved["smdof"]["period_s"],
                "checks": self.checks(run),
                "collapse": self.collapse(run),
            }
        return json.dumps(found, sort_keys=True)
