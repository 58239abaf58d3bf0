"""Commands run by processes forked from one that has loaded the libraries.

Imports are most of what a start of Snakemake, of a script or of YADE takes, and at its end Python
takes the libraries down again for most of a second. Here one process a test session and Python
imports them; each command has a folder, environment and output of its own, and ends at once. Tests
of how a command line itself starts take a plain process.
"""

import atexit
import contextlib
import functools
import importlib
import json
import os
import re
import runpy
import select
import signal
import subprocess
import sys
import tempfile
import traceback
from multiprocessing import util
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PATHS = os.pathsep.join([str(ROOT), str(ROOT / "workflow")])
YADE_PYTHON = os.environ.get("YADE_PYTHON", "/usr/bin/python3")
LIBRARIES = (
    "jsonschema",
    "matplotlib.pyplot",
    "nbformat",
    "numba",
    "pandas",
    "rocking.records.check",
    "rocking.runs",
    "rocking.runtime.warm",
    "rocking.pushover",
    "scipy.optimize",
    "scipy.signal",
    "smart_open",
    "snakemake.cli",
)
LIMIT_S = 600.0
_servers: dict = {}
_ended: list = []  # exit status of a forked process


def snakemake(folder, *words, snakefile="workflow/Snakefile", cores=1):
    """Run Snakemake in a folder of its own, as `run`.

    Parameters
    ----------
    folder : Path
    *words : str
        Of the command line, beside `--snakefile` and `--cores`.
    snakefile : str or None
        In the project; None leaves it to Snakemake to find one in the folder.
    cores : int
    """
    found = ("--snakefile", str(ROOT / snakefile)) if snakefile else ()
    return run(folder, "snakemake", *found, "--cores", str(cores), *words)


def run(folder, *argv, timeout=LIMIT_S, python=sys.executable, given=""):
    """Run Snakemake or a Python script with the project's packages, or what belongs in YADE.

    Parameters
    ----------
    folder : Path
        Working folder.
    *argv : str
        "snakemake" or the path of a script, then its arguments. In YADE's Python "yade_scripts",
        or "call" with a module and a function of it.
    timeout : float
        Seconds after which it is killed.
    python : str
        The interpreter, `YADE_PYTHON` for what runs inside YADE.
    given : str
        Its standard input.

    Returns
    -------
    subprocess.CompletedProcess
        With what it printed.

    Raises
    ------
    subprocess.TimeoutExpired
    """
    if python not in _servers:
        _servers[python] = _server(python)
    server = _servers[python]
    with tempfile.TemporaryDirectory() as printed:
        files = [os.path.join(printed, name) for name in ("in", "out", "err")]
        Path(files[0]).write_text(given, "utf-8")
        environment = {**os.environ, "PYTHONPATH": _paths(python)}
        order = {"argv": argv, "folder": str(folder), "files": files, "environment": environment}
        print(json.dumps(order), file=server.stdin, flush=True)
        number = int(server.stdout.readline())
        late = not select.select([server.stdout], [], [], timeout)[0]
        if late:
            with contextlib.suppress(ProcessLookupError):
                os.kill(number, signal.SIGKILL)
        status = int(server.stdout.readline())
        out, err = (Path(path).read_text("utf-8", "replace") for path in files[1:])
    if late:
        raise subprocess.TimeoutExpired(argv, timeout, out, err)
    return subprocess.CompletedProcess(argv, status, out, err)


def _paths(python):
    """Where packages are found: what runs in YADE has no use for the workflow's."""
    return str(ROOT) if python == YADE_PYTHON else PATHS


