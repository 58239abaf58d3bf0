"""Results dated in the future do not stop a run."""

import os

from rocking.runtime.file_times import settle


def test_only_files_from_the_future_are_dated_to_the_present(tmp_path):
    now = 1_000_000_000.0
    for name, age in (("old", 500.0), ("tomorrow", -86400.0), ("soon", -1.0)):
        path = tmp_path / "tables" / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(name)
        os.utime(path, (now - age, now - age))
    (tmp_path / "link").symlink_to(tmp_path / "tables" / "nowhere")
    assert settle(tmp_path, now) == 2
    times = {p.name: p.stat().st_mtime for p in (tmp_path / "tables").iterdir()}
    assert times == {"old": now - 500.0, "tomorrow": now, "soon": now}
    assert settle(tmp_path, now) == 0
    assert settle(tmp_path / "absent", now) == 0
