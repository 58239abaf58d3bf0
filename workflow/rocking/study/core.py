"""Runs of a study, their configurations and records, and the files of the main job."""

from itertools import product
from pathlib import Path
from typing import Any

from rocking.configuration import config as configuration
from rocking.records import read_table, surrogates_for
from rocking.study.shared import Shared
from yade_scripts.model.registry import MODELS, PUSHED
from yade_scripts.model.shape import is_plain, refuse


class Study:
    """The runs that a configuration describes.

    Parameters
    ----------
    config : mapping
        Snakemake's merged configuration.
    base : Path
        Folder of the Snakefile; files of the configuration are looked for in the working folder
        first, then here.

    Attributes
    ----------
    name : str
        Name that all runs begin with, `run` of the configuration.
    runs : dict of str to dict
        Resolved configuration of each run.
    tables : dict of str to dict
        Rows of its records table, by record.
    records : dict of str to list of str
        Names of the records it uses.

    Raises
    ------
    ConfigError, RecordError
        In one line, for whatever is wrong with configuration or records table.
    """

    def __init__(self, config, base):
        """Resolve the configuration and read the records tables."""
        self.base = Path(base)
        self.runs = configuration.expand_scenarios(config)
        self.name = str(config.get("run") or "main")
        self.tables = {run: read_table(self.table_path(run)) for run in self.runs}
        self.records = {run: self._record_names(run) for run in self.runs}
        self.shared = Shared(self.runs)
        self.faults: dict[tuple[str, str], str] = {}
        for run, resolved in self.runs.items():
            if resolved["vertical_motion"] == "on":
                self.check_vertical(run, "vertical_motion = on", self.records[run])

    def cfg(self, wildcards) -> dict[str, Any]:
        """Resolved configuration of the run that a job belongs to."""
        return self.runs[wildcards.run]

    def per_run(self, targets) -> list[str]:
        """Targets of every run; `targets` maps a run's name to paths."""
        return [path for run in self.runs for path in targets(run)]

    def params_of(self, *paths):
        """Params function: the parts of the configuration that a rule depends on, as JSON."""
        return lambda wildcards: configuration.relevant(self.cfg(wildcards), *paths)

    def beside(self, path) -> str:
        """A file as given, or beside the Snakefile if it is not found there."""
        near = self.base / path
        return str(near if not Path(path).exists() and near.exists() else path)

    def table_path(self, run) -> str:
        """Path of a run's records table."""
        return self.beside(self.runs[run]["records_table"])

    def _record_names(self, run) -> list[str]:
        wanted = self.runs[run]["records"]
        return list(self.tables[run]) if wanted == "all" else self.known(run, "records", wanted)

    def check_vertical(self, run, key, names):
        """Refuse records without a vertical motion.

        Raises
        ------
        ConfigError
            In one line with the key that needs it, the table and its line.
        """
        for row in (self.tables[run][name] for name in names):
            if row.vertical_path is None:
                raise configuration.ConfigError(
                    f"{key}: {self.runs[run]['records_table']}, line {row.line}: record "
                    f"{row.record} has no vertical motion; expected it in the column vertical or "
                    "vertical_file"
                )

    def known(self, run, key, names) -> list[str]:
        """Return record names that a configuration key gives.

        Raises
        ------
        ConfigError
            In one line for a name that is not in the run's table.
        """
        for name in names:
            if name not in self.tables[run]:
                raise configuration.ConfigError(
                    f"{key}: '{name}' is not in {self.runs[run]['records_table']}; "
                    f"expected names from {', '.join(self.tables[run])}"
                )
        return list(names)

    def needed(self, run, key, names) -> list[str]:
        """Like `known`, where only some targets need the names: ends the workflow in one line."""
        try:
            return self.known(run, key, names)
        except configuration.ConfigError as error:
            raise SystemExit(f"error: {error.detail}") from None

    def needs_plain(self, run, what, held=False):
        """End the workflow in one line where `shape.refuse` would end a job of it."""
        try:
            refuse(self.runs[run]["facade"], what, held)
        except ValueError as error:
            raise SystemExit(f"error: {error}") from None

    # one record

    def refuse(self, findings):
        """Remember which records are faulty (`records.check`), for jobs that need one of them."""
        faults = [finding for finding in findings if finding.status == "fault"]
        more = f" (and {len(faults) - 1} more: see the target check)" if faults[1:] else ""
        self.faults = {(f.record, f.file): f"error: {f}{more}" for f in faults}

    def record_row(self, wildcards):
        """Row of the records table."""
        return self.tables[wildcards.run][wildcards.record]

    def record_file(self, wildcards):
        """The accelerogram's file; nothing for a surrogate.

        A record that was found faulty ends the workflow in one line.
        """
        row = self.record_row(wildcards)
        if fault := self.faults.get((row.record, row.path or "")):
            raise SystemExit(fault)
        return row.path or []

    def record_files(self, wildcards):
        """Files of all records of a run, vertical motions included."""
        rows = [self.tables[wildcards.run][name] for name in self.records[wildcards.run]]
        paths = [path for row in rows for path in (row.path, row.vertical_path) if path]
        return list(dict.fromkeys(paths))

    def surrogate_parameters(self, wildcards):
        """File of the surrogates' parameters, for a record without a file of its own."""
        if self.record_row(wildcards).path is not None:
            return []
        return surrogates_for(self.table_path(wildcards.run)) or []

    def facts_of(self, run) -> list[str]:
        """Provenance files of all records of a run."""
        return [self.shared.path(run, f"records/{name}.json") for name in self.records[run]]

    def record_facts(self, wildcards):
        """Those of a job's run."""
        return self.facts_of(wildcards.run)

    def all_facts(self, wildcards=None) -> list[str]:
        """Those of all runs, each file once."""
        return list(dict.fromkeys(self.per_run(self.facts_of)))

    def floor_motions(self, run, record) -> str:
        """Floor motions of a record."""
        return self.shared.floor_motions(run, record)

    def ida_motion(self, wildcards) -> str:
        """Floor motions of a job's record."""
        return self.floor_motions(wildcards.run, wildcards.record)

    # curves

    def curves(self, run) -> list[tuple[str, str, str]]:
        """Model, record and direction of every curve of a run."""
        resolved = self.runs[run]
        return list(product(resolved["models"], self.records[run], resolved["directions"]))

    def confirmed(self, run) -> list[str]:
        """Records whose dense scans YADE confirms: one of every `ida.confirm_every`, in order."""
        return self.records[run][:: self.runs[run]["ida"]["confirm_every"]]

    def ida_tables(self, run) -> list[str]:
        """IDA tables of a run, by model, record and direction: curves that YADE runs."""
        confirmed = self.confirmed(run)
        return [
            f"results/{run}/ida/{model}/{record}_{direction}.csv"
            for model, record, direction in self.curves(run)
            if record in confirmed or not self.scanned(run, model)
        ]

    def known_runs(self, job):
        """Number of runs of a curve's job where its strategy fixes it, else None."""
        if job.rule.name not in ("ida", "reduction_ida"):
            return None
        ida = self.cfg(job.wildcards)["ida"]
        return len(ida["grid_g"]) if ida["mode"] == "grid" else None

    def scanned(self, run, model) -> bool:
        """Whether the curves of a model follow a dense scan by the planar solver."""
        return MODELS[model].scanned and self.runs[run]["ida"]["mode"] != "grid"

    def plan(self, wildcards):
        """What YADE is to run, from the dense scan; nothing where there is none."""
        w = wildcards
        if not self.scanned(w.run, w.model):
            return []
        return f"results/{w.run}/screening/{w.model}/{w.record}_{w.direction}.json"

    def scans(self, run) -> list[str]:
        """Dense scans of a run's curves."""
        return [
            f"results/{run}/screening/{model}/{record}_{direction}.csv"
            for model, record, direction in self.curves(run)
            if self.scanned(run, model)
        ]

    def ensemble_tables(self, run) -> list[str]:
        """Ensemble tables of a run; none where config switches them off."""
        if self.runs[run]["ensemble"]["enabled"] == "off":
            return []
        return [path.replace(".csv", "_ensemble.csv") for path in self.ida_tables(run)]

    def static_curves(self, run) -> list[str]:
        """Pushover curves behind Figure 9: of the models that have one of their own.

        None of a façade with a shape or hinges, whose pushover is not known.
        """
        facade = self.runs[run]["facade"]
        if facade["hinges_m"] or not is_plain(facade):
            return []
        models = [name for name in PUSHED if name in self.runs[run]["models"]]
        return [f"results/{run}/pushover/{name}.csv" for name in models]

    def main_results(self, run) -> list[str]:
        """What the main job makes for one run."""
        return [
            *(f"results/{run}/tables/{name}.csv" for name in ("records", "shared")),
            *(f"results/{run}/tables/{t}.csv" for t in ("ida_collapse", "collapse_probability")),
            f"results/{run}/figures/fig09_ida.png",
        ]
