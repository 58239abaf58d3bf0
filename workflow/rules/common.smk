# The runs, their sources and how YADE is started; shared by every rule file.
import json
import os
import re
import shlex
import shutil
import sys
from dataclasses import asdict
from functools import cache
from itertools import product
from pathlib import Path

try:
    import rocking
except ModuleNotFoundError as error:
    sys.exit(
        f"error: {error} in {sys.executable}: use this project's .venv/bin/snakemake,"
        " which `make setup` makes"
    )
from rocking.collapse.case import SECTIONS
from rocking.configuration import config as configuration
from rocking.configuration import unlikely
from rocking.configuration.chosen import chosen
from rocking.configuration.files import check_inline
from rocking.configuration.words import in_a_line
from rocking.records.intensity_measures import MEASURES
from rocking.records import RecordError, read_table
from rocking.records.check import check_runs, reach_g
from rocking.runtime import (
    cluster,
    command_line,
    declarations,
    file_times,
    first_page,
    interrupts,
    made_of,
    progress,
)
from rocking.runtime import results_folder, run_lock, stamps, terminal, warm
from rocking.runtime.fallback import left_out_if_unknown
from rocking.runs import CurveKey, Runs
from rocking.runs.names import any_of
from rocking import version
from snakemake.dag import DAG
from yade_scripts.engine import parent_process
from yade_scripts.lists import listed
from yade_scripts.model.registry import COMPLETE, MODELS, REFERENCE_MODELS, PUSHED, WITH_WALLS

# the project's folder: where this file is, or, if it was fetched alone as a module, the package's
BASE = Path(workflow.source_path("common.smk")).resolve().parents[2]
if not (BASE / "yade_scripts").is_dir():
    BASE = Path(rocking.__file__).resolve().parents[2]
STUDIES = BASE / "workflow" / "studies"  # one folder a study; none needs another, the core none
NAMES_OF_RUNS: list[str] = []
if workflow.modifier.is_main_snakefile():  # as a module it leaves the terminal to others
    with left_out_if_unknown("a quiet terminal"):
        terminal.thin_out(workflow.output_settings)
    terminal.name_targets(
        lambda: sorted(r.name for r in workflow.rules if not r.output and r.name != "main"),
        runs=NAMES_OF_RUNS,
    )
# YADE's library loads only in the Python it was built for, the system's own
YADE_PYTHON = os.environ.get("YADE_PYTHON") or shutil.which("python3", path=os.defpath)
YADE = shlex.join([str(YADE_PYTHON), str(BASE / "yade_scripts")])
LAW_FILE = str(BASE / "config" / "beta_law.json")
FIDELITY_FILE = str(BASE / "config" / "fidelity.yaml")
os.environ.update(MPLBACKEND="agg")  # figures are files; a notebook's backend is not there
os.environ[parent_process.RUN_PID] = str(os.getpid())  # jobs end with this process
STOPPED = "stopped: finished runs are kept; repeat the command to go on"


def stop(error):
    """End with one line instead of a traceback."""
    sys.exit(f"error: {error}")


if fault := results_folder.fault(RESULTS):
    stop(fault)
if workflow.is_main_process and (fault := command_line.fault(check_inline)):
    stop(fault)
with left_out_if_unknown("--until of rules one behind the other"):
    command_line.pass_through(DAG)
if (cores := workflow.resource_settings.cores) is not None and cores < 1:  # it would wait for ever
    stop(f"--cores {cores}: expected 1 or more")
try:
    configuration.check_files([path for path in workflow.configfiles if Path(path).exists()])
    RUNS = Runs(config, BASE)
    NAMES_OF_RUNS += RUNS.settings
    # Read before anything is planned. A faulty record ends what needs it, not the target `check`.
    FINDINGS = check_runs(RUNS, cache=".snakemake/records_check.json")
except (configuration.ConfigError, RecordError) as error:
    stop(error)