def _server(python):
    """Start the process that forks; it ends with the end of its input."""
    return subprocess.Popen(
        [python, __file__, "yade" if python == YADE_PYTHON else "workflow"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": _paths(python), "OPENBLAS_NUM_THREADS": "1"},
    )


def _serve():
    """Fork for every line of the input; return the order in the forked process, else None."""
    for line in sys.stdin:
        order = json.loads(line)
        if not (number := os.fork()):
            return order
        print(number, flush=True)
        print(os.waitstatus_to_exitcode(os.waitpid(number, 0)[1]), flush=True)
    return None


def _plan_ahead():
    """Do what every plan begins with and keeps: plugins, imports of rules and of scripts."""
    sources = importlib.import_module("yade_scripts.sources")
    packages = "|".join(sources.PACKAGES)
    importlib.import_module("snakemake.cli").get_argument_parser()
    for path in (*ROOT.glob("workflow/rules/*.smk"), *ROOT.glob("workflow/studies/*/*.smk")):
        for name in re.findall(
            rf"(?m)^from ((?:{packages})[\w.]*) import",
            path.read_text("utf-8"),
        ):
            importlib.import_module(name)
    for path in (*ROOT.glob("workflow/scripts/*/*.py"), *ROOT.glob("workflow/studies/*/**/*.py")):
        sources.sources(path)


def _obey(order):
    """Become the process that was asked for."""
    for stream, path in enumerate(order["files"]):
        file = os.open(path, os.O_WRONLY | os.O_CREAT if stream else os.O_RDONLY)
        os.dup2(file, stream)
        os.close(file)
    os.environ.clear()
    os.environ.update(order["environment"])
    os.chdir(order["folder"])
    sys.argv = order["argv"]
    match sys.argv:
        case "snakemake", *_:
            if plain := getattr(util, "spawnv_passfds", None):
                util.spawnv_passfds = functools.partial(_spawn, plain)
            sys.exit(importlib.import_module("snakemake.cli").main())
        case "yade_scripts", *words:
            sys.exit(importlib.import_module("yade_scripts.__main__").main(words))
        case "call", module, function:
            sys.path.append(str(ROOT / "workflow"))  # cases of a study
            _call(getattr(importlib.import_module(module), function))
        case script, *_:
            sys.path.insert(0, str(Path(script).parent))
            runpy.run_path(script, run_name="__main__")


def _spawn(plain, path, words, passed):
    """Fork the standard library's server of processes, with what is imported; start others.

    The public ways to that server, `set_forkserver_preload` and `set_executable`, start an
    interpreter that imports anew. This one goes by a private name; a Python that does not know it
    starts the server as it is used to.
    """
    if not words[-1].startswith("from multiprocessing.forkserver import main"):
        return plain(path, words, passed)
    if number := os.fork():
        return number
    alive = os.stat(passed[-1])  # it ends when nobody else holds the other end of this pipe
    for name in os.listdir("/proc/self/fd"):
        with contextlib.suppress(OSError):
            if int(name) not in passed and os.path.samestat(alive, os.stat(int(name))):
                os.close(int(name))
    try:
        exec(words[-1])
    finally:
        os._exit(1)


def _status(order):
    """Exit status of what was asked for, told as the interpreter tells it."""
    try:
        _obey(order)
    except SystemExit as end:
        if not isinstance(end.code, str):
            return end.code or 0
        print(end.code, file=sys.stderr)
        return 1
    except BaseException:
        traceback.print_exc()
        return 1
    return 0


def _end_at_once():
    """Let a forked process end after the last exit function that anybody registered.

    Registered before all others this runs after them, when threads have ended too. Python would
    then take the libraries down object by object, for most of a second.
    """
    if _ended:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(_ended[0])


def _call(function):
    """Take arguments from the input, as JSON, and print what comes back in a last line."""
    from yade_scripts.engine import parent_process

    parent_process.follow()
    print("RESULT" + json.dumps(function(**json.load(sys.stdin))))


if __name__ == "__main__":
    atexit.register(_end_at_once)
    if sys.argv[1] == "yade":
        from yade_scripts.engine import adapter

        adapter.load_yade()
    else:
        sys.path.pop(0)  # this folder
        for name in LIBRARIES:
            importlib.import_module(name)
        _plan_ahead()
    if (taken := _serve()) is not None:
        _ended.append(_status(taken))
