"""Snakemake as `.venv/bin/snakemake` starts it: no configuration file runs code or stalls.

Snakemake reads what `--configfile` names before the workflow has a word, and takes a file that says
`__use_yte__` for a template whose expressions it runs, under `-n` too. `make setup` lets
`.venv/bin/snakemake` start here; `python -m snakemake` is Snakemake alone.
"""

import sys
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


def main():
    """Start Snakemake with the words of the command line."""
    guard()
    from snakemake.cli import main as snakemake

    return snakemake()


if __name__ == "__main__":
    sys.exit(main())
