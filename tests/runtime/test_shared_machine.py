"""On a machine with other users: nothing of theirs is run, nothing of one's own is emptied."""

import os
import re
import subprocess
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd
import pytest
from rocking import start
from rocking.figures import style
from rocking.runtime import results_folder, run_lock, warm
from rocking.runtime.compiled import is_own
from rocking.tables import as_text, read_frame, write_table

ROOT = Path(__file__).resolve().parents[2]
PATHS = os.pathsep.join([str(ROOT), str(ROOT / "workflow")])
ADDED = "from rocking.runtime.compiled import looped\n@looped\ndef f(x):\n    return x + 1.0\n"
CALLED = "from own import f; print(f(1.0), f.stats.cache_hits)"
NOBODY = 65534


@pytest.fixture
def source(tmp_path):
    """A module with a loop, in a folder of its own."""
    folder = tmp_path / "code"
    folder.mkdir(mode=0o755)
    path = folder / "own.py"
    path.write_text(ADDED)
    return path


def test_what_others_may_write_is_no_place_for_what_is_run(tmp_path, source):
    cache = tmp_path / "cache"
    cache.mkdir(mode=0o755)
    kept = cache / "a.nbc"
    kept.write_bytes(b"")
    kept.chmod(0o644)
    assert is_own(cache, source)
    assert is_own(kept, source)
    for mode in (0o666, 0o646):
        kept.chmod(mode)
        assert not is_own(kept, source), oct(mode)
    cache.chmod(0o777)
    assert is_own(cache, source)  # one's own is closed
    assert cache.stat().st_mode & 0o777 == 0o755
    assert not is_own(tmp_path / "absent", source)


def test_a_folder_that_a_group_may_write_is_as_safe_as_code_that_it_may(tmp_path, source):
    cache = source.parent / "__pycache__"
    cache.mkdir()
    cache.chmod(0o775)
    source.parent.chmod(0o775)
    assert is_own(cache, source)
    assert cache.stat().st_mode & 0o777 == 0o775
    cache.chmod(0o777)
    assert is_own(cache, source)
    assert cache.stat().st_mode & 0o777 == 0o775


@pytest.mark.skipif(os.geteuid() != 0, reason="gives a folder to another user")
def test_a_folder_of_another_user_is_left_alone(tmp_path, source):
    cache = tmp_path / "theirs"
    cache.mkdir(mode=0o755)
    os.chown(cache, NOBODY, NOBODY)
    assert not is_own(cache, source)
    os.chown(source.parent, NOBODY, NOBODY)  # who can write the code can do it there
    assert is_own(cache, source)


