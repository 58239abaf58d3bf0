# Configuration, run names and paths; shared by every rule file.
import os
import re
import shutil
import sys
from dataclasses import asdict
from pathlib import Path

BASE = Path(workflow.basedir)
sys.path[:0] = [str(BASE / "workflow"), str(BASE)]

from rocking import config as configuration
from rocking import file_times, progress, run_lock
from rocking.records import RecordError, read_table, surrogates_for
from yade_scripts import lifeline
from yade_scripts.journal import PHYSICS

# YADE's library loads only in the Python it was built for, the system's own
YADE_PYTHON = os.environ.get("YADE_PYTHON") or shutil.which("python3", path=os.defpath)
os.environ[lifeline.RUN_PID] = str(os.getpid())  # jobs end with this process
STYLE = str(BASE / "workflow" / "rocking" / "paper.mplstyle")


def stop(error):
    """End with one line instead of a traceback."""
    sys.exit(f"error: {error}")


def table_path(resolved):
    """Path of a run's records table: as given, or beside the Snakefile if it is not found there."""
    given = Path(resolved["records_table"])
    beside = BASE / given
    return str(beside if not given.exists() and beside.exists() else given)


def record_names(run):
    """Names of the records of a run, in the order of its table."""
    rows = TABLES[run]
    wanted = RUNS[run]["records"]
    if wanted == "all":
        return list(rows)
    unknown = [name for name in wanted if name not in rows]
    if unknown:
        raise configuration.ConfigError(
            f"records: '{unknown[0]}' is not in {RUNS[run]['records_table']}; "
            f"expected names from {', '.join(rows)}"
        )
    return list(wanted)


try:
    configuration.check_files(
        [path for path in workflow.configfiles if Path(path).exists()]
    )
    RUNS = configuration.expand_scenarios(config)
    TABLES = {run: read_table(table_path(resolved)) for run, resolved in RUNS.items()}
    RECORDS = {run: record_names(run) for run in RUNS}
except (configuration.ConfigError, RecordError) as error:
    stop(error)


def cfg(wildcards):
    """Resolved configuration of the run that a job belongs to."""
    return RUNS[wildcards.run]


def per_run(targets):
    """Targets of every run of the study."""
    return [path for run in RUNS for path in targets(run)]


def params_of(*paths):
    """Params function: the parts of the configuration that a rule depends on, as JSON."""
    return lambda wildcards: configuration.relevant(cfg(wildcards), *paths)


def module(*names):
    """Source files that a rule depends on, so that editing one reruns it."""
    return [str(BASE / name) for name in names]


def package(folder):
    """All source files of a package."""
    return sorted(str(path) for path in (BASE / folder).rglob("*.py"))


def caption(name):
    """Path of a figure's caption template."""
    return str(BASE / "workflow" / "report" / f"{name}.rst")


wildcard_constraints:
    run="|".join(re.escape(name) for name in RUNS),
    record="|".join(sorted({re.escape(r) for rows in TABLES.values() for r in rows})),
    model="W1|W1c|W2|W2c|W3",
    direction="pos|neg",
    n=r"\d+",


# On a cluster these run where Snakemake runs: submitting them would take longer.
localrules:
    scene,
    record,
    records_table,
    floor_motions,
    ida_collapse,
    figure_record,
    figure_floor_motions,
    fig09_ida,


onstart:
    try:
        run_lock.hold()
        for name, resolved in RUNS.items():
            file_times.settle(f"results/{name}")
            configuration.write_resolved(resolved, f"results/{name}/config.yaml")
    except (run_lock.Busy, OSError) as error:
        stop(error)
    progress.Progress(ida_curves(workflow.dag)).watch()
