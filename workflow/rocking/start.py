"""What is looked at before Snakemake begins: no configuration file runs code or stalls it.

Snakemake reads what `--configfile` names before the workflow has a word, and takes a file that says
`__use_yte__` for a template whose expressions it runs, under `-n` too. `make setup` lets
`.venv/bin/snakemake` start here; for any other `snakemake` the workflow's profiles call `prepare`,
for they are read before configurations.
"""

import os
import sys
import tempfile
from pathlib import Path

from rocking.configuration.files import check_files, refuse_harmful
from rocking.configuration.schema import ConfigError
from rocking.runtime import results_folder


def guard():
    """Let Snakemake look at every configuration file before it reads it.

    A configuration is read as strictly as the workflow reads it, so that what is no configuration
    ends in one line; of a schema only what would run code or stall is refused.
    """
    from snakemake.common import configfile

    read = configfile._load_configfile
    if read.__module__ == __name__:
        return

    def guarded(configpath_or_obj, filetype="Config"):
        if isinstance(configpath_or_obj, (str, Path)):
            try:
                refuse_harmful(configpath_or_obj)
                if filetype == "Config":
                    check_files([configpath_or_obj], empty=False)
            except ConfigError as error:
                sys.exit(f"error: {error}")
        return read(configpath_or_obj, filetype)

    configfile._load_configfile = guarded


def look_at_folder():
    """Let Snakemake look at the folder of `--directory` before it goes there, however it is spelt.

    It makes one that is not there, and ends in a traceback where it cannot.
    """
    from snakemake import cli

    run = cli.args_to_api
    if run.__module__ == __name__:
        return

    def looked_at(words, parser):
        if words.directory and (fault := results_folder.unreachable(words.directory)):
            sys.exit(f"error: --directory {words.directory}: {fault}")
        return run(words, parser)

    cli.args_to_api = looked_at


def settle_caches(folder=".snakemake/cache"):
    """Keep caches in the working folder where the home cannot be written, with a line that says so.

    Snakemake would end in a traceback; compiled loops are kept there too.
    """
    try:
        home = Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache").expanduser()
        home.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=home).close()
    except (OSError, RuntimeError) as error:
        cache = Path(folder).absolute()
        try:
            cache.mkdir(parents=True, exist_ok=True)
        except OSError as fault:
            sys.exit(f"error: {fault.filename}: {fault.strerror}: --directory names another folder")
        os.environ["XDG_CACHE_HOME"] = str(cache)
        os.environ.setdefault("MPLCONFIGDIR", str(cache / "matplotlib"))
        print(f"warning: no cache in the home folder ({error}): kept in {cache}", file=sys.stderr)


def prepare():
    """Settle caches and guard what Snakemake reads; once, however often it is called."""
    try:
        os.getcwd()
    except OSError as error:
        sys.exit(f"error: the working folder is gone ({error.strerror}): go to one that is there")
    settle_caches()
    guard()
    look_at_folder()


def main():
    """Start Snakemake with the words of the command line."""
    prepare()
    from snakemake.cli import main as snakemake

    return snakemake()


if __name__ == "__main__":
    sys.exit(main())
