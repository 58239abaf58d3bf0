"""What `uncertainty` makes and reads."""

import json

from rocking.records import load
from rocking.uncertainty import sampling

TABLES = ("parts", "sensitivity", "fragility", "confirm")


class Uncertainty:
    """Files of the sample over material and model, under drawn motions."""

    def __init__(self, study):
        """Keep the study."""
        self.study = study
        self.drawn: dict[str, dict[str, str]] = {}

    def settings(self, run) -> dict:
        """Section uncertainty of a run."""
        return self.study.runs[run]["uncertainty"]

    def results(self, run) -> list[str]:
        """Everything the target `uncertainty` makes for one run."""
        names = TABLES if self.settings(run)["confirm"] else TABLES[:-1]
        tables = [f"results/{run}/tables/uncertainty_{name}.csv" for name in names]
        return [*tables, f"results/{run}/figures/uncertainty.png"]

    def motions(self, run) -> dict[str, str]:
        """Direction of every motion of the design, by record; drawn once."""
        if run not in self.drawn:
            resolved, own = self.study.runs[run], self.settings(run)
            try:
                sampling.scores(own)
            except ValueError as error:
                raise SystemExit(f"error: {error}") from None
            short = [
                name
                for name in self.study.records[run]
                if self._duration_s(run, name) <= own["max_duration_s"]
            ]
            if len(short) < 3:
                raise SystemExit(
                    f"error: uncertainty: {len(short)} records of at most "
                    f"{own['max_duration_s']:g} s; expected 3 or more (uncertainty.max_duration_s)"
                )
            self.drawn[run] = sampling.motions(short, resolved["directions"], own)
        return self.drawn[run]

    def _duration_s(self, run, name) -> float:
        """Duration of a record, as its table states it or by reading it."""
        row, resolved = self.study.tables[run][name], self.study.runs[run]
        if "duration_s" in row.targets:
            return row.targets["duration_s"]
        how = {key: resolved[key] for key in ("baseline", "seed")}
        return load(name, self.study.table_path(run), **how).duration_s

    def direction(self, wildcards) -> str:
        """Direction of a motion."""
        return self.motions(wildcards.run)[wildcards.record]

    def scenes(self, wildcards) -> list[str]:
        """Scenes of the forms of the model."""
        run = wildcards.run
        return [f"results/{run}/scenes/{m}.json" for m in self.settings(run)["models"]]

    def collapses(self, wildcards) -> list[str]:
        """Collapse over the sample under every motion."""
        run = wildcards.run
        return [f"results/{run}/uncertainty/{record}.csv" for record in self.motions(run)]

    def records(self, wildcards) -> list[str]:
        """Records of the design."""
        run = wildcards.run
        return [f"results/{run}/records/{record}.csv" for record in self.motions(run)]

    def facts(self, wildcards) -> list[str]:
        """Provenance of these records."""
        return [path.replace(".csv", ".json") for path in self.records(wildcards)]

    def cells(self, run) -> list[str]:
        """Names of the cells that YADE runs."""
        return [f"cell{k}" for k in range(1, self.settings(run)["confirm"] + 1)]

    def confirmed(self, wildcards) -> list[str]:
        """YADE's runs of them."""
        run = wildcards.run
        return [f"results/{run}/uncertainty/yade/{cell}.csv" for cell in self.cells(run)]

    def params(self, *more):
        """Params function: what the sample depends on and the keys of `more`, as JSON."""
        keys = ("samples", "sampling", "seed", "replicates", "parameters", *more)

        def text(wildcards):
            own = self.settings(wildcards.run)
            limit = self.study.cfg(wildcards)["ida"]["max_pga_g"]
            return json.dumps({**{k: own[k] for k in keys}, "max_pga_g": limit}, sort_keys=True)

        return text
