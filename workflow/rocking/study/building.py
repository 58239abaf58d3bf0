"""What the rules of the building read, and what makes up its results."""

from pathlib import Path

from yade_scripts.model.gravity import GRAVITY_M_S2
from yade_scripts.model.registry import MODELS

MODEL_KEYS = [
    "brick_length_m",
    "brick_height_m",
    "brick_width_m",
    "coarsening",
    "head_jkn_pa_m",
    "head_jks_pa_m",
    "bed_jkn_pa_m",
    "bed_jks_pa_m",
    "collar_jkn_pa_m",
    "collar_jks_pa_m",
    "timber_jkn_pa_m",
    "timber_jks_pa_m",
    "density_kg_m3",
    "timber_density_kg_m3",
    "fit_period_s",
]
WME_KEYS = ["damping_ratio", "wme_longest_period_s", "wme_highest_frequency_hz", "wme_gain"]
TABLES = [
    "building_modes",
    "wme",
    "building_chain",
    "building_convergence",
    "building_explicit_cost",
]


class Building:
    """What `snakemake building` reads and makes."""

    def __init__(self, study):
        """Keep the study."""
        self.study = study

    def settings(self, run) -> dict:
        """Section building of a run."""
        return self.study.runs[run]["building"]

    def keys(self, *more):
        """Params function: the keys of the section that a rule depends on."""
        return lambda w: {key: self.settings(w.run)[key] for key in (*MODEL_KEYS, *more)}

    def wme_keys(self, wildcards) -> dict:
        """Keys of the section that the comparison with chains depends on."""
        return {key: self.settings(wildcards.run)[key] for key in WME_KEYS}

    def _plan_file(self, key, path, section="building") -> str:
        found = self.study.beside(path)
        if not Path(found).exists():
            raise SystemExit(f"error: {section}.{key}: there is no file '{path}'")
        return found

    def plan(self, wildcards) -> str:
        """Plan file of a job's run."""
        return self._plan_file("plan", self.settings(wildcards.run)["plan"])

    def mass_of_walls(self, wildcards) -> list[str]:
        """File with the building's mass, where a model's walls carry it and none is stated."""
        stated = self.study.cfg(wildcards)["return_wall"]["building_mass_kg"]
        needed = MODELS[wildcards.model].massive and stated is None
        return [f"results/{wildcards.run}/building/fit.json"] if needed else []

    def all_plans(self, wildcards) -> list[str]:
        """Plan file of a job's run and the alternatives to it."""
        others = self.settings(wildcards.run)["alternative_plans"]
        rest = [self._plan_file("alternative_plans", path) for path in others]
        return [self.plan(wildcards), *rest]

    def search_plan(self, wildcards) -> str:
        """Plan file that the search starts from."""
        path = self.study.runs[wildcards.run]["building_search"]["plan"]
        return self._plan_file("plan", path, "building_search")

    def compared_plans(self, wildcards) -> list[str]:
        """Plan files that stand beside what the search found."""
        paths = self.study.runs[wildcards.run]["building_search"]["plans"]
        return [self._plan_file("plans", path, "building_search") for path in paths]

    def search_keys(self, wildcards) -> dict:
        """Params function: the section of the search."""
        section = self.study.runs[wildcards.run]["building_search"]
        return {key: value for key, value in section.items() if key not in ("plan", "plans")}

    def is_case_study(self, wildcards) -> bool:
        """True where the study's own figures belong beside the results."""
        return Path(self.settings(wildcards.run)["plan"]).stem.startswith("case_study")

    def records(self, run, key) -> list[str]:
        """Records named by a key of the section."""
        return self.study.needed(run, f"building.{key}", self.settings(run)[key])

    def of_wme_records(self, pattern):
        """Input function: one file of every record that is compared with chains."""
        return lambda w: [
            pattern.format(run=w.run, record=record)
            for record in self.records(w.run, "wme_records")
        ]

    def explicit_scene(self, wildcards) -> str:
        """Scene of the explicit run."""
        coarsening = self.settings(wildcards.run)["explicit_coarsening"]
        return f"results/{wildcards.run}/building/explicit_scene_{coarsening:g}.json"

    def costs(self, wildcards) -> list[str]:
        """Costs of the modes by coarsening."""
        return [
            f"results/{wildcards.run}/building/cost_{model}_{c:g}.json"
            for model in ("CBDEM", "SBDEM")
            for c in self.settings(wildcards.run)["convergence"]
        ]

    def explicit_costs(self, wildcards) -> list[str]:
        """Costs of the explicit run by coarsening."""
        return [
            f"results/{wildcards.run}/building/explicit_cost_{c:g}.json"
            for c in self.settings(wildcards.run)["explicit_convergence"]
        ]

    def sudden_gravity(self, load) -> float:
        """Downward acceleration from the first step on [m/s²], of runs "plain" and "loaded"."""
        return {"plain": 0.0, "loaded": GRAVITY_M_S2}[load]

    def explicit_tables(self, wildcards) -> list[str]:
        """Explicit against modal run of every record that is run explicitly."""
        records = self.records(wildcards.run, "explicit_records")
        return [f"results/{wildcards.run}/tables/building_explicit_{r}.csv" for r in records]

    def results(self, run) -> list[str]:
        """Everything the target `building` makes for one run."""
        names = [f"tables/{name}.csv" for name in TABLES]
        if self.settings(run)["alternative_plans"]:
            names.append("tables/building_alternatives.csv")
        figures = ["fig01_building", "fig02_modes"]
        figures += [f"fig03_{record}" for record in self.records(run, "wme_records")]
        for record in self.records(run, "explicit_records"):
            figures.append(f"fig03_rattling_{record}")
            names.append(f"tables/building_explicit_{record}.csv")
        if Path(self.settings(run)["plan"]).stem.startswith("case_study"):
            names.append("tables/claims_building.csv")
        names += [f"figures/{name}.png" for name in figures]
        return [f"results/{run}/{name}" for name in names]

    def periods(self, run) -> list[str]:
        """Periods and equivalent chain of a run's building."""
        return [f"results/{run}/tables/{name}.csv" for name in ("building_modes", "building_chain")]

    def search_results(self, run) -> list[str]:
        """What the search for the study's building makes."""
        names = ["tables/building_search.csv", "tables/building_search_best.csv"]
        return [f"results/{run}/{name}" for name in (*names, "figures/building_search.png")]

    def reading_results(self, run) -> list[str]:
        """Table 2 under every reading."""
        return [f"results/{run}/tables/{name}.csv" for name in ("wme_readings", "wme_lowest")]
