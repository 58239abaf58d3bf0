"""One entry for the scripts of the workflow: under Snakemake, or alone.

A script defines `main(job)` and ends with `run(main, globals())`. Under
Snakemake `job` carries the rule's input, output, params and wildcards; alone
they come from the command line:

    python workflow/scripts/records/table_records.py --input facts=a.json --output a.csv
"""

import argparse
import contextlib
import errno
import json
import multiprocessing
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from types import SimpleNamespace

from yade_scripts.engine import parent_process

NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EIO)


def _pairs(items):
    """Named values from "name=value" words; values are JSON where they parse as JSON."""
    named = {}
    for item in items:
        name, equals, text = item.partition("=")
        if not equals:
            name, text = "0", item
        try:
            named[name] = json.loads(text)
        except ValueError:
            named[name] = text.split(",") if "," in text else text
    return named


class _Named(SimpleNamespace):
    """Values by name, or by position like Snakemake's named lists."""

    def __getitem__(self, key):
        values = list(vars(self).values())
        return values[key] if isinstance(key, int) else getattr(self, key)

    def get(self, key, default=None):
        return getattr(self, key, default)

    def items(self):
        return vars(self).items()


def _from_command_line(doc):
    parser = argparse.ArgumentParser(description=doc)
    for kind in ("input", "output", "params", "wildcards"):
        parser.add_argument(f"--{kind}", nargs="*", default=[], metavar="name=value")
    given = vars(parser.parse_args())
    return SimpleNamespace(**{kind: _Named(**_pairs(words)) for kind, words in given.items()})


def _date_alike(outputs):
    """Give a job's files one date, the newest of theirs.

    Snakemake refuses a link to the first of them that stands for all, as older than the last.
    """
    made = [path for path in map(Path, outputs) if path.is_file()]
    newest_ns = max((path.stat().st_mtime_ns for path in made), default=0)
    for path in made:
        os.utime(path, ns=(newest_ns, newest_ns))


def _line(error, outputs):
    """What to say of a foreseen error; one of writing that names no file is of the outputs."""
    if isinstance(error, OSError) and error.errno in NO_ROOM and error.filename is None:
        error = OSError(error.errno, error.strerror, " or ".join(outputs))
    return f"error: {error}"


def pool_of(job):
    """Processes of the job's threads, which end with the run.

    Forked: they have what the job has loaded. A job that is served warm would start them anew,
    by the method of its server, and each would run the script again.
    """
    threads, fork = int(getattr(job, "threads", 1)), multiprocessing.get_context("fork")
    return ProcessPoolExecutor(threads, fork, initializer=parent_process.follow)


def run(main, namespace):
    """Call `main` with the job's description; foreseen errors end in one line and status 1.

    The files it names as output are then dated alike.
    """
    parent_process.follow()
    job = namespace.get("snakemake") or _from_command_line(namespace.get("__doc__"))
    log = getattr(job, "log", None)
    outputs = job.output if namespace.get("snakemake") else vars(job.output).values()
    outputs = [str(path) for path in outputs]
    try:
        main(job)
    except (ValueError, OSError) as error:
        line = _line(error, outputs)
        print(line, file=sys.stderr)
        # on a full disk the log has no room either, and the line is on the terminal
        with contextlib.suppress(OSError):
            if log:
                Path(str(log)).write_text(line + "\n", "utf-8")
        sys.exit(1)
    _date_alike(outputs)
    if log:
        with contextlib.suppress(OSError), open(str(log), "a", encoding="utf-8"):
            pass
