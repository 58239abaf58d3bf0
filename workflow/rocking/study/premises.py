"""What `premises` makes and reads."""


class Premises:
    """Files of the models side by side, of the map over buildings and of the tornado chart."""

    def __init__(self, study):
        """Keep the study."""
        self.study = study

    def settings(self, run) -> dict:
        """Section premises of a run."""
        return self.study.runs[run]["premises"]

    def tornado_records(self, run) -> list[str]:
        """Records of the tornado chart."""
        named = self.settings(run)["tornado_records"]
        if named is None:
            return self.study.records[run]
        return self.study.needed(run, "premises.tornado_records", named)

    def bricks(self, wildcards) -> list[str]:
        """Curves that no scan stands for."""
        scans = {path.replace("/screening/", "/ida/") for path in self.study.scans(wildcards.run)}
        return [path for path in self.study.ida_tables(wildcards.run) if path not in scans]

    def others(self, wildcards) -> list[str]:
        """Probability tables of further models."""
        return [self.study.beside(path) for path in self.settings(wildcards.run)["other_curves"]]

    def sweep(self, wildcards) -> list[str]:
        """Map of every record."""
        run = wildcards.run
        return [f"results/{run}/premises/map/{r}.csv" for r in self.study.records[run]]

    def tornado(self, wildcards) -> list[str]:
        """Scans behind the tornado chart of a model."""
        run, model = wildcards.run, wildcards.model
        return [f"results/{run}/premises/{model}/{r}.csv" for r in self.tornado_records(run)]

    def results(self, run) -> list[str]:
        """Everything the target `premises` makes for one run."""
        names = ["premises", "premises_ratios"]
        if self.settings(run)["mass_ratios"]:
            names.append("premises_map")
        if self.tornado_records(run):
            names += [f"premises_tornado_{m}" for m in self.settings(run)["tornado_models"]]
        tables = [f"results/{run}/tables/{name}.csv" for name in (*names, "premises_losses")]
        return [*tables, *(f"results/{run}/figures/{name}.png" for name in names)]
