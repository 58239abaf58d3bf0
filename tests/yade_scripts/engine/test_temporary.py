"""YADE's empty folders go: of this process at once, of killed ones with the next."""

import os
import shutil
import subprocess
import time
from pathlib import Path

import pytest

from yade_scripts.engine import temporary

ROOT = Path(__file__).resolve().parents[3]
PYTHON = os.environ.get("YADE_PYTHON") or shutil.which("python3", path=os.defpath)
LOADED = "import sys; sys.path.insert(0, {root!r});from yade_scripts.engine import library;"
LOADED += "from pathlib import Path; own = library.load_yade().Omega().tmpFilename();"
LOADED += "print(Path(own).parent, Path(own).parent.exists())"


@pytest.mark.yade
def test_a_process_leaves_no_folder_of_yade():
    """Where YADE put it is read from YADE, so that this fails if it moves."""
    done = subprocess.run(
        [PYTHON, "-c", LOADED.format(root=str(ROOT))], capture_output=True, text=True, timeout=120
    )
    folder, there = done.stdout.split()
    assert Path(folder).parent == temporary.PLACE
    assert there == "False"


@pytest.fixture
def left(tmp_path):
    """Folders as processes leave them, an hour old, and others that are none of these."""
    for name in ("yade-abcdef", "yade-filled", "yade-young1", "yade-longer-name", "other-abcdef"):
        (tmp_path / name).mkdir()
    (tmp_path / "yade-filled" / "tmp-0").write_text("of a user's own scene")
    old = time.time() - 3600.0
    for path in tmp_path.iterdir():
        if path.name != "yade-young1":
            os.utime(path, (old, old))
    return tmp_path


def test_what_a_killed_process_left_goes_unless_its_maker_may_live(left, monkeypatch):
    there = set(left.iterdir())
    monkeypatch.setattr(temporary, "_makers", lambda but: [time.time() - 7200.0])
    temporary.clear(left / "gone", left)
    assert set(left.iterdir()) == there  # one that began before them may have made them
    monkeypatch.setattr(temporary, "_makers", lambda but: [time.time() - 60.0])
    temporary.clear(left / "gone", left)
    assert there - set(left.iterdir()) == {left / "yade-abcdef"}
    monkeypatch.setattr(temporary, "_makers", lambda but: [])
    temporary.clear(left / "yade-young1", left)
    assert {p.name for p in left.iterdir()} == {"yade-filled", "yade-longer-name", "other-abcdef"}


@pytest.mark.yade
def test_a_process_that_has_yade_is_seen_and_when_it_began():
    code = LOADED.format(root=str(ROOT)) + "; sys.stdout.flush(); import time; time.sleep(60)"
    before = time.time()
    with subprocess.Popen([PYTHON, "-c", code], stdout=subprocess.PIPE) as process:
        assert process.stdout.readline().endswith(b"False\n")
        assert any(before - 1.0 < began < time.time() for began in temporary._makers(os.getpid()))
        process.kill()
