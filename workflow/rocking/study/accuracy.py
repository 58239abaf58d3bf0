"""Files of the accuracy study."""

from pathlib import Path

from yade_scripts.model.registry import PLANAR


class Accuracy:
    """What `snakemake accuracy` reads and makes."""

    def __init__(self, study):
        """Keep the study."""
        self.study = study

    def records(self, wildcards) -> list[str]:
        """Records of its ensembles and energy balances."""
        wanted = self.study.cfg(wildcards)["accuracy"]["records"]
        return self.study.needed(wildcards.run, "accuracy.records", wanted)

    def scenes(self, wildcards) -> list[str]:
        """Scene files of its models, which the judge must know if it is the reference."""
        settings = self.study.cfg(wildcards)["accuracy"]
        if settings["reference"] == "judge":
            self.study.needs_plain(wildcards.run, "the judge", held=True)
        return [f"results/{wildcards.run}/scenes/{model}.json" for model in settings["models"]]

    def curves(self, wildcards, ending="") -> list[str]:
        """IDA tables, or with ending "_ensemble" their ensembles."""
        settings = self.study.cfg(wildcards)["accuracy"]
        return [
            f"results/{wildcards.run}/ida/{model}/{record}_{direction}{ending}.csv"
            for model in settings["models"]
            for record in self.records(wildcards)
            for direction in settings["directions"]
        ]

    def ensembles(self, wildcards) -> list[str]:
        """Ensembles of the same curves."""
        return self.curves(wildcards, "_ensemble")

    def scans(self, wildcards) -> list[str]:
        """Dense scans of the same curves, of the models that have one."""
        return [
            path.replace("/ida/", "/screening/")
            for path in self.curves(wildcards)
            if self.study.scanned(wildcards.run, Path(path).parent.name)
        ]

    def facts(self, wildcards) -> list[str]:
        """Provenance files of the same records."""
        return [f"results/{wildcards.run}/records/{r}.json" for r in self.records(wildcards)]

    def motions(self, wildcards) -> list[str]:
        """Floor motions of its records."""
        run = wildcards.run
        return [self.study.floor_motions(run, record) for record in self.records(wildcards)]

    def all_motions(self, wildcards) -> list[str]:
        """Floor motions of all records of the run: the two halves that fidelity is measured on."""
        run = wildcards.run
        return [self.study.floor_motions(run, record) for record in self.study.records[run]]

    def runs(self, wildcards) -> list[str]:
        """Tables of runs: YADE's, the compiled planar solver's, those of outside engines."""
        engines = [f"engine_{name}" for name in self.study.cfg(wildcards)["accuracy"]["engines"]]
        return [
            f"results/{wildcards.run}/accuracy/{name}.csv"
            for name in ("runs", "screening", *engines)
        ]

    def energy_histories(self, wildcards) -> list[str]:
        """Balanced runs: every model and record, in the first direction."""
        settings = self.study.cfg(wildcards)["accuracy"]
        return [
            f"results/{wildcards.run}/energy/{model}/{record}_{settings['directions'][0]}"
            f"_{settings['energy_share']:g}.csv"
            for model in settings["energy_models"]
            for record in self.records(wildcards)
        ]

    def judged(self, wildcards) -> list[str]:
        """Dense scans by the independent planar solver, of the models that it can describe."""
        run = wildcards.run
        self.study.needs_plain(run, "the judge", held=True)
        return [
            f"results/{run}/judge/{model}/{record}_{direction}.csv"
            for model, record, direction in self.study.curves(run)
            if model in PLANAR
        ]

    def judge_results(self, run) -> list[str]:
        """What the target `judge` makes for one run."""
        tables = [f"results/{run}/tables/judge_{name}.csv" for name in ("scan", "bands")]
        return [*tables, f"results/{run}/figures/judge.png"]

    def results(self, run) -> list[str]:
        """What the target makes for one run."""
        names = ("speed_accuracy", "stability", "energy_balance")
        tables = ("accuracy_summary", "ensemble_members")
        return [
            *(f"results/{run}/tables/{name}.csv" for name in (*names, *tables)),
            *(f"results/{run}/figures/{name}.png" for name in (*names, "chaos")),
        ]
