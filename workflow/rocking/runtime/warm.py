"""Scripts started from a process that has loaded the libraries already.

A table takes milliseconds to make and a second or two to import pandas, SciPy and Snakemake. Where
many scripts are due, one server imports them once (the standard library's `forkserver`), and every
script is a process forked from it: alone in its process as before, with its own log and benchmark.
"""

import contextlib
import multiprocessing
import os
import runpy
import signal
import subprocess
import sys
import threading
import time
from multiprocessing import forkserver
from multiprocessing.connection import wait
from pathlib import Path

from rocking.runtime import stamps
from rocking.runtime.fallback import expect_parameters, left_out_if_unknown
from yade_scripts import sources

FEWEST = 3  # scripts; below, starting the server costs more than it saves
LIBRARIES = (
    "snakemake.cli",  # a child of Snakemake's process imports it again
    "snakemake.iocontainers",  # what Snakemake's scripts begin with
    "pandas",
    "matplotlib.backends.backend_pdf",
    "matplotlib.backends.backend_agg",
)
COMPILED, READY = "rocking.runtime.compiled", "rocking.runtime.ready"
# the server starts by `python -c`, which would import what the working folder calls random.py
SAFE_PATH = "PYTHONSAFEPATH"
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMEXPR_NUM_THREADS")


def is_current(modules, since_s):
    """Whether none of the files was changed at or after a time [s since the epoch]."""
    return all(os.stat(path).st_mtime < since_s for path in modules)


def _script(path, folder, temporary, safe):
    """Run a script in a process forked from the server."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
    os.chdir(folder)
    if not safe:
        os.environ.pop(SAFE_PATH, None)
    if temporary:
        os.environ.update(dict.fromkeys(("TMPDIR", "TMP", "TEMP", "TEMPDIR"), temporary))
    sys.argv = [path]
    sys.path.insert(0, str(Path(path).resolve().parent))
    runpy.run_path(path, run_name="__main__")


class Server:
    """Starts scripts; used from the threads of one Snakemake process.

    `modules` are dotted names of what the server imports beside `LIBRARIES`. OSError if it ends at
    once.
    """

    def __init__(self, modules=()):
        """Start, and wait until all is imported; an interrupt meets this process alone."""
        self.began_s = time.time()
        self.lock = threading.Lock()  # the standard library's bookkeeping is not for threads
        self.context = multiprocessing.get_context("forkserver")
        self.context.set_forkserver_preload([*LIBRARIES, *modules])
        # Held back, not ignored: the server inherits that, and here an interrupt comes late
        # but is not lost.
        held = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
        try:
            # BLAS reads the number of its threads once, when the server imports it
            with _environment(dict.fromkeys(THREADS, "1") | {SAFE_PATH: "1"}):
                forkserver.ensure_running()
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, held)
        self._start(int).join()

    def _start(self, target, *arguments):
        process = self.context.Process(target=target, args=arguments)
        try:
            process.start()
        except EOFError as error:
            raise OSError(f"the server of scripts has ended: {error}") from error
        return process

    def run(self, path, watched=lambda pid: contextlib.nullcontext(), temporary=None):
        """Run a script in the working folder and wait for its end.

        `watched` takes the process's number and returns the context to wait in (a benchmark);
        `temporary` is the folder for temporary files. CalledProcessError if it ends with another
        status than 0, OSError if it could not be started.
        """
        with self.lock:
            process = self._start(
                _script, str(path), os.getcwd(), temporary, SAFE_PATH in os.environ
            )
        with watched(process.pid):
            wait([process.sentinel])
        with self.lock:
            process.join()
        if process.exitcode:
            raise subprocess.CalledProcessError(process.exitcode, [sys.executable, str(path)])


def _modules(job):
    """Input `modules` of a job as a list: one stamp, files, or nothing."""
    named = job.input.get("modules", [])
    return [named] if isinstance(named, str) else named


@contextlib.contextmanager
def _environment(values):
    """Environment variables for a while."""
    before = {name: os.environ.get(name) for name in values}
    os.environ.update(values)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def serve(workflow):
    """Let Snakemake start the Python scripts of its rules from a server, if many are due.

    A script of several threads, one whose modules were changed since the server started, and one
    that the server cannot start, are started as Snakemake does. The workflow has its DAG, as it
    does in `onstart`. ImportError, AttributeError or TypeError in a release of Snakemake that
    starts scripts in another way; nothing is changed then.
    """
    from snakemake.benchmark import benchmarked
    from snakemake.script import PythonScript

    expect_parameters(PythonScript.execute_script, "self", "fname", "edit")
    expect_parameters(benchmarked, "pid", "benchmark_record", "interval")
    due = [job for job in workflow.dag.needrun_jobs() if job.rule.script]
    if len(due) < FEWEST:
        return
    modules = {path for job in due for path in _modules(job)}
    try:
        names = sources.names(stamps.files(modules))
        server = Server([*names, *([READY] if COMPILED in names else [])])
        cold = PythonScript.execute_script
    except OSError:
        return

    def execute_script(self, fname, edit=False):
        try:
            plain = not (self.container_img or self.conda_env or self.env_modules)
            current = is_current(stamps.files(_modules(self)), server.began_s)
            suits = plain and current and self.threads == 1
            measured, temporary = self.bench_record, self.resources.get("tmpdir")
        except AttributeError:  # another Snakemake
            suits = False
        if not suits:
            return cold(self, fname, edit)

        def watched(pid):
            return contextlib.nullcontext() if measured is None else benchmarked(pid, measured)

        try:
            return server.run(fname, watched, temporary)
        except OSError:
            return cold(self, fname, edit)

    PythonScript.execute_script = execute_script


def serve_when_due(workflow):
    """Like `serve`, from the first script on: what was submitted to a cluster has no `onstart`."""
    from snakemake.script import PythonScript

    cold = PythonScript.execute_script
    expect_parameters(cold, "self", "fname", "edit")

    def execute_first(self, fname, edit=False):
        PythonScript.execute_script = cold
        with left_out_if_unknown("a server of scripts"):
            serve(workflow)
        return self.execute_script(fname, edit)

    PythonScript.execute_script = execute_first
