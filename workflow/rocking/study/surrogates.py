"""What `surrogates` makes and reads."""


class Surrogates:
    """Files of surrogates beside their records."""

    MODELS = ("W1", "W2")

    def __init__(self, study):
        """Keep the study."""
        self.study = study

    def results(self, run) -> list[str]:
        """Everything the target `surrogates` makes for one run."""
        rows = (self.study.tables[run][name] for name in self.study.records[run])
        names = ["surrogate_trust"] if any(row.path for row in rows) else []
        draws = self.study.runs[run]["surrogates"]["draws"]
        figures = [*names, *(["surrogate_scatter"] if draws > 1 else [])]
        return [
            *(f"results/{run}/tables/{t}.csv" for t in ("surrogates", "surrogate_scatter", *names)),
            *(f"results/{run}/figures/{name}.png" for name in figures),
        ]

    def scenes(self, wildcards) -> list[str]:
        """Scenes whose collapse is compared."""
        return [f"results/{wildcards.run}/scenes/{model}.json" for model in self.MODELS]

    def station(self, wildcards) -> str:
        """Station of a record; itself where its table names none."""
        return self.study.record_row(wildcards).about.get("station") or wildcards.record

    def collapses(self, wildcards) -> list[str]:
        """Collapse of every record and its surrogates."""
        names = self.study.records[wildcards.run]
        return [f"results/{wildcards.run}/surrogates/{record}.csv" for record in names]
