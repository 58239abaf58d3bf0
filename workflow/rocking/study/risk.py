"""What `risk` makes and reads."""

from rocking.records import RecordError
from rocking.risk.hazard import HazardError, imt_of, read_hazard


class Risk:
    """Files of rates of collapse, and of fragilities for OpenQuake."""

    def __init__(self, study):
        """Keep the study."""
        self.study = study

    def results(self, run) -> list[str]:
        """Everything the target `risk` makes for one run."""
        return [
            f"results/{run}/tables/risk.csv",
            f"results/{run}/risk/deaggregation.csv",
            f"results/{run}/figures/risk.png",
        ]

    def models_for_openquake(self, run) -> list[str]:
        """Fragility models of a run, one a measure that OpenQuake knows, in both forms."""
        resolved = self.study.runs[run]
        names = resolved["fragility"]["measures"]
        known = [name for name in names if imt_of(name, resolved["smdof"]["period_s"])]
        forms = ("continuous", "discrete")
        return [f"results/{run}/fragility/nrml_{im}_{form}.xml" for im in known for form in forms]

    def hazard(self, wildcards) -> str:
        """File of a run's hazard curve; what is wrong with it ends the workflow in one line."""
        resolved = self.study.cfg(wildcards)
        path = resolved["risk"]["hazard"]
        if path is None:
            raise SystemExit(
                "error: config: risk.hazard: null; expected the file of a hazard curve, with the"
                " columns pga_g,annual_rate or as OpenQuake exports it"
            )
        path = self.study.beside(path)
        try:
            curve = read_hazard(path, resolved["smdof"]["period_s"], resolved["risk"]["site"])
        except (HazardError, RecordError) as error:
            raise SystemExit(f"error: risk.hazard: {error}") from None
        if curve.measure not in resolved["fragility"]["measures"]:
            raise SystemExit(
                f"error: risk.hazard: {path} is of {curve.measure}; expected one of"
                f" fragility.measures ({', '.join(resolved['fragility']['measures'])})"
            )
        return path
