"""A run's own names for the files that it shares (tables/shared.csv: file, kept_in)."""

import os
import shutil
from pathlib import Path

from rocking.runtime.script import run
from rocking.tables import write_table


def link(source, target):
    """Give a file a second name, or copy it where the file system has no hard links."""
    target.parent.mkdir(parents=True, exist_ok=True)
    new = target.with_name(f".{target.name}.{os.getpid()}")
    try:
        os.link(source, new)
    except OSError:
        shutil.copy2(source, new)
    os.replace(new, target)
    new.unlink(missing_ok=True)  # where both were the same file already


def main(job):
    folder, rows = Path(job.output[0]).parents[1], []
    for source in map(Path, job.input.files):
        name = "/".join(source.parts[-2:])
        link(source, folder / name)
        rows.append((name, source.as_posix()))
    write_table(rows, job.output[0], ["file", "kept_in"], digits=None)


run(main, globals())
