"""Files of pushover, pictures and claims."""

from rocking.studies.pushover import DRAWN, VARIANTS


class Boundary:
    """What `snakemake boundary` reads and makes."""

    def __init__(self, study):
        """Keep the study."""
        self.study = study

    def picture_record(self, run) -> str:
        """Record that the pictures of a run show."""
        names = self.study.records[run]
        return self.study.runs[run]["pictures"]["record"] or names[min(1, len(names) - 1)]

    def picture_motion(self, wildcards) -> str:
        """Floor motions of that record."""
        return self.study.floor_motions(wildcards.run, self.picture_record(wildcards.run))

    def picture_facts(self, wildcards) -> str:
        """Provenance file of that record."""
        return f"results/{wildcards.run}/records/{self.picture_record(wildcards.run)}.json"

    def picture_curve(self, wildcards) -> str:
        """IDA table of a model under that record."""
        direction = self.study.cfg(wildcards)["pictures"]["direction"]
        record = self.picture_record(wildcards.run)
        return f"results/{wildcards.run}/ida/{wildcards.model}/{record}_{direction}.csv"

    def pushover_curves(self, wildcards) -> list[str]:
        """Capacity curves of a run."""
        self.study.needs_plain(wildcards.run, "the kinematic curve")
        models = self.study.cfg(wildcards)["pushover"]["models"]
        return [f"results/{wildcards.run}/pushover/{model}.csv" for model in models]

    def variants(self, pattern, names=tuple(VARIANTS)) -> list[str]:
        """Files of the variants of W3, with {run} left open."""
        return [f"results/{{run}}/w3/{pattern.format(name)}" for name in names]

    def drawn_variants(self, pattern) -> list[str]:
        """Files of the variants that Figure 8 draws: the header rules, and the default."""
        return self.variants(pattern, [*(f"header_{rule}" for rule in DRAWN), "default"])

    def results(self, run) -> list[str]:
        """Everything about boundary conditions; IDA of the models of the configuration."""
        names = ["fig07_models", "fig08_w3", "fig09_ida", "w3_sensitivity"]
        return [
            *(f"results/{run}/tables/{name}.csv" for name in ("pushover", "claims")),
            *(f"results/{run}/figures/{name}.png" for name in names),
            *(f"results/{run}/figures/collapse_{model}.gif" for model in ("W2", "W3")),
        ]
