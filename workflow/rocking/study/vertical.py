"""What `vertical` makes and reads."""

from rocking.configuration.config import ConfigError
from yade_scripts.model.registry import MODELS


class Vertical:
    """Files of collapse with and without the vertical motion of every record."""

    def __init__(self, study):
        """Keep the study."""
        self.study = study

    def results(self, run) -> list[str]:
        """Everything the target `vertical` makes for one run."""
        tables = [f"results/{run}/tables/{name}.csv" for name in ("vertical", "vertical_ratios")]
        return [*tables, f"results/{run}/figures/vertical.png"]

    def scenes(self, wildcards) -> list[str]:
        """Scenes of the run's models that the planar solver stands in for."""
        models = self.study.cfg(wildcards)["models"]
        return [f"results/{wildcards.run}/scenes/{m}.json" for m in models if MODELS[m].twin]

    def files(self, wildcards) -> list[str]:
        """Files of both motions; a record without a vertical one ends the workflow."""
        try:
            self.study.check_vertical(wildcards.run, "vertical", [wildcards.record])
        except ConfigError as error:
            raise SystemExit(f"error: {error.detail}") from None
        row = self.study.record_row(wildcards)
        return list(dict.fromkeys([row.path, row.vertical_path]))

    def collapses(self, wildcards) -> list[str]:
        """Collapse under every record."""
        names = self.study.records[wildcards.run]
        return [f"results/{wildcards.run}/vertical/{record}.csv" for record in names]
