"""Runs of a configuration: their settings, records and curves."""

from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

from rocking.configuration import config as configuration
from rocking.configuration.schema import value_at
from rocking.records import floor_table, read_table, surrogates_for
from rocking.runs.shared import Shared
from rocking.stations import unnamed
from yade_scripts.lists import one_of
from yade_scripts.model import storeys
from yade_scripts.model.facades import Facade
from yade_scripts.model.registry import MODELS, PUSHED


class CurveKey(NamedTuple):
    """What one incremental dynamic analysis is of."""

    model: str
    record: str
    direction: str


class Runs:
    """The runs that a configuration describes; `name` is what the names of all begin with.

    By run: `settings`, its resolved configuration; `stated`, what the user's configuration says of
    it, scenario and grid included; `tables`, the rows of its records table by record; `records`,
    the names of those that it uses.
    """

    def __init__(self, config, folder):
        """Resolve Snakemake's merged configuration and read the records tables.

        Files are looked for in the working folder first, then in `folder`, that of the Snakefile. A
        ConfigError or RecordError of one line for whatever is wrong with them.
        """
        self.folder = Path(folder)
        known = configuration.expanded(config)
        self.settings = {run: resolved for run, (resolved, _) in known.items()}
        self.stated = {run: stated for run, (_, stated) in known.items()}
        self.name = str(config.get("run") or "main")
        self.tables = {run: read_table(self.table_path(run)) for run in self.settings}
        self.records = {run: self._record_names(run) for run in self.settings}
        self.shared = Shared(self.settings)
        self.faults: dict[tuple[str, str], str] = {}
        for run, resolved in self.settings.items():
            if resolved["vertical_motion"] == "on":
                self.check_vertical(run, "vertical_motion = on", self.records[run])
            for row in self._rows(run):
                if row.floors_path:
                    from rocking.runs.floors import refuse

                    refuse(resolved, row)

    def cfg(self, wildcards) -> dict[str, Any]:
        """Resolved configuration of the run that a job belongs to."""
        return self.settings[wildcards.run]

    def key(self, dotted):
        """Return the function of a run's name that looks up a key of its configuration."""
        return lambda run: value_at(self.settings[run], dotted)

    def named(self, dotted):
        """Like `key`, for names of records; ends the workflow in one line if one is unknown."""

        def names(run):
            wanted = self.key(dotted)(run)
            return self.needed(run, dotted, [wanted] if isinstance(wanted, str) else wanted)

        return names

    def params_of(self, *paths):
        """Params function: the parts of the configuration that a rule depends on, as JSON."""
        return lambda wildcards: configuration.relevant(self.cfg(wildcards), *paths)

    def find_file(self, path) -> str:
        """A file as given, or beside the Snakefile if it is not found there."""
        near = self.folder / path
        return str(near if not Path(path).exists() and near.exists() else path)

    def table_path(self, run) -> str:
        """Path of a run's records table."""
        return self.find_file(self.settings[run]["records_table"])

    def _record_names(self, run) -> list[str]:
        wanted = self.settings[run]["records"]
        return list(self.tables[run]) if wanted == "all" else self.known(run, "records", wanted)

    def check_vertical(self, run, key, names):
        """Refuse records without a vertical motion: the key that needs it, the table, its line."""
        for row in (self.tables[run][name] for name in names):
            if row.vertical_path is None:
                raise configuration.ConfigError(
                    f"{key}: {self.settings[run]['records_table']}, line {row.line}: record "
                    f"{row.record} has no vertical motion; expected it in the column vertical or "
                    "vertical_file"
                )

    def known(self, run, key, names) -> list[str]:
        """Return record names that a configuration key gives; refuse what is not in the table."""
        for name in names:
            if name not in self.tables[run]:
                raise configuration.ConfigError(
                    f"{key}: '{name}' is not in {self.settings[run]['records_table']}; "
                    f"{one_of(self.tables[run], name)}"
                )
        return list(names)

    def needed(self, run, key, names) -> list[str]:
        """Like `known`, where only some targets need the names: ends the workflow in one line."""
        try:
            return self.known(run, key, names)
        except configuration.ConfigError as error:
            raise SystemExit(f"error: {error.detail}") from None

    def facade(self, run) -> Facade:
        """Façade of a run."""
        return Facade.of(self.settings[run]["facade"])

    def needs_plain(self, run, what, held=False):
        """End the workflow in one line where `Facade.refuse` would end a job of it."""
        try:
            self.facade(run).refuse(what, held)
        except ValueError as error:
            raise SystemExit(f"error: {error}") from None

    def needs_dry(self, run):
        """End the workflow in one line where the reference solver would end a job of it."""
        try:
            self.facade(run).refuse_bonds("the reference solver")
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

    def station(self, wildcards):
        """Station of a record."""
        return self.record_row(wildcards).station

    def stations(self, wildcards):
        """Station of every record of a run."""
        return {row.record: row.station for row in self._rows(wildcards.run)}

    def unnamed_stations(self, wildcards):
        """What follows where a run's table names no stations; empty where nothing does."""
        said = unnamed(self._rows(wildcards.run))
        return f"{self.table_path(wildcards.run)}: {said}" if said else ""

    def _rows(self, run):
        return [self.tables[run][name] for name in self.records[run]]

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
        rows = self._rows(wildcards.run)
        paths = [path for row in rows for path in (row.path, row.vertical_path) if path]
        return list(dict.fromkeys(paths))

    def floor_files(self, wildcards):
        """Files of the floor motions that another program computed for a record."""
        return floor_table.files_of(self.record_row(wildcards))

    def floors(self, wildcards):
        """What a record's row says of them: the table's and the file's name; None: none."""
        row = self.record_row(wildcards)
        return row.floors_path and [self.table_path(wildcards.run), row.floors_building]

    def surrogate_parameters(self, wildcards):
        """File of the surrogates' parameters, for a record without a file of its own."""
        if self.record_row(wildcards).path is not None:
            return []
        return surrogates_for(self.table_path(wildcards.run)) or []

    # curves

    def wildcards(self, run) -> dict[str, Any]:
        """Values that the wildcards of a path take in a run; lists where it has several."""
        resolved = self.settings[run]
        return {
            "run": run,
            "model": resolved["models"],
            "record": self.records[run],
            "direction": resolved["directions"],
            "n": resolved["smdof"]["n_dof"],
            **self.shared.keys[run],
        }

    def curves(self, run) -> list[CurveKey]:
        """Every curve of a run."""
        resolved = self.settings[run]
        keys = product(resolved["models"], self.records[run], resolved["directions"])
        return [CurveKey(*names) for names in keys]

    def confirmed(self, run) -> list[str]:
        """Records whose dense scans YADE confirms: one of every `ida.confirm_every`, or one."""
        every = self.settings[run]["ida"]["confirm_every"]
        return self.records[run][:: every or len(self.records[run])]

    def scanned(self, run, model) -> bool:
        """Whether the curves of a model follow a dense scan by the planar solver."""
        return MODELS[model].scanned and self.settings[run]["ida"]["mode"] != "grid"

    def scans(self, run) -> list[CurveKey]:
        """Curves that a dense scan stands behind."""
        return [curve for curve in self.curves(run) if self.scanned(run, curve.model)]

    def by_yade(self, run) -> list[CurveKey]:
        """Curves that YADE runs: none of a pushed building whose loops its sliders cannot do."""
        settings, confirmed = self.settings[run], self.confirmed(run)
        one_way = settings["directions"][: None if settings["ida"]["confirm_every"] else 1]
        slides = storeys.slides(settings["smdof"])
        return [
            curve
            for curve in self.curves(run)
            if not self.scanned(run, curve.model)
            or (
                (curve.record in confirmed and curve.direction in one_way)
                and (slides or not MODELS[curve.model].two_way)
            )
        ]

    def ensembles(self, run) -> list[CurveKey]:
        """Curves with a perturbed ensemble; none where config switches them off."""
        return [] if self.settings[run]["ensemble"]["enabled"] == "off" else self.by_yade(run)

    def pushed(self, run) -> list[str]:
        """Models with a pushover curve of their own.

        None of a façade with a shape or hinges, whose pushover is not known.
        """
        facade, models = self.facade(run), self.settings[run]["models"]
        known = not (facade.hinges_m or facade.courses) and facade.is_plain
        return [name for name in PUSHED if known and name in models]

    def compiled(self, run) -> list[str]:
        """Models that the compiled planar solver stands in for."""
        return [model for model in self.settings[run]["models"] if MODELS[model].compiled]

    def known_runs(self, job):
        """Number of YADE's runs in a curve's job where its strategy fixes it, else None."""
        if job.rule.name not in ("ida", "reduction_ida"):
            return None
        ida = self.cfg(job.wildcards)["ida"]
        return len(ida["grid_g"]) if ida["mode"] == "grid" else None
