"""Results dated in the future do not stop a run."""

import os
from types import SimpleNamespace

from rocking.runtime import script
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


def test_the_files_of_a_job_are_dated_alike(tmp_path):
    """A link to the first of them stands for all: Snakemake refuses one older than the last."""
    paths = [tmp_path / "a.csv", tmp_path / "a.json"]

    def main(job):
        for path, date_s in zip(paths, (1e9, 1e9 + 3), strict=True):
            path.write_text("")
            os.utime(path, (date_s, date_s))

    job = SimpleNamespace(output=[*map(str, paths), str(tmp_path / "not made")], log=None)
    script.run(main, {"snakemake": job})
    assert [path.stat().st_mtime for path in paths] == [1e9 + 3] * 2
