"""Pictures of the pages: what draws each is known, and when that has changed they are named."""

import importlib.util
import json
from pathlib import Path

import pytest
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
PICTURES = ROOT / "docs" / "pictures"


@pytest.fixture
def gallery():
    spec = importlib.util.spec_from_file_location("gallery", ROOT / "tools" / "gallery.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_every_picture_says_what_draws_it(gallery):
    """Old ones are named by `make docs`; here it counts that nothing is missing on either side."""
    assert len(gallery.OF_STUDIES) > 4 or not any(ROOT.glob("workflow/studies/*/rules.smk"))
    for drawn_by in (gallery.DRAWN_BY, *gallery.OF_STUDIES):
        gallery.old(drawn_by)
    known = json.loads((PICTURES / "drawn_by.json").read_text("utf-8"))
    assert {picture.name for _, _, picture in gallery.entries()} <= set(known)


def test_pictures_have_the_colours_they_were_drawn_with(gallery):
    """Those that are older than what draws them wait to be drawn anew."""
    waiting = gallery.old()
    for path in PICTURES.glob("*.png"):
        if path.name in waiting:
            continue
        with Image.open(path) as image:
            assert image.mode in ("RGB", "RGBA"), f"{path.name}: reduced to a palette"


def test_a_picture_is_old_when_its_script_or_its_drawing_has_changed(
    gallery, monkeypatch, tmp_path
):
    """Not when something else has, or what all figures share."""
    folder = tmp_path / "figures"
    folder.mkdir()
    script, own, other = (tmp_path / "one.py", folder / "own.py", tmp_path / "solver.py")
    files = (script, own, other, folder / "style.py")
    for path in files:
        path.write_text("x = 1\n")
    monkeypatch.setattr(gallery, "imports", lambda path: frozenset(files[1:]))
    monkeypatch.setattr(gallery, "ROOT", tmp_path)
    drawn_by = tmp_path / "pictures" / "drawn_by.json"
    drawn_by.parent.mkdir()
    (drawn_by.parent / "one.png").touch()
    about = {"script": "one.py", "digest": gallery.digest(script)}
    drawn_by.write_text(json.dumps({"one.png": about}))
    for path, expected in ((other, []), (files[3], []), (own, ["one.png"])):
        path.write_text("x = 2\n")
        assert gallery.old(drawn_by) == expected
    own.write_text("x = 1\n")
    script.write_text("x = 2\n")
    assert gallery.old(drawn_by) == ["one.png"]
    (drawn_by.parent / "two.png").touch()
    with pytest.raises(ValueError, match=r"two.png: expected"):
        gallery.old(drawn_by)


def test_a_new_picture_is_kept_with_the_script_that_is_named(gallery, monkeypatch, tmp_path):
    """Once known, its name alone renews it."""
    (tmp_path / "own.py").write_text("x = 1\n")
    drawn_by = tmp_path / "pictures" / "drawn_by.json"
    drawn_by.parent.mkdir()
    (drawn_by.parent / "own.png").touch()
    drawn_by.write_text("{}")
    monkeypatch.setattr(gallery, "ROOT", tmp_path)
    monkeypatch.setattr(gallery, "DRAWN_BY", drawn_by)

    def drawn(word):
        monkeypatch.setattr("sys.argv", ["gallery.py", "--drawn", word])
        gallery.main()

    for word, message in {
        "own": "no script for own: --drawn own=<script>",
        "own=gone.py": "own=gone.py: no such file",
        "other=own.py": "no picture other in docs/pictures",
    }.items():
        with pytest.raises(SystemExit, match=message):
            drawn(word)
    drawn("own=own.py")
    assert json.loads(drawn_by.read_text())["own.png"]["script"] == "own.py"
    (tmp_path / "own.py").write_text("x = 2\n")
    assert gallery.old(drawn_by) == ["own.png"]
    drawn("own")
    assert gallery.old(drawn_by) == []
