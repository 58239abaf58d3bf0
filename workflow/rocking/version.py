"""Which version this is, and which commit: what a reader cites and a fault report names."""

import hashlib
import importlib.metadata
import os
import re
import subprocess
from pathlib import Path

NAME = "rocking-facades"
ROOT = Path(__file__).resolve().parents[2]


def version():
    """Number of this version: of the tree if this is one, else as installed; "" of neither.

    One that ends in `.dev0` is on its way to that number.
    """
    tree = ROOT / "pyproject.toml"
    ours = (ROOT / "workflow" / "rocking").is_dir() and tree.is_file()
    text = tree.read_text("utf-8") if ours else ""
    if match := re.search(r'(?m)^version = "(.+)"$', text):
        return match[1]
    try:
        return importlib.metadata.version(NAME)
    except importlib.metadata.PackageNotFoundError:
        return ""


def commit(digits=7):
    """Commit of the tree, with a + where a file differs from it; "" outside a clone.

    Also of a clone that belongs to another user, as a group's installation does: git refuses to
    look at one by itself, since what its settings name would be run; here that is switched off.
    """
    if not (ROOT / ".git").exists():
        return ""
    trusted = ["-c", f"safe.directory={ROOT}", "-c", "core.fsmonitor=false"]
    asked = ["describe", "--always", f"--abbrev={digits}", "--dirty=+", "--exclude=*"]
    words = ["git", "-C", str(ROOT), *trusted, *asked]
    # without what names another repository, as a hook of git's does
    kept = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    environment = {**kept, "GIT_OPTIONAL_LOCKS": "0"}
    try:
        done = subprocess.run(words, capture_output=True, text=True, timeout=20, env=environment)
    except (OSError, subprocess.SubprocessError):
        return ""
    return done.stdout.strip()


def code():
    """SHA-256 of the program's files, which tells one modified tree from another."""
    total = hashlib.sha256()
    folders = [ROOT / name for name in ("smdof", "workflow", "yade_scripts")]
    files = [path for folder in folders for path in sorted(folder.rglob("*"))]
    for path in files:
        if "__pycache__" not in path.parts and path.is_file():
            content = hashlib.sha256(path.read_bytes()).digest()
            total.update(path.relative_to(ROOT).as_posix().encode() + b"\0" + content)
    return total.hexdigest()


def stated():
    """Return "rocking-facades 0.4.0, commit 1a2b3c4", as far as it is known."""
    parts = [f"{NAME} {version()}".strip(), f"commit {at}" if (at := commit()) else ""]
    return ", ".join(filter(None, parts))
