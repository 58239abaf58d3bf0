"""The one entry to what runs inside YADE: `python3 yade_scripts COMMAND [options]`.

It runs under the Python that YADE was built for, the system's own, and makes the package
importable there; nothing else sets a path. Each command is a module of `commands`, or of a study's
folder `yade`, with a function `main(arguments)`; `python3 yade_scripts` lists them,
`python3 yade_scripts ida --help` says what one takes.
"""

import importlib
import os
import signal
import sys
from pathlib import Path

# As in the workflow's jobs: sums over more threads have other last digits, and a step that differs
# in them makes another history of a wall that is near collapse. It is read when numpy is loaded.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

HERE = Path(__file__).resolve().parent
if __package__ in (None, ""):
    sys.path[0] = str(HERE.parent)
# where studies lie, in the project's folder or beside this package
STUDIES = next(HERE.parent.glob("workflow/studies"), HERE.parent / "studies")


def commands():
    """Commands by name, sorted, with the study whose it is, or None: modules that have a `main`."""
    files = [*HERE.glob("commands/*.py"), *STUDIES.glob("*/yade/*.py")]
    paths = {path.stem: path for path in sorted(files) if "\ndef main(" in path.read_text()}
    return {
        name: paths[name].parts[-3] if STUDIES in paths[name].parents else None
        for name in sorted(paths)
    }


def main(arguments):
    """Run the named command; return the exit status. A foreseen error is one line."""
    try:
        from yade_scripts.engine import parent_process
        from yade_scripts.engine.adapter import EngineError
    except ModuleNotFoundError as error:  # another Python stands first on the path
        python = f"{sys.executable} has no {error.name}"
        print(f"error: {python}: expected the system's Python, /usr/bin/python3", file=sys.stderr)
        return 1
    if parent_process.follow() and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        # A job ends by Ctrl-C without a word: the run says what there is to say, and what has
        # finished is in the journal. Half loaded, YADE would fall with a stack of its own.
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    known = commands()
    if not arguments or arguments[0] not in known:
        print(f"usage: yade_scripts COMMAND [options]; COMMAND is one of {', '.join(known)}")
        return 2
    name, study = arguments[0], known[arguments[0]]
    if study:
        sys.path.append(str(STUDIES.parent))
        command = importlib.import_module(f"studies.{study}.yade.{name}")
    else:
        command = importlib.import_module(f"yade_scripts.commands.{name}")
    try:
        return command.main(arguments[1:])
    except (ValueError, OSError, EngineError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