for folder in (".snakemake", *(f"{RESULTS}/{name}" for name in (".shared", *RUNS.settings))):
    if fault := results_folder.fault(folder):
        stop(fault)
RUNS.refuse(FINDINGS)
if workflow.is_main_process and "check" not in sys.argv:  # that target says so itself
    terminal.warn([str(f) for f in FINDINGS if f.status == "warning"])
if workflow.is_main_process:
    terminal.warn(unlikely.lines(RUNS.settings, RUNS.stated), most=unlikely.MOST, rest="")
    said = progress.planning(sum(len(RUNS.curves(run)) for run in RUNS.settings))
    if said and "check" not in sys.argv:
        print(said, file=sys.stderr, flush=True)

SHARED = RUNS.shared


def stamped(path):
    """Path of the stamp of a script; where it cannot be written, the end in one line."""
    try:
        return str(stamps.stamp(path))
    except OSError as error:
        stop(
            f"{error.filename}: {error.strerror}: expected a file or none; move away what is there"
        )


def code(script, study=None):
    """Input function: a script and all it imports, as one stamp.

    One more for the module of a study that one of the three scripts of `workflow/scripts/studies`
    calls: `figure.py` what the study draws, the others what it computes.
    """
    called = (
        STUDIES / study / ("figure.py" if script.stem == "figure" else "study.py")
        if study
        else None
    )
    return lambda w: [stamped(path) for path in (script, called) if path]


def command_code(name):
    """Input function: a command of `yade_scripts` or of a study, and all it imports, as one stamp."""
    places = [BASE / "yade_scripts" / "commands", *STUDIES.glob("*/yade")]
    path = next(p for place in places if (p := place / f"{name}.py").is_file())
    return lambda w: stamped(path)


@cache
def warn_once(line):
    """Print a warning that several jobs lead to."""
    terminal.warn([line])


def stations(wildcards):
    """Params function of what draws intervals: station of every record of a run."""
    if workflow.is_main_process and (said := RUNS.unnamed_stations(wildcards)):
        warn_once(said)
    return RUNS.stations(wildcards)


def value_of(dotted):
    """Params function: a key of a run's configuration, such as `ensemble.amplitude_spread`."""
    return lambda w: RUNS.key(dotted)(w.run)


def values_of(section, *keys):
    """Params function: the keys of a section that a rule depends on."""
    return lambda w: {key: RUNS.cfg(w)[section][key] for key in keys}


def plan_option(wildcards, input):
    """Option that hands a dense scan's plan to YADE; empty where there is none."""
    return f"--plan {shlex.quote(input.plan)}" if input.plan else ""


def caption(name):
    """Path of a caption's template, of the core or of a study."""
    places = [BASE / "workflow" / "report" / f"{name}.rst", *STUDIES.glob(f"*/captions/{name}.rst")]
    return str(next(filter(Path.is_file, places)))


def shown(path, about, category, result, **labels):
    """An output that the report shows, with the caption `about`."""
    all_labels = {"run": "{run}", **labels, "result": result}
    return report(path, caption=caption(about), category=category, labels=all_labels)


def shown_table(name, category, result, about=None):
    """Output of a table that the report shows."""
    return shown(results(f"tables/{name}.csv"), about or name, category, f"{result} (CSV)")


def figure(name, category, result, about=None, **labels):
    """Output of a figure: a PNG that the report shows, and a PDF."""
    path = results(f"figures/{name}")
    png = shown(f"{path}.png", about or name, category, result, **labels)
    return {"png": png, "pdf": f"{path}.pdf"}


wildcard_constraints:
    run=any_of(RUNS.settings),
    record=any_of(sorted({record for rows in RUNS.tables.values() for record in rows})),
    model="|".join(WITH_WALLS),
    direction="pos|neg",
    motions="[0-9a-f]+",
    chain="[0-9a-f]+",
    n=r"\d+",


