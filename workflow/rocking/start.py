"""Snakemake as `.venv/bin/snakemake` starts it: no configuration file runs code or stalls it.

Snakemake reads what `--configfile` names before the workflow has a word, and takes a file that says
`__use_yte__` for a template whose expressions it runs, under `-n` too. `make setup` lets
`.venv/bin/snakemake` start here; `python -m snakemake` is Snakemake alone.
"""

import os
import sys
import tempfile
from pathlib import Path

from rocking.configuration.files import refuse_harmful
from rocking.configuration.schema import ConfigError


def guard():
    """Let Snakemake look at every configuration file before it reads it."""
    from snakemake.common import configfile

    read = configfile._load_configfile

    def guarded(configpath_or_obj, filetype="Config"):
        if isinstance(configpath_or_obj, (str, Path)):
            try:
                refuse_harmful(configpath_or_obj)
            except ConfigError as error:
                sys.exit(f"error: {error}")
        return read(configpath_or_obj, filetype)

    configfile._load_configfile = guarded


def settle_caches(folder=".snakemake/cache"):
    """Keep caches in the working folder where the home cannot be written, with a line that says so.

    Snakemake would end in a traceback; compiled loops are kept there too.
    """
    try:
        home = Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache").expanduser()
        home.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=home).close()
    except (OSError, RuntimeError) as error:
        own = Path(folder).absolute()
        try:
            own.mkdir(parents=True, exist_ok=True)
        except OSError as fault:
            sys.exit(f"error: {fault.filename}: {fault.strerror}: --directory names another folder")
        os.environ["XDG_CACHE_HOME"] = str(own)
        os.environ.setdefault("MPLCONFIGDIR", str(own / "matplotlib"))
        print(f"warning: no cache in the home folder ({error}): kept in {own}", file=sys.stderr)


def main():
    """Start Snakemake with the words of the command line."""
    settle_caches()
    guard()
    from snakemake.cli import main as snakemake

    return snakemake()


if __name__ == "__main__":
    sys.exit(main())
