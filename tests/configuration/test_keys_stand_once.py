"""Keys of the schemas, of shipped configurations and of all other YAML of ours stand once."""

from pathlib import Path

import pytest
from rocking.configuration.files import check_text

ROOT = Path(__file__).resolve().parents[2]


TOPS = ("config", "workflow", "docs", "tests", ".test", ".github")
PATHS = sorted(
    path
    for kind in ("yaml", "yml", "cff")
    for path in {*ROOT.glob(f"*.{kind}"), *(p for t in TOPS for p in (ROOT / t).rglob(f"*.{kind}"))}
    if "results" not in path.parts and ".snakemake" not in path.parts
)


def test_studies_and_profiles_are_among_them():
    names = {path.relative_to(ROOT).as_posix() for path in PATHS}
    assert {"workflow/profiles/slurm/config.yaml", ".test/config/config.yaml"} <= names
    assert {str(p.relative_to(ROOT)) for p in ROOT.glob("workflow/studies/*/*.yaml")} <= names


@pytest.mark.parametrize("path", PATHS, ids=lambda path: str(path.relative_to(ROOT)))
def test_no_key_of_ours_stands_twice(path):
    """YAML itself lets the last of two keys of one name win, and the first is gone unseen."""
    check_text(path.read_text("utf-8"), path.name)
