"""What `fragility` and `capacity_reduction` make and read."""

from pathlib import Path


class Fragility:
    """Files of fragility curves and of the capacity reduction."""

    def __init__(self, study):
        """Keep the study."""
        self.study = study

    def results(self, run) -> list[str]:
        """Everything the target `fragility` makes for one run."""
        names = ("fragility", "intensity_measures")
        tables = [f"results/{run}/tables/{name}.csv" for name in (*names, "im_sufficiency")]
        return tables + [f"results/{run}/figures/{name}.png" for name in names]

    def record_files(self, wildcards) -> list[str]:
        """Accelerograms of all records of a run."""
        return [path.replace(".json", ".csv") for path in self.study.record_facts(wildcards)]

    def reduction_results(self, run) -> list[str]:
        """Everything the target `capacity_reduction` makes for one run."""
        name = "capacity_reduction"
        return [f"results/{run}/tables/{name}.csv", f"results/{run}/figures/{name}.png"]

    def reduction_facts(self, wildcards) -> list[str]:
        """Peak floor accelerations of every case and record."""
        settings = self.study.cfg(wildcards)["capacity_reduction"]
        return [
            f"results/{wildcards.run}/capacity_reduction/T{t1:g}_below{below}/{record}.json"
            for t1 in settings["periods_s"]
            for below in settings["masses_below"]
            for record in self.study.records[wildcards.run]
        ]

    def reduction_curves(self, wildcards) -> list[str]:
        """W2 curves of every case, record and direction."""
        directions = self.study.cfg(wildcards)["directions"]
        return [
            path.replace(".json", f"_{direction}.csv")
            for path in self.reduction_facts(wildcards)
            for direction in directions
        ]

    def confirmed(self, wildcards, curves) -> list[str]:
        """Those of some curves that YADE runs."""
        records = self.study.confirmed(wildcards.run)
        return [path for path in curves if Path(path).stem.rpartition("_")[0] in records]

    def reduction_scans(self, wildcards) -> list[str]:
        """Dense scans behind the W2 curves, in their order."""
        paths = map(Path, self.reduction_curves(wildcards))
        return [str(path.with_name(f"scan_{path.name}")) for path in paths]

    def reference_scans(self, wildcards) -> list[str]:
        """Dense scans behind the W1 curves, in their order."""
        curves = self.reduction_reference(wildcards)
        return [path.replace("/ida/", "/screening/") for path in curves]

    def reduction_reference(self, wildcards) -> list[str]:
        """W1 curves of every record and direction."""
        return [
            f"results/{wildcards.run}/ida/W1/{record}_{direction}.csv"
            for record in self.study.records[wildcards.run]
            for direction in self.study.cfg(wildcards)["directions"]
        ]
