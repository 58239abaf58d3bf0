"""Files that come with the project: in its folder, or inside the package that was installed."""

from pathlib import Path

HERE = Path(__file__).resolve().parent
INSIDE = HERE / "_shipped"  # where `setup.py` puts them in a wheel
# What a wheel has of the project beside its code, by their places in the tree.
IN_WHEEL = (
    "config/*.yaml",
    "config/*.json",
    "config/*.tsv",
    "config/scenarios/study.yaml",
    "config/suites/*.tsv",
    "config/suites/*.yaml",
    "config/suites/*.motions",
    "workflow/schemas/*.yaml",
    "workflow/studies/*/*.schema.yaml",
)


def shipped(path):
    """Place of what comes with the project, as `config/records.tsv`; it need not exist."""
    return (INSIDE if INSIDE.is_dir() else HERE.parents[1]) / path


def found(path):
    """A user's file as it is named or, where there is none, the one that comes with the project."""
    given, ours = Path(path), shipped(path)
    return ours if not given.exists() and ours.exists() else given
