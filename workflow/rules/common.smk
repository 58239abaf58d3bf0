# Configuration, run names and paths; shared by every rule file.
import re
import os
import sys
from pathlib import Path

from snakemake.exceptions import WorkflowError

BASE = Path(workflow.basedir)
for folder in (BASE / "workflow", BASE):
    sys.path.insert(0, str(folder))
# jobs are processes of their own and import the same packages
os.environ["PYTHONPATH"] = os.pathsep.join(
    [str(BASE), str(BASE / "workflow"), *filter(None, [os.environ.get("PYTHONPATH")])]
)

from rocking import config as configuration
from rocking.records import RecordError, read_table

# YADE's library loads only in the Python it was built for, Debian's own
YADE_PYTHON = os.environ.get("YADE_PYTHON", "/usr/bin/python3")
STYLE = str(BASE / "workflow" / "rocking" / "paper.mplstyle")


def stop(error):
    """End with one line instead of a traceback."""
    raise WorkflowError(str(error)) from None


def table_path(resolved):
    """Path of a run's records table: as given, or beside the Snakefile if it is not found there."""
    given = Path(resolved["records_table"])
    beside = BASE / given
    return str(beside if not given.exists() and beside.exists() else given)


try:
    RUNS = configuration.expand_scenarios(config)
    TABLES = {run: read_table(table_path(resolved)) for run, resolved in RUNS.items()}
except (configuration.ConfigError, RecordError) as error:
    stop(error)


def cfg(wildcards):
    """Resolved configuration of the run that a job belongs to."""
    return RUNS[wildcards.run]


def record_names(run):
    """Names of the records of a run, in the order of its table."""
    rows = TABLES[run]
    wanted = RUNS[run]["records"]
    if wanted == "all":
        return list(rows)
    unknown = [name for name in wanted if name not in rows]
    if unknown:
        stop(
            f"config: records: '{unknown[0]}' is not in {RUNS[run]['records_table']}; "
            f"expected names from {', '.join(rows)}"
        )
    return list(wanted)


def per_run(targets):
    """Targets of every run of the study."""
    return [path for run in RUNS for path in targets(run)]


def params_of(*paths):
    """Params function: the parts of the configuration that a rule depends on, as JSON."""
    return lambda wildcards: configuration.relevant(cfg(wildcards), *paths)


def module(*names):
    """Source files that a rule depends on, so that editing one reruns it."""
    return [str(BASE / name) for name in names]


def yade_modules():
    """Modules of every run inside YADE."""
    names = "quadrature scene stiffness facade engine simulate intensities journal run_ida"
    return module(*(f"yade_scripts/{name}.py" for name in names.split()))


def caption(name):
    """Path of a figure's caption template."""
    return str(BASE / "workflow" / "report" / f"{name}.rst")


for run_name in RUNS:
    record_names(run_name)  # unknown names are refused before any job


wildcard_constraints:
    run="|".join(re.escape(name) for name in RUNS),
    record="|".join(sorted({re.escape(r) for rows in TABLES.values() for r in rows})),
    model="W1|W1c|W2|W2c|W3",
    direction="pos|neg",
    n=r"\d+",


onstart:
    for name, resolved in RUNS.items():
        configuration.write_resolved(resolved, f"results/{name}/config.yaml")