# On a cluster these run where Snakemake runs: submitting them would take longer.
localrules:
    facade_case,
    record,
    records_table,
    floor_motions,
    ida_collapse,
    table_answer,
    answer,
    records_check,
    report_summary,
    report_table,
    report_provenance,
    table_run_times,
    pushover_case,
    pushover_curve,
    figure_record,
    figure_floor_motions,
    own_record,
    own_floor_motions,
    own_figure,
    shared_files,
    fig09_ida,


def say_answers(tables):
    """Print what the first few runs answer."""
    from rocking.collapse import answer  # slow to load
    from rocking.tables import read_frame

    for path in list(filter(Path.is_file, tables))[:4]:
        said = answer.lines(read_frame(path))
        print("\n".join([f"{path.parts[-3]}: {said[0]}", *said[1:]]), file=sys.stderr)


def lock(dag):
    """Take the locks that the jobs due ask for: none where records are checked and nothing else is made."""
    due = list(dag.needrun_jobs())
    if {job.rule.name for job in due} <= {"check", "records_check", "main"}:
        return
    folder = f"{RESULTS}/.shared/"
    making = {
        path[len(folder) :].partition("/")[0]: []
        for job in due
        for path in job.output
        if path.startswith(folder)
    }
    makers = [job for job in due if any(path.startswith(folder) for path in job.output)]
    reads = [keys["motions"] for keys in SHARED.keys.values()]
    locks = run_lock.hold(RUNS.settings, reads, making)
    run_lock.share(locks, lambda: all(dag.finished(job) for job in makers))


onstart:
    with left_out_if_unknown("own handling of interrupts"):
        interrupts.heed(workflow.scheduler)
    with left_out_if_unknown("a look at the cluster"):
        executor = workflow.executor_plugin.name
        if fault := cluster.fault(executor):
            stop(fault)
        terminal.warn(filter(None, [cluster.warning(executor)]))
    try:
        try:
            lock(workflow.dag)
            written = (
                (path, bool(path.is_directory))
                for job in workflow.dag.needrun_jobs()
                for path in (*job.output, *job.log)
            )
            if fault := results_folder.misplaced(written):
                raise ValueError(fault)
            file_times.settle(f"{RESULTS}/.shared")
            BY = version.stated()
            earlier = [
                configuration.changed(resolved, f"{RESULTS}/{name}/config.yaml")
                for name, resolved in RUNS.settings.items()
            ]
            terminal.warn(filter(None, earlier))
            for name, resolved in RUNS.settings.items():
                file_times.settle(f"{RESULTS}/{name}")
                lines = chosen(resolved, FIDELITY_FILE, LAW_FILE, RUNS.stated[name])
                choices = [f"By {BY}.", *lines]
                configuration.write_resolved(resolved, f"{RESULTS}/{name}/config.yaml", choices)
        except (run_lock.Busy, ValueError, OSError) as error:
            stop(error)
        with left_out_if_unknown("lines of progress"):
            tasks = progress.tasks_of(workflow, RUNS.known_runs)
            # none on a cluster, which has no such number
            cores = workflow.resource_settings.cores
            print(progress.opening(tasks, list(RUNS.settings), cores), file=sys.stderr)
            progress.Progress(tasks).watch()
        from rocking.formula import words  # slow to load

        for line in words.of_runs(RUNS.settings):
            print(line, file=sys.stderr)
        with left_out_if_unknown("a server of scripts"):
            warm.serve(workflow)
    except KeyboardInterrupt:
        sys.exit(STOPPED)


onsuccess:
    with left_out_if_unknown("the answer in a few lines"):
        if any(job.rule.name == "table_answer" for job in workflow.dag.jobs):
            say_answers(
                [Path(RESULTS) / run / "tables" / "answer.csv" for run in RUNS.settings]
            )
    folders = listed([f"{RESULTS}/{run}" for run in RUNS.settings])
    print(f"done: results in {folders}", file=sys.stderr)


onerror:
    print(STOPPED, file=sys.stderr)
