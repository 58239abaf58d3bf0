"""Keys of the schemas, of shipped configurations and of all other YAML of ours stand once."""

import os
import shutil
from pathlib import Path

import pytest
from rocking.configuration import schema
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
    text = path.read_text("utf-8")
    if path.is_relative_to(ROOT / "workflow/profiles"):  # programs, which a configuration is not
        text = text.replace("__use_yte__", "uses_yte")
    check_text(text, path.name)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "expected a schema: properties"),
        ("title: Own\n", "expected a schema: properties"),
        ("properties: [a]\n", "expected a schema: properties"),
        ("properties: {a: 1}\n", "expected a schema: properties"),
        ("title: [\n", "line 2: not readable as YAML"),
    ],
)
def test_a_schema_that_is_none_is_named_in_one_line(tmp_path, text, said):
    """As of a study that is being written."""
    shutil.copy(ROOT / "workflow/schemas/run.schema.yaml", tmp_path)
    (tmp_path / "own.schema.yaml").write_text(text)
    with pytest.raises(schema.ConfigError, match=said) as caught:
        schema.sections(tmp_path)
    assert f"{tmp_path}/own.schema.yaml" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_key_has_one_schema_and_a_pipe_is_not_waited_for(tmp_path, monkeypatch):
    """Else a study's would stand in the core's place, unseen."""
    own = tmp_path / "own"
    own.mkdir()
    monkeypatch.setattr(schema, "STUDIES", tmp_path)
    monkeypatch.setattr(schema, "sections", schema.sections.__wrapped__)
    path = own / "facade.schema.yaml"
    path.write_text("properties: {height_m: {type: number, default: 1.0}}\n")
    with pytest.raises(schema.ConfigError, match="own/facade.schema.yaml: facade.height_m stands"):
        schema.sections()
    path.unlink()
    os.mkfifo(path)
    with pytest.raises(schema.ConfigError, match="facade.schema.yaml: expected a file"):
        schema.sections()
