"""What a report rests on, kept beside it so that nothing rewrites it.

A folder is named by the digest of `evidence.sha256`, which lists what the report rests on:
configuration, motions' table and the digests of the accelerograms, the site's files, every table
behind a number, program, version and code. The report cites that digest. It lies there too, and
SHA256SUMS lists all files: `sha256sum -c SHA256SUMS` notices a change of any, the report included.
A report of other settings is another folder, so what a signed one cites stays as it was.
"""

import hashlib
import os
import shutil
import tempfile
from pathlib import Path

LIST = "evidence.sha256"  # what the report cites
SUMS = "SHA256SUMS"  # of that, and of the report
MOTIONS = "accelerograms.sha256"  # of files that are not copied, by their paths
OURS = {LIST, SUMS, MOTIONS, "report.html", "report.pdf"}  # no file of a user's takes these names
DIGITS = 16  # of a digest, in a folder's name


def sums_of(files):
    """Text of digests for contents by name, as `sha256sum` writes it."""
    digests = {name: hashlib.sha256(data).hexdigest() for name, data in files.items()}
    return "".join(_line(digest, name) for name, digest in sorted(digests.items()))


def _line(digest, name):
    """Line of a digest; signs that would end a name early are told as `sha256sum` tells them."""
    told = name.replace("\\", "\\\\").replace("\n", "\\n").replace("\r", "\\r")
    return f"{'' if told == name else chr(92)}{digest}  {told}\n"


def digest_of(files):
    """SHA-256 of the list of files."""
    return hashlib.sha256(sums_of(files).encode()).hexdigest()


def sums_of_paths(paths):
    """Text of the digests of files where they lie; of the accelerograms, which are not copied."""
    digests = {}
    for path in sorted(set(map(str, paths))):
        with open(path, "rb") as handle:
            digests[path] = hashlib.file_digest(handle, "sha256").hexdigest()
    return "".join(_line(digest, path) for path, digest in digests.items())


def gathered(paths, texts):
    """Contents by name, of files (several of one name are numbered) and of texts by name."""
    contents = {name: text.encode() for name, text in texts.items()}
    for path in map(Path, paths):
        name, number = path.name, 1
        while name in contents or name in OURS:
            number += 1
            name = f"{path.stem}_{number}{path.suffix}"
        contents[name] = path.read_bytes()
    return contents


def keep(parent, files, report):
    """Keep evidence and the report of it in a folder of their own, which is returned.

    It lies below `parent`, and is complete or not there at all. A folder that is there already is
    left as it is. `files` are as of `gathered`; `report` are its files, which cite the evidence by
    digest and follow from it, so that those that are there have to be the same. ValueError of one
    line for a folder that has anything else, or more, or less.
    """
    place = Path(parent) / digest_of(files)[:DIGITS]
    whole = {**files, LIST: sums_of(files).encode()}
    whole |= {Path(path).name: Path(path).read_bytes() for path in report}
    whole[SUMS] = sums_of(whole).encode()
    if os.path.lexists(place):
        _refuse_other(place, whole)
        return place
    place.parent.mkdir(parents=True, exist_ok=True)
    draft = Path(tempfile.mkdtemp(dir=place.parent, prefix="."))
    try:
        for name, data in whole.items():
            (draft / name).write_bytes(data)
            (draft / name).chmod(0o444)
        draft.chmod(0o755)
        os.replace(draft, place)
    except BaseException:
        shutil.rmtree(draft, ignore_errors=True)
        raise
    return place


def _refuse_other(place, whole):
    """Refuse a folder of evidence whose files are not these."""
    ask = "expected the evidence that its name stands for: move the folder away, then repeat"
    if place.is_symlink() or not place.is_dir():
        raise ValueError(f"{place}: no folder; {ask}")
    there = {path.name: path for path in place.iterdir()}
    for name in sorted(there.keys() | whole.keys()):
        path = place / name
        if name not in whole:
            raise ValueError(f"{path}: a file that is no part of it; {ask}")
        if name not in there or path.is_symlink() or not path.is_file():
            raise ValueError(f"{path}: missing; {ask}")
        if path.read_bytes() != whole[name]:
            raise ValueError(f"{path}: changed, or not of this report; {ask}")
