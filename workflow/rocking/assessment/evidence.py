"""What a report rests on, kept beside it so that nothing rewrites it.

A folder is named by the digest of what is in it: configuration, motions' table, the site's files,
every table behind a number, program and version, with SHA256SUMS over all of them. The report of
that evidence lies there too. Another report, of other settings, is another folder, so what a signed
one cites stays as it was; `sha256sum -c SHA256SUMS` says so.
"""

import hashlib
import os
import shutil
import tempfile
from pathlib import Path

SUMS = "SHA256SUMS"
DIGITS = 16  # of a digest, in a folder's name


def sums_of(files):
    """Text of SHA256SUMS for contents by name, as `sha256sum` writes it."""
    digests = {name: hashlib.sha256(data).hexdigest() for name, data in files.items()}
    return "".join(f"{digest}  {name}\n" for name, digest in sorted(digests.items()))


def digest_of(files):
    """SHA-256 of the sums of files."""
    return hashlib.sha256(sums_of(files).encode()).hexdigest()


def gathered(paths, texts):
    """Contents by name, of files (several of one name are numbered) and of texts by name."""
    found = {name: text.encode() for name, text in texts.items()}
    for path in map(Path, paths):
        name, number = path.name, 1
        while name in found:
            number += 1
            name = f"{path.stem}_{number}{path.suffix}"
        found[name] = path.read_bytes()
    return found


def keep(parent, files, report):
    """Keep evidence and the report of it in a folder of their own, which is returned.

    It lies below `parent`, and is complete or not there at all. A folder that is there already has
    the same evidence, and is left as it is. `files` are as of `gathered`; `report` are its files,
    which cite the evidence by digest.
    """
    place = Path(parent) / digest_of(files)[:DIGITS]
    if place.exists():
        return place
    place.parent.mkdir(parents=True, exist_ok=True)
    draft = Path(tempfile.mkdtemp(dir=place.parent, prefix="."))
    try:
        for name, data in files.items():
            (draft / name).write_bytes(data)
        (draft / SUMS).write_text(sums_of(files), encoding="utf-8")
        for path in report:
            shutil.copyfile(path, draft / Path(path).name)
        for path in draft.iterdir():
            path.chmod(0o444)
        draft.chmod(0o755)
        os.replace(draft, place)
    except BaseException:
        shutil.rmtree(draft, ignore_errors=True)
        raise
    return place
