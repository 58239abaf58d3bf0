"""What `assess` and `code_against_dynamics` make and read."""

import json

from yade_scripts.model.registry import MODELS


class Assessment:
    """Files of the code's answer beside the dynamic one."""

    def __init__(self, study):
        """Keep the study."""
        self.study = study

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
        return [
            path for run in self.study.runs for path in (self.checks(run), *self.collapse(run))
        ]

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
