"""Which files the calibration of β needs and makes."""

from pathlib import Path

from rocking.calibration import FREE_ROCKING_HIGH_S, FREE_ROCKING_LOW_S
from rocking.configuration import config as configuration
from rocking.records import RecordError, read_table

CASES = "results/{run}/calibration/cases_{group}.json"
HISTORIES = "results/{run}/calibration/histories_{group}.npz"


class Calibration:
    """What `snakemake calibration` reads and makes."""

    def __init__(self, study):
        """Keep the study."""
        self.study = study

    def settings(self, run) -> dict:
        """Section calibration of a run."""
        return self.study.runs[run]["calibration"]

    def groups(self, run) -> list[str]:
        """Parts of the free-rocking study, a job each."""
        count = len(self.settings(run)["thickness_m"]) * len(self.settings(run)["e_mpa"])
        batches = [f"batch{i}" for i in range(1, count + 1)]
        return [*batches, "sensitivity", "free_rocking_wall"]

    def of_groups(self, pattern):
        """Input function: one file of every part of the study."""
        return lambda w: [pattern.format(run=w.run, group=g) for g in self.groups(w.run)]

    def wall(self, wildcards):
        """File of the tested wall, for the part that has one."""
        if wildcards.group != "free_rocking_wall":
            return []
        return self.study.beside(self.settings(wildcards.run)["free_rocking_wall"])

    def config(self, wildcards) -> str:
        """What a part depends on: an own wall is the configuration's, the study brings its own."""
        own = ("facade", "return_wall", "smdof", "numerics")
        more = own if wildcards.group == "own_wall" else ()
        return configuration.relevant(self.study.cfg(wildcards), "calibration", *more)

    def shake_table(self, key):
        """Input function: a file of the shake-table tests."""
        return lambda w: self.study.beside(self.settings(w.run)[f"shake_table_{key}"])

    def shake_table_files(self, wildcards) -> list[str]:
        """Record files of the shake-table motions; none for surrogates."""
        try:
            rows = read_table(self.shake_table("records")(wildcards))
        except RecordError as error:
            raise SystemExit(f"error: {error}") from None
        return [row.path for row in rows.values() if row.path]

    def choice_motion(self, wildcards) -> str:
        """Floor motions under which the laws are compared."""
        return self.study.floor_motions(wildcards.run, self.choice_record(wildcards))

    def choice_record(self, wildcards) -> str:
        """Record under which the laws are compared."""
        return self.settings(wildcards.run)["choice_record"]

    def choice_facts(self, wildcards) -> str:
        """Provenance of that record."""
        return f"results/{wildcards.run}/records/{self.choice_record(wildcards)}.json"

    def choice_scenes(self, wildcards) -> list[str]:
        """Scene of each IDA that compares the laws."""
        folder = f"results/{wildcards.run}/calibration/choice"
        return [f"{folder}/{m}_{law}.json" for m, _, law in self._choices(wildcards.run)]

    def choice_tables(self, wildcards) -> list[str]:
        """Table of each IDA that compares the laws."""
        folder = f"results/{wildcards.run}/calibration/choice"
        return [f"{folder}/{m}_{d}_{law}.csv" for m, d, law in self._choices(wildcards.run)]

    def _choices(self, run):
        directions = self.study.runs[run]["directions"]
        return [(m, d, law) for m in ("W1", "W2") for d in directions for law in ("eq5", "fitted")]

    def results(self, run) -> list[str]:
        """What `snakemake calibration` makes for one run."""
        tables = ["free_rocking", "beta_fit", "beta_walls", "beta_regression", "shake_table"]
        settings = self.settings(run)
        tested = Path(settings["free_rocking_wall"]).stem == "sorrentino"
        if tested and {*FREE_ROCKING_LOW_S, *FREE_ROCKING_HIGH_S} <= set(
            settings["free_rocking_beta_s"]
        ):
            tables.append("claims_calibration")
        figures = ["fig04_calibration", "fig05_sorrentino", "fig06_shawa", "damping_choice"]
        return [
            *(f"results/{run}/tables/{name}.csv" for name in tables),
            *(f"results/{run}/figures/{name}.png" for name in figures),
        ]

    def wall_results(self, run) -> list[str]:
        """What `snakemake calibrate_wall` makes for one run."""
        return [f"results/{run}/tables/wall_beta.csv", f"results/{run}/figures/wall_beta.png"]
