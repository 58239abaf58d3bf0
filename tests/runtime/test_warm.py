"""Scripts forked from a server are what they are when Python starts them."""

import json
import os
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import pytest
from rocking.runtime import warm
from rocking.runtime.fallback import left_out_if_unknown
from snakemake import benchmark
from snakemake.script import PythonScript

ROOT = Path(__file__).resolve().parents[2]

TELL = """
import json, os, sys
loaded = "pandas" in sys.modules
told = {"name": __name__, "argv": sys.argv, "folder": os.getcwd(), "parent": os.getppid(),
        "loaded": loaded, "threads": os.environ["OMP_NUM_THREADS"]}
"""

SNAKEFILE = """
from rocking.runtime import warm
from rocking.runtime.fallback import left_out_if_unknown

onstart:
    with left_out_if_unknown("a server of scripts"):
        warm.serve(workflow)

rule all:
    input: expand("{{n}}.json", n=[1, 2, 3, 4])


rule tell:
    input: modules={modules!r}
    output: "{{n}}.json"
    log: "{{n}}.log"
    benchmark: "{{n}}.tsv"
    params: number=lambda w: int(w.n)
    script: "tell.py"
"""


def snakemake(folder, *arguments):
    command = [sys.executable, "-m", "snakemake", "--cores", "2", "--quiet", "all", *arguments]
    environment = {**os.environ, "PYTHONPATH": f"{ROOT}:{ROOT / 'workflow'}"}
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, timeout=120
    )


@pytest.mark.slow
def test_snakemake_starts_many_scripts_from_one_server(tmp_path):
    """Same parent, libraries there already; params, log and benchmark as ever."""
    (tmp_path / "tell.py").write_text(
        TELL + 'told["number"] = snakemake.params.number\n'
        'json.dump(told, open(snakemake.output[0], "w"))\n'
    )
    (tmp_path / "Snakefile").write_text(SNAKEFILE.format(modules=["tell.py"]))
    done = snakemake(tmp_path)
    assert done.returncode == 0, done.stderr
    told = [json.loads((tmp_path / f"{n}.json").read_text()) for n in (1, 2, 3, 4)]
    assert [t["number"] for t in told] == [1, 2, 3, 4]
    assert len({t["parent"] for t in told}) == 1
    for t in told:
        assert t["loaded"]
        assert (t["name"], t["folder"], t["threads"]) == ("__main__", str(tmp_path), "1")
        assert len(t["argv"]) == 1
        assert t["argv"][0].endswith("tell.py")
    assert (tmp_path / "1.tsv").read_text().startswith("s\t")


OTHER = """
from snakemake.script import PythonScript

known = PythonScript.execute_script
PythonScript.execute_script = lambda self, fname, **more: known(self, fname, **more)
"""


@pytest.mark.slow
def test_in_another_release_scripts_start_as_snakemake_starts_them(tmp_path):
    """It has other parameters: a line says so, and every script is a process of its own."""
    (tmp_path / "tell.py").write_text(TELL + 'json.dump(told, open(snakemake.output[0], "w"))\n')
    (tmp_path / "Snakefile").write_text(OTHER + SNAKEFILE.format(modules=["tell.py"]))
    done = snakemake(tmp_path)
    assert done.returncode == 0, done.stderr
    assert "warning: without a server of scripts: Snakemake differs here" in done.stderr
    told = [json.loads((tmp_path / f"{n}.json").read_text()) for n in (1, 2, 3, 4)]
    assert not any(one["loaded"] for one in told)


SCRIPT = {
    "container_img": None,
    "conda_env": None,
    "env_modules": None,
    "threads": 1,
    "bench_record": None,
    "resources": {"tmpdir": "here"},
    "input": {},
}


@pytest.fixture
def started(monkeypatch):
    """What was started and how, after `warm.serve` of a workflow of three scripts."""
    found = []

    class Server:
        began_s = 0.0

        def __init__(self, modules):
            pass

        def run(self, path, watched, temporary):
            with watched(1):
                found.append(("forked", path, temporary))

    def plain(self, fname, edit=False):
        found.append(("plain", fname))

    job = SimpleNamespace(rule=SimpleNamespace(script="a.py"), input={})
    dag = SimpleNamespace(needrun_jobs=lambda: 3 * [job])
    monkeypatch.setattr(warm, "Server", Server)
    monkeypatch.setattr(PythonScript, "execute_script", plain)
    with left_out_if_unknown("a server of scripts"):
        warm.serve(SimpleNamespace(dag=dag))
    return found


@pytest.mark.parametrize("unknown", [None, *SCRIPT])
def test_a_script_without_what_is_known_of_it_starts_as_snakemake_starts_it(started, unknown):
    script = SimpleNamespace(**{name: v for name, v in SCRIPT.items() if name != unknown})
    PythonScript.execute_script(script, "a.py")
    assert started == [("plain", "a.py") if unknown else ("forked", "a.py", "here")]


@pytest.fixture
def other_benchmarks(monkeypatch):
    monkeypatch.setattr(benchmark, "benchmarked", lambda process, into: None)


def test_without_benchmarks_as_they_are_known_scripts_start_as_snakemake_starts_them(
    capsys, other_benchmarks, started
):
    """Else the script would run, and its job fail."""
    PythonScript.execute_script(SimpleNamespace(**SCRIPT | {"bench_record": []}), "a.py")
    assert started == [("plain", "a.py")]
    assert "without a server of scripts: Snakemake differs" in capsys.readouterr().err


def test_a_script_s_end_is_its_own(tmp_path, monkeypatch):
    """Exit status, an exception, a signal: an error each; the next script runs all the same."""
    monkeypatch.setattr(warm, "LIBRARIES", ())
    monkeypatch.chdir(tmp_path)
    server = warm.Server()
    Path("good.py").write_text("import os; open(str(os.getpid()), 'w')\n")
    for name, code, status in (
        ("exit", "raise SystemExit(3)", 3),
        ("raise", "raise KeyError", 1),
        ("killed", "import os; os.kill(os.getpid(), 9)", -9),
    ):
        Path(f"{name}.py").write_text(code)
        with pytest.raises(subprocess.CalledProcessError) as caught:
            server.run(f"{name}.py")
        assert caught.value.returncode == status
    threads = [threading.Thread(target=server.run, args=("good.py",)) for _ in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert len([path for path in Path().iterdir() if path.name.isdigit()]) == 6


def test_what_changed_since_the_server_started_is_not_run_from_it(tmp_path):
    (tmp_path / "a.py").write_text("")
    now = time.time()
    os.utime(tmp_path / "a.py", (now - 5, now - 5))
    assert warm.is_current([tmp_path / "a.py"], now)
    os.utime(tmp_path / "a.py", (now + 5, now + 5))
    assert not warm.is_current([tmp_path / "a.py"], now)
    assert warm.is_current([], now)
