"""Commands run by processes forked from one that has loaded the libraries.

A start of Snakemake takes four seconds, half of them imports, and a script two. Here one process a
test session imports the libraries; each command has a folder, environment and output of its own.
Tests of how the command line itself starts take a plain process.
"""

import contextlib
import json
import os
import runpy
import select
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PATHS = os.pathsep.join([str(ROOT), str(ROOT / "workflow")])
LIMIT_S = 600.0
_servers: list = []


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


def run(folder, *argv, timeout=LIMIT_S):
    """Run Snakemake or a Python script with the project's packages.

    Parameters
    ----------
    folder : Path
        Working folder.
    *argv : str
        "snakemake" or the path of a script, then its arguments.
    timeout : float
        Seconds after which it is killed.

    Returns
    -------
    subprocess.CompletedProcess
        With what it printed.

    Raises
    ------
    subprocess.TimeoutExpired
    """
    if not _servers:
        _servers.append(_server())
    server = _servers[0]
    with tempfile.TemporaryDirectory() as printed:
        files = [os.path.join(printed, name) for name in ("out", "err")]
        environment = {**os.environ, "PYTHONPATH": PATHS}
        order = {"argv": argv, "folder": str(folder), "files": files, "environment": environment}
        print(json.dumps(order), file=server.stdin, flush=True)
        number = int(server.stdout.readline())
        late = not select.select([server.stdout], [], [], timeout)[0]
        if late:
            with contextlib.suppress(ProcessLookupError):
                os.kill(number, signal.SIGKILL)
        status = int(server.stdout.readline())
        out, err = (Path(path).read_text("utf-8", "replace") for path in files)
    if late:
        raise subprocess.TimeoutExpired(argv, timeout, out, err)
    return subprocess.CompletedProcess(argv, status, out, err)


def _server():
    """Start the process that forks; it ends with the end of its input."""
    return subprocess.Popen(
        [sys.executable, __file__],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": PATHS, "OPENBLAS_NUM_THREADS": "1"},
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


def _obey(order):
    """Become the process that was asked for."""
    nothing = os.open(os.devnull, os.O_RDONLY)
    written = (os.open(path, os.O_WRONLY | os.O_CREAT) for path in order["files"])
    for stream, file in enumerate((nothing, *written)):
        os.dup2(file, stream)
        os.close(file)
    os.environ.clear()
    os.environ.update(order["environment"])
    os.chdir(order["folder"])
    sys.argv = order["argv"]
    if sys.argv[0] == "snakemake":
        sys.exit(cli.main())
    sys.path.insert(0, str(Path(sys.argv[0]).parent))
    runpy.run_path(sys.argv[0], run_name="__main__")


if __name__ == "__main__":
    sys.path.pop(0)  # this folder
    import jsonschema  # noqa: F401
    import matplotlib.pyplot  # noqa: F401
    import pandas  # noqa: F401
    import scipy.optimize
    import scipy.signal  # noqa: F401
    from snakemake import cli

    if (given := _serve()) is not None:
        _obey(given)
