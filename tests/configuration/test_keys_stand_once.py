"""Keys of the schemas and of shipped configurations stand once."""

from pathlib import Path

import pytest
from rocking.configuration.files import check_text

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize(
    "path",
    sorted({*ROOT.glob("workflow/schemas/*.yaml"), *ROOT.glob("config/**/*.yaml")}),
    ids=lambda path: path.name,
)
def test_no_key_of_ours_stands_twice(path):
    """YAML itself lets the last of two keys of one name win, and the first is gone unseen."""
    check_text(path.read_text("utf-8"), path.name)
