"""What a run prints: errors, warnings, and a line a minute (progress.py).

Snakemake tells every job three times. On the terminal that hides what matters, so a filter leaves
it to Snakemake's log file, which keeps all of it. Snakemake's own `quiet` would thin out that file
as well, and hide the errors of jobs with their announcements.
"""

import difflib
import logging
import re
import sys

from yade_scripts.lists import listed

HIDDEN = {  # names of snakemake_interface_logger_plugins.common.LogEvent
    *("WORKFLOW_STARTED", "RUN_INFO", "RESOURCES_INFO", "JOB_INFO", "JOB_STARTED"),
    *("JOB_FINISHED", "GROUP_INFO", "PROGRESS", "SHELLCMD"),
}
CHATTER = ("Assuming unrestricted", "Building DAG", "Using shell", "Select jobs to execute")

MAX_WARNINGS = 5


def warn(lines, most=MAX_WARNINGS, rest="; the target check lists all of records"):
    """Print warnings, a line each, the first of many, and in a line how many more."""
    lines = list(lines)
    for line in lines[:most]:
        print(f"warning: {line}", file=sys.stderr)
    if (more := len(lines) - most) > 0:
        print(f"warning: {more} more{rest}", file=sys.stderr)


def wanted(record):
    """Whether a log record is for the terminal: what went wrong, and how the run ended."""
    if record.levelno >= logging.WARNING:
        return True
    event = getattr(getattr(record, "event", None), "name", "")
    return event not in HIDDEN and not str(record.msg).startswith(CHATTER)


def _several(names):
    """The targets, where none is near what was asked for."""
    return f"targets: {listed(names)} (--list-target-rules says what each makes)"


_UNMADE = re.compile(r"File (.+?) marked for report but does not exist\.")
_NO_RULE = re.compile(r"No rule to produce (.+?) \(if you use.*?\)\.")


def _about_file(path, runs):
    """What may be wrong with a result's path that no rule makes."""
    top, _, rest = path.partition("/")
    run = rest.partition("/")[0]
    if any(mark in path for mark in "*?{}"):
        return "expected the path of one file, without wildcards"
    if top == "results" and runs and run not in runs and not run.startswith("."):
        return f"its run is {run}, this command's {listed(runs)}: add --config run={run}"
    if "." not in path.rpartition("/")[2]:
        return "expected a file, or a target by its name"
    return "is it a file of this run, model, record and direction (`run`, `records`)?"


def name_targets(targets, logger=None, runs=()):
    """Let Snakemake's message about a target that it does not know name the nearest one.

    That of a report on results that are not there says what to do, without a line for every file.
    `targets` returns the names of the targets; `runs`, the names of this command's, may be filled
    later. The logger is Snakemake's, unless given.
    """

    def explain(record):
        if str(record.msg).startswith("Missing metadata for file"):
            return False
        if match := _UNMADE.search(str(record.msg)):
            record.msg = (
                f"error: no report yet, {match[1]} is missing: first the same without --report"
            )
        if match := _NO_RULE.search(str(record.msg)):
            names = targets()
            near = difflib.get_close_matches(match[1], names, 1)
            several = _several(names)
            said = f"did you mean {near[0]}?" if near else several
            if "/" in match[1]:
                said = _about_file(match[1], runs)
            record.msg = f"No rule to produce {match[1]}: {said}"
        if "Target rules may not contain wildcards" in str(record.msg):
            said = _several(targets())
            record.msg = f"a rule of many files is no target: name a file of its; {said}"
        return True

    for handler in (logger or logging.getLogger("snakemake.logging")).handlers:
        handler.addFilter(explain)


def thin_out(settings, logger=None):
    """Filter what a run prints; dry runs, `--verbose` and `--printshellcmds` are asked for in full.

    `settings` are Snakemake's `OutputSettings`; the logger is Snakemake's, unless given.
    """
    if settings.dryrun or settings.verbose or settings.printshellcmds:
        return
    for handler in (logger or logging.getLogger("snakemake.logging")).handlers:
        if isinstance(handler, logging.StreamHandler) and not isinstance(
            handler, logging.FileHandler
        ):
            handler.addFilter(wanted)
