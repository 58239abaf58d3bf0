"""What was measured lies in one compressed record, and its page lists what is in it."""

import importlib.util
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def tool():
    found = importlib.util.spec_from_file_location("tool", ROOT / "tools" / "pack_record.py")
    module = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    return module


def test_the_page_lists_what_the_record_has():
    own = tool()
    pages = own.packed()
    assert len(pages) > 10
    assert own.PAGE.read_text("utf-8") == own.listed(pages)
    assert not own.LOG.exists(), "pack it: python tools/pack_record.py"


def test_packing_adds_a_page_replaces_one_and_gives_the_same_bytes(tmp_path, monkeypatch):
    own = tool()
    names = {
        "ROOT": "",
        "LOG": "docs/log",
        "RECORD": "docs/record.tar.xz",
        "PAGE": "docs/record.md",
    }
    for name, place in names.items():
        monkeypatch.setattr(own, name, tmp_path / place)
    monkeypatch.setattr("sys.argv", ["pack_record.py"])
    own.LOG.mkdir(parents=True)
    (tmp_path / "docs" / "page.md").write_text(
        "[all](log/walls.md#two-walls), [log](log/README.md)"
    )
    (own.LOG / "walls.md").write_text("# Walls\n\n## Two walls\n\n0.1 g\n", "utf-8")
    own.main()
    assert (tmp_path / "docs" / "page.md").read_text() == "[all](record.md#walls), [log](record.md)"
    assert "## walls\n\n- Two walls\n" in own.PAGE.read_text("utf-8")
    before = own.RECORD.read_bytes()
    own.LOG.mkdir()
    (own.LOG / "walls.md").write_text("# Walls\n\n## Three walls\n", "utf-8")
    (own.LOG / "floors.md").write_text("# Floors\n", "utf-8")
    own.main()
    assert list(own.packed()) == ["floors.md", "walls.md"]
    assert "Three walls" in own.packed()["walls.md"]
    assert own.RECORD.read_bytes() != before
    monkeypatch.setattr("sys.argv", ["pack_record.py", "--unpack"])
    own.main()
    again = own.RECORD.read_bytes()
    monkeypatch.setattr("sys.argv", ["pack_record.py"])
    own.main()
    assert own.RECORD.read_bytes() == again