def called(source, cache):
    """What a process prints that calls the loop with a cache of machine code."""
    done = subprocess.run(
        [sys.executable, "-c", CALLED],
        cwd=source.parent,
        env={**os.environ, "PYTHONPATH": f"{source.parent}:{PATHS}", "NUMBA_CACHE_DIR": str(cache)},
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return done.stdout.split(), done.stderr


@pytest.mark.slow
@pytest.mark.skipif(os.geteuid() != 0, reason="gives a folder to another user")
def test_machine_code_that_others_may_have_written_is_not_run(tmp_path, source):
    cache = tmp_path / "cache"
    assert called(source, cache)[0][0] == "2.0"
    (folder,) = cache.iterdir()
    for path in folder.iterdir():
        assert path.stat().st_mode & 0o022 == 0
        path.write_bytes(b"cos\nsystem\n(S'touch planted'\ntR.")  # a pickle that runs a command
        path.chmod(0o666)
    assert called(source, cache)[0][0] == "2.0"
    os.chown(folder, NOBODY, NOBODY)
    for path in folder.iterdir():
        path.write_bytes(b"cos\nsystem\n(S'touch planted'\ntR.")
        path.chmod(0o644)
    answer, said = called(source, cache)
    assert answer[0] == "2.0"
    assert said.count("others may write there") == 1
    assert not (source.parent / "planted").exists()


def test_a_lock_empties_nothing_that_a_link_leads_to(tmp_path):
    folder = tmp_path / run_lock.FOLDER
    folder.mkdir(parents=True)
    mine = tmp_path / "mine.txt"
    mine.write_text("work of years\n")
    lock = folder / "run-main.lock"
    others = [lambda _: os.mkfifo(lock), lambda _: lock.mkdir()]
    for make in (lock.symlink_to, lock.hardlink_to, *others):
        make(mine)
        with pytest.raises(ValueError, match=r"run-main.lock: expected a lock's file") as caught:
            run_lock.hold(["main"], folder=tmp_path)
        assert "\n" not in str(caught.value)
        lock.rmdir() if lock.is_dir() else lock.unlink()
    assert mine.read_text() == "work of years\n"
    run_lock.hold(["main"], folder=tmp_path)
    run_lock._held.pop().close()


def test_a_folder_of_locks_that_is_a_link_or_a_file_is_refused(tmp_path):
    """What it leads to gets no file; a link in the place of `.snakemake` is Snakemake's own."""
    locks = tmp_path / run_lock.FOLDER
    theirs = tmp_path / "theirs"
    theirs.mkdir()
    locks.parent.mkdir()
    said = r"rocking: expected the folder of locks, not a link or a file"
    for make in (lambda: locks.symlink_to(theirs), lambda: locks.write_text("a file")):
        make()
        with pytest.raises(ValueError, match=said) as caught:
            run_lock.hold(["main"], folder=tmp_path)
        assert "\n" not in str(caught.value)
        locks.unlink()
    assert not list(theirs.iterdir())
    locks.parent.rmdir()
    locks.parent.write_text("a file")
    with pytest.raises(ValueError, match=r"\.snakemake: expected the folder of locks"):
        run_lock.hold(["main"], folder=tmp_path)
    locks.parent.unlink()
    locks.parent.symlink_to(theirs)
    run_lock.hold(["main"], folder=tmp_path)
    run_lock._held.pop().close()
    assert (theirs / "rocking/run-main.lock").is_file()


def test_a_home_that_cannot_be_written_is_said_in_one_line(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", "/dev/null")
    for name in ("XDG_CACHE_HOME", "MPLCONFIGDIR"):
        monkeypatch.setenv(name, "")
        monkeypatch.delenv(name)
    start.settle_caches()
    assert os.environ["XDG_CACHE_HOME"] == str(tmp_path / ".snakemake/cache")
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("warning: no cache in the home folder")
    start.settle_caches()  # what can be written is taken as it is
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    ("name", "asked", "said"),
    [("there", os.X_OK, "enter"), ("there/new/below", os.W_OK | os.X_OK, "make a folder in")],
)
def test_a_folder_without_the_right_is_told_by_the_right_that_lacks(
    tmp_path, monkeypatch, name, asked, said
):
    there = tmp_path / "there"
    there.mkdir()
    seen = []
    monkeypatch.setattr(results_folder.os, "access", lambda *given: bool(seen.append(given)))
    assert results_folder.unreachable(tmp_path / name) == f"no right to {said} {there}"
    assert seen == [(there, asked)]
    monkeypatch.setattr(results_folder.os, "access", lambda *given: True)
    assert results_folder.unreachable(tmp_path / name) == ""


def test_a_working_folder_that_is_gone_is_said_in_one_line(tmp_path, monkeypatch):
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    with pytest.raises(SystemExit, match="error: the working folder is gone") as caught:
        start.prepare()
    assert "\n" not in str(caught.value)


SERVED = """
import sys
sys.path[:0] = {paths!r}
import os
from rocking.runtime import warm
warm.LIBRARIES = ()
os.environ.pop("PYTHONSAFEPATH", None)
if __name__ == "__main__":
    server = warm.Server()
    server.run({script!r})
"""


def test_files_of_the_working_folder_are_no_modules_of_the_server(tmp_path):
    """It is started by `python -c`, which looks for modules in the working folder first."""
    here, there = tmp_path / "here", tmp_path / "there"
    here.mkdir()
    there.mkdir()
    for name in ("random", "signal", "tempfile", "subprocess"):
        (here / f"{name}.py").write_text(f"open('ran_{name}', 'w')\nraise SystemExit(3)\n")
    script = there / "script.py"
    script.write_text("import os\nopen('done', 'w').write(str(os.environ.get('PYTHONSAFEPATH')))\n")
    words = SERVED.format(paths=PATHS.split(os.pathsep), script=str(script))
    (there / "main.py").write_text(words)
    done = subprocess.run(
        [sys.executable, str(there / "main.py")],
        cwd=here,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    assert not list(here.glob("ran_*"))
    assert (here / "done").read_text() == "None"  # what scripts start finds modules as ever
    assert warm.SAFE_PATH == "PYTHONSAFEPATH"


DRAWS = "import rocking.figures.style, matplotlib as m; print(m.rcParams['text.usetex'])"


def test_a_style_of_the_working_folder_is_not_that_of_figures(tmp_path):
    (tmp_path / "matplotlibrc").write_text("text.usetex: True\nfont.size: 40\n")
    done = subprocess.run(
        [sys.executable, "-c", DRAWS],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": PATHS},
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.stdout.split() == ["False"], done.stderr[-1000:]


@pytest.mark.parametrize("name", ["$", "a $b$ c", r"$\frac$", "$x^$", r"$\input{a}$"])
def test_signs_of_mathematics_in_a_name_stop_no_figure(tmp_path, name):
    facts = {"name": "A", "source": "file", "details": {"event": name, "file": "a.txt"}}
    (line,) = style.sources([facts])
    figure, axis = plt.subplots()
    axis.set_title(style.provenance({"name": name, "source": "file"}))
    axis.set_xlabel(name)
    axis.set_ylabel("e$_{exp}$")  # our own is read
    figure.text(0.5, 0.0, style.as_written(line))
    style.save(figure, [str(tmp_path / "a.png")])
    assert (tmp_path / "a.png").stat().st_size > 1000
    assert axis.yaxis.label.get_parse_math()
    assert style.as_written("a $b$ c") == r"a \$b\$ c"


@pytest.mark.parametrize(
    "text",
    [
        "=1+1",
        "@SUM(A1)",
        " =1+1",
        "\n=1",
        "＝1+1",
        "\ufeff=1",
        "+cmd|' /C calc'!A0",
        '-HYPERLINK("x")',
        "\t=1",
        "-2+3*a",
        "\r=1",
    ],
)
def test_no_cell_is_a_formula(tmp_path, text):
    for table in ([{"event": text, "g": -0.5}], pd.DataFrame({"event": pd.Categorical([text])})):
        write_table(table, tmp_path / "t.csv")
        read = pd.read_csv(tmp_path / "t.csv")
        assert read["event"].tolist() == ["'" + text.replace("\r", "\n")]
        assert read_frame(tmp_path / "t.csv")["event"].tolist() == [text.replace("\r", "\n")]
    assert as_text(as_text(text)) == as_text(text)


@pytest.mark.parametrize("text", ["-0.5", "+1e-3", "-", "+A1", "a=b", "RRS228", "", "pos", -0.5])
def test_names_and_numbers_stay_as_they_are(tmp_path, text):
    frame = pd.DataFrame({"event": [text, "x"]})
    write_table(frame, tmp_path / "t.csv", digits=None)
    assert (tmp_path / "t.csv").read_text().splitlines()[1] == (str(text) or '""')
    assert frame["event"][0] == text


def test_a_table_that_is_written_is_not_changed(tmp_path):
    frame = pd.DataFrame({"event": ["=1"]})
    write_table(frame, tmp_path / "t.csv")
    assert frame["event"][0] == "=1"


SAFE = """replace("`", "'") | replace("\\n", " ")"""
OF_USERS = re.compile(r"snakemake\.(input|output|log|config)\b")


def unsafe(caption):
    """Tags of a caption through which a file's name reaches the report as it is."""
    written = [part for part in re.findall(r"(?s)\{\{(.*?)\}\}", caption) if SAFE not in part]
    others = re.findall(r"(?s)\{%(.*?)%\}", caption)
    return [part for part in (*written, *others) if OF_USERS.search(part)]


def test_captions_write_files_as_literals_that_no_name_ends():
    """A backtick in a file's name would end the literal, and the rest could be a link."""
    folders = [ROOT / "workflow/report", *ROOT.glob("workflow/studies/*/captions")]
    paths = [path for folder in folders for path in folder.glob("*.rst")]
    assert len(paths) > 5
    assert {path.name: found for path in paths if (found := unsafe(path.read_text("utf-8")))} == {}


@pytest.mark.parametrize(
    "caption",
    [
        *("``{{ snakemake.input.table }}``", "{{snakemake.config['run']}}"),
        "{% for f in snakemake.input %}{{ f }}{% endfor %}",
    ],
)
def test_the_check_of_captions_finds(caption):
    assert unsafe(caption)
    assert not unsafe(f"{{{{ snakemake.input.hazard | {SAFE} }}}}")


def test_a_folder_that_cannot_be_entered_is_said_before_snakemake_goes_there(tmp_path, monkeypatch):
    """However the option is spelt; one that is not there yet is made as ever."""
    (tmp_path / "mine.txt").write_text("work of years\n")
    (tmp_path / "there").mkdir()
    from snakemake import cli

    monkeypatch.setattr(cli, "args_to_api", lambda words, parser: words.directory)
    start.look_at_folder()
    monkeypatch.chdir(tmp_path)

    def entered(*words):
        parser, given = cli.parse_args(["--cores", "1", *words])
        return cli.args_to_api(given, parser)

    for words in (["-d", "mine.txt"], ["--directory=mine.txt/below"], ["--direc", "mine.txt"]):
        with pytest.raises(SystemExit) as caught:
            entered(*words)
        assert str(caught.value).startswith("error: --directory mine.txt")
        assert str(caught.value).endswith(f"{tmp_path}/mine.txt is no folder")
    with pytest.raises(SystemExit, match="File name too long"):
        entered("-d", "a" * 300)
    for name in ("there", "not/yet"):
        assert entered("-d", name) == Path(name)
