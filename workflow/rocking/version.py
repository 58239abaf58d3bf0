"""Which version this is, and which commit: what a reader cites and a fault report names."""

import importlib.metadata
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
    if found := re.search(r'(?m)^version = "(.+)"$', text):
        return found[1]
    try:
        return importlib.metadata.version(NAME)
    except importlib.metadata.PackageNotFoundError:
        return ""


def commit():
    """Commit of the tree, with a + where a file differs from it; "" outside a clone."""
    if not (ROOT / ".git").exists():
        return ""
    words = ["git", "-C", str(ROOT), "describe", "--always", "--dirty=+", "--exclude=*"]
    try:
        done = subprocess.run(words, capture_output=True, text=True, timeout=20)
    except (OSError, subprocess.SubprocessError):
        return ""
    return done.stdout.strip()


def stated():
    """Return "rocking-facades 0.4.0, commit 1a2b3c4", as far as it is known."""
    parts = [f"{NAME} {version()}".strip(), f"commit {at}" if (at := commit()) else ""]
    return ", ".join(filter(None, parts))
