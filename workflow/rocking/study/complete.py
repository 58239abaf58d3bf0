"""What the rules of the complete building read, and what makes up its results."""

import itertools

from yade_scripts.model.building.complete import BACK_JOINTS
from yade_scripts.model.registry import COMPLETE, MODELS

CHECKS = {"linear": "linear", "level": "check"}  # kind of history to prefix of its keys


class Complete:
    """What `snakemake complete` reads and makes."""

    models = tuple(COMPLETE)

    def __init__(self, study):
        """Keep the study."""
        self.study = study

    def settings(self, run) -> dict:
        """Section complete of a run."""
        return self.study.runs[run]["complete"]

    def scene(self, wildcards) -> str:
        """Scene file of a curve, with the configured bricks and back joint."""
        if self.study.cfg(wildcards)["vertical_motion"] == "on":
            raise SystemExit(
                "error: complete: expected vertical_motion = off: the complete building has been "
                "checked under horizontal motion alone"
            )
        own, run = self.settings(wildcards.run), wildcards.run
        self.study.needs_plain(run, "the complete building", held=True)
        name = f"{wildcards.complete}_{own['coarsening']:g}_{own['back_joint']}"
        return f"results/{run}/complete/scenes/{name}.json"

    def scans(self, run) -> list[str]:
        """Dense scans by the reduction, which show where the curves begin."""
        return [f"results/{run}/screening/{m}/{r}_{d}.csv" for m, r, d in self.cases(run)]

    def twins(self, run) -> list[str]:
        """Dense scans of the two-way models beside the curves."""
        return [
            f"results/{run}/screening/{_twin(model)}/{record}_{direction}.csv"
            for model, record, direction in self.cases(run)
            if record in self.study.confirmed(run)
        ]

    def cases(self, run) -> list[tuple[str, str, str]]:
        """Model, record and direction of every curve of a run."""
        models, directions = self.settings(run)["models"], self.study.runs[run]["directions"]
        return list(itertools.product(models, self.study.records[run], directions))

    def curves(self, run) -> list[str]:
        """IDA tables of a run's complete buildings: curves that YADE runs."""
        confirmed = self.study.confirmed(run)
        return [
            f"results/{run}/ida/{m}/{r}_{d}.csv" for m, r, d in self.cases(run) if r in confirmed
        ]

    # checks

    def _name(self, run, model, coarsening=None, back=None) -> str:
        own = self.settings(run)
        size = own["coarsening"] if coarsening is None else coarsening
        return f"{model}_{size:g}_{back or own['back_joint']}"

    def check_motion(self, wildcards) -> str:
        """Floor motions of the record of the checks."""
        run = wildcards.run
        record = self.settings(run)["check_record"]
        self.study.needed(run, "complete.check_record", [record])
        return self.study.floor_motions(run, record)

    def motion(self, wildcards) -> str:
        """Motion of a history of the checks."""
        if wildcards.kind in ("linear", "level"):
            return self.check_motion(wildcards)
        return f"results/{wildcards.run}/complete/pulse.csv"

    def how(self, wildcards) -> str:
        """Options of a history of the checks."""
        own, kind = self.settings(wildcards.run), wildcards.kind
        pga_g = own["check_pga_g" if kind == "level" else "linear_pga_g"]
        options = [f"--direction {own['check_direction']} --pga {pga_g:g}"]
        if kind in ("linear", "level"):
            options.append(f"--until {own[f'{CHECKS[kind]}_duration_s']:g}")
        return " ".join(options + ["--apart"] * (kind == "apart"))

    def scenes_of(self, model):
        """Input function: scenes of all coarsenings."""
        return lambda w: [
            f"results/{w.run}/complete/scenes/{self._name(w.run, model, c)}.json"
            for c in self.settings(w.run)["convergence"]
        ]

    def histories_of(self, model, kind):
        """Input function: histories of the curves' brick size."""
        return lambda w: [
            f"results/{w.run}/complete/histories/{self._name(w.run, model)}_{kind}.csv"
        ]

    def levels(self, folder, ending):
        """Input function: one file of each brick size, and of the other back joint."""

        def files(wildcards):
            run, own = wildcards.run, self.settings(wildcards.run)
            other = next(b for b in BACK_JOINTS if b != own["back_joint"])
            names = [self._name(run, "CB", c) for c in own["convergence"]]
            names.append(self._name(run, "CB", back=other))
            return [f"results/{run}/complete/{folder}/{name}{ending}" for name in names]

        return files

    def results(self, run) -> list[str]:
        """Everything the target `complete` makes for one run."""
        tables = ("checks", "convergence", "collapse", "probability")
        own = self.settings(run)
        case = f"{own['check_record']}_{own['check_direction']}"
        figures = [
            "complete_ida",
            *(f"complete_collapse_{model}_{case}" for model in own["models"]),
        ]
        return [
            *(f"results/{run}/tables/complete_{name}.csv" for name in tables),
            *(f"results/{run}/figures/{name}.png" for name in figures),
        ]


def _twin(model) -> str:
    """Name of the two-way model with the same joint."""
    how = ("floors", COMPLETE[model].bonded, True)
    return next(m.name for m in MODELS.values() if (m.walls, m.bonded, m.massive) == how)
