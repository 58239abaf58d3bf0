"""One file that stands for a script and all it imports, as the input of a rule.

Forty files a job were most of what Snakemake spent on planning a study of thousands of jobs.
"""

import contextlib
import errno
import os
from functools import cache
from pathlib import Path

from yade_scripts import sources
from yade_scripts.files import named

FOLDER = Path(".snakemake") / "code"
NAME = "stamp"


@cache
def stamp(script, folder=FOLDER):
    """Return the stamp of a script, written anew if what it stands for has changed.

    Each has a folder of its own, for Snakemake remembers what a folder held when it first looked.
    It is dated like the newest of the files when it is first made, so that it can be deleted
    without harm, and to the present when their content differs from what it says. Its lines are
    the digest of the content, then the files. OSError with the stamp's name if it cannot be
    written.
    """
    files, content = sources.sources(script), sources.digest(script)
    text = "\n".join([content, *map(str, files)]) + "\n"
    name = "-".join(script.with_suffix("").parts[-3:])
    target = Path(folder) / name / NAME
    before = target.read_text("utf-8") if target.is_file() else ""
    if before == text:
        return target
    new = target.with_name(f".{os.getpid()}")
    if any(place.is_symlink() for place in (Path(folder), target.parent, target)):
        raise OSError(errno.ELOOP, "a link, which is not followed", str(target))
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        new.write_text(text, "utf-8")
        if not before:
            dated_s = max(file.stat().st_mtime for file in files)
            os.utime(new, (dated_s, dated_s))
        elif before.startswith(content):  # the same files in another place
            os.utime(new, (dated_s := target.stat().st_mtime, dated_s))
        os.replace(new, target)
    except OSError as error:
        with contextlib.suppress(OSError):  # where its folder is a file
            new.unlink()
        raise named(error, target) from None
    return target


def content(path):
    """Digest of the code that a stamp stands for, wherever that lies."""
    return Path(path).read_text("utf-8").partition("\n")[0]


def files(modules):
    """Return the files behind the input `modules` of a job: those of stamps, or as they are."""
    paths = map(Path, modules)
    return [
        file
        for path in paths
        for file in ([path] if path.suffix else map(Path, path.read_text("utf-8").splitlines()[1:]))
    ]
