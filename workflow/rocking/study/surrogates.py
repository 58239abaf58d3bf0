"""What `surrogates` makes and reads."""


class Surrogates:
    """Files of surrogates beside their records."""

    MODELS = ("W1", "W2")

    def __init__(self, study):
        """Keep the study."""
        self.study = study

    def results(self, run) -> list[str]:
        """Everything the target `surrogates` makes for one run."""
        return [
            f"results/{run}/tables/surrogates.csv",
            f"results/{run}/tables/surrogate_trust.csv",
            f"results/{run}/figures/surrogate_trust.png",
        ]

    def scenes(self, wildcards) -> list[str]:
        """Scenes whose collapse is compared."""
        return [f"results/{wildcards.run}/scenes/{model}.json" for model in self.MODELS]

    def station(self, wildcards) -> str:
        """Station of a record; itself where its table names none."""
        return self.study.record_row(wildcards).about.get("station") or wildcards.record

    def recorded(self, wildcards) -> str:
        """Record that surrogates are made for; one that is a surrogate ends the workflow."""
        if self.study.record_row(wildcards).path is None:
            raise SystemExit(
                f"error: surrogates: record {wildcards.record} has no file in"
                f" {self.study.table_path(wildcards.run)}; expected recorded motions, such as"
                " records_table=config/suites/recorded_suite.tsv"
            )
        return f"results/{wildcards.run}/records/{wildcards.record}.csv"

    def collapses(self, wildcards) -> list[str]:
        """Collapse of every record and its surrogates."""
        names = self.study.records[wildcards.run]
        return [f"results/{wildcards.run}/surrogates/{record}.csv" for record in names]
