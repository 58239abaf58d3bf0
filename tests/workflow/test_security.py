"""Names and values are data: nothing listens, nothing from a table becomes a command or a path."""

import re
import shutil
import subprocess
import time
from pathlib import Path

import pytest
import yaml
from forked import snakemake
from rocking.configuration import config, schema
from rocking.configuration.files import check_text
from rocking.records import RecordError, read_table

from tests.trials.faults.workspace import RESULTS, SNAKEMAKE, Workspace, environment

ROOT = Path(__file__).resolve().parents[2]
SECTIONS = {name for name, _ in schema.files()}
HOSTILE = (
    "$(touch pwned)",
    "`touch pwned`",
    "a;touch pwned",
    "a|touch pwned",
    "a&&touch pwned",
    "a>pwned",
    "../outside",
    "../../../outside",
    "/outside",
    ".hidden",
    "-rf",
    "--help",
    "a b",
    "a'b",
    'a"b',
    "a\\b",
    "{wildcards.run}",
    "{input}",
    "*",
    "~",
    "a\x00b",
    "a\x1b[2J",
    "",
    "..",
    ".",
    "a/b",
    "COM\u202e1",
    "é",
    "a" * 300,
    *("a;b", "a|b", "a*", "a\x0b", "`x`", "$(x)"),
)


@pytest.mark.parametrize("name", [*HOSTILE, "a" * 65])
def test_hostile_record_names_are_refused_in_one_line(name, tmp_path):
    table = tmp_path / "records.tsv"
    text = "record\tpga_g\tpgv_cm_s\tpgd_cm\tduration_s\n" + f"{name}\t0.2\t20\t5\t15\n"
    table.write_bytes(text.encode())
    with pytest.raises(RecordError) as caught:
        read_table(table)
    assert str(table) in str(caught.value)
    assert "line 2" in str(caught.value)
    assert str(caught.value).isprintable()


@pytest.mark.parametrize("name", [*HOSTILE, "main\n"])
def test_hostile_run_and_record_names_in_the_configuration_are_refused(name):
    given = [{"run": name}, *({key: [name]} for key in ("records", "models", "directions"))]
    given += [{"building": {key: [name]}} for key in ("wme_records", "explicit_records")]
    given += [{"complete": {"check_record": name}}, {"compare": [name]}]
    if "complete" in SECTIONS:  # studies may be deleted; these options stand unquoted in commands
        given.append({"complete": {"check_direction": name}})
        given.append({"complete": {"check_pga_g": name}})
    for sections in given:
        with pytest.raises(config.ConfigError) as caught:
            config.expand_scenarios(sections)
        assert str(caught.value).isprintable()
        assert "run = " in str(caught.value) or "run" not in sections


@pytest.mark.parametrize("name", ["../outside", "a;b", "$(touch pwned)", "a/b"])
def test_hostile_scenario_names_are_refused(name):
    with pytest.raises(config.ConfigError):
        config.expand_scenarios({"scenarios": {name: {"seed": 2}}, "scenario": "all"})


def test_configuration_files_cannot_make_objects(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(config.ConfigError):
        check_text("run: !!python/object/apply:os.system ['touch pwned']", "own.yaml")
    assert not Path("pwned").exists()


LOCKS = ("requirements.lock", "requirements-all.lock")


def locked(name):
    """Hashes of every package of a lock file, by its name, version and marker."""
    text = (ROOT / name).read_text("utf-8").replace("\\\n", " ")
    lines = [line for line in text.splitlines() if re.match(r"\S+==", line)]
    found = [(line.partition(" --hash=")[0].strip(), line.split()[1:]) for line in lines]
    return {name: {word for word in words if word.startswith("--hash")} for name, words in found}


def test_what_is_locked_for_runs_is_locked_for_tests():
    runs, everything = (locked(name) for name in LOCKS)
    assert len(runs) > 20
    assert runs.items() < everything.items()


@pytest.mark.parametrize("name", LOCKS)
def test_every_locked_package_has_a_version_and_hashes(name):
    text = (ROOT / name).read_text("utf-8").replace("\\\n", " ")
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    lines = [line for line in lines if not line.strip().startswith("#")]
    assert len(lines) > 20
    for line in lines:
        assert re.match(r"\S+==\S+ ", line.strip()), line[:80]
        hashes = re.findall(r"--hash=(\S*)", line)
        assert hashes, line[:80]
        assert all(re.fullmatch("sha256:[0-9a-f]{64}", one) for one in hashes), line[:80]
    assert len(locked(name)) == len(lines)
    packages: dict = {}
    for line in (line.partition(" --hash=")[0] for line in lines):
        version, _, condition = line.partition(";")
        packages.setdefault(re.split("[=[]", version)[0].lower(), []).append(condition.strip())
    for package, conditions in packages.items():  # twice only for other machines
        assert len(set(conditions)) == len(conditions), package
        assert len(conditions) == 1 or all(conditions), package


def test_setup_does_not_empty_an_environment_behind_a_link(tmp_path):
    """A folder whose .venv is a link to another one's: refused, and nothing is lost there."""
    other, mine = tmp_path / "other", tmp_path / "mine"
    (other / "bin").mkdir(parents=True)
    (other / "bin" / "python").touch()
    (mine / "tools").mkdir(parents=True)
    shutil.copy2(ROOT / "tools" / "setup.sh", mine / "tools")
    for name in (*LOCKS, "pyproject.toml"):
        shutil.copy2(ROOT / name, mine)
    (mine / ".venv").symlink_to(other)
    if not list(Path("/usr/lib").glob("*/yade*/py/yade/__init__.py")):
        pytest.skip("setup would install YADE first")
    done = subprocess.run(["bash", "tools/setup.sh"], cwd=mine, capture_output=True, text=True)
    assert done.returncode == 1
    assert ".venv is a link" in done.stderr
    assert (other / "bin" / "python").exists()


@pytest.mark.slow
def test_a_hostile_table_ends_snakemake_in_one_line(tmp_path):
    table = tmp_path / "own.tsv"
    table.write_text(
        "record\tpga_g\tpgv_cm_s\tpgd_cm\tduration_s\n$(touch pwned)\t0.2\t20\t5\t15\n"
    )
    done = subprocess.run(
        [
            str(SNAKEMAKE),
            "-n",
            "--quiet",
            "--snakefile",
            str(ROOT / "workflow" / "Snakefile"),
            "--directory",
            str(tmp_path),
            "--config",
            "records_table=own.tsv",
        ],
        capture_output=True,
        text=True,
        env=environment(),
        cwd=tmp_path,
    )
    assert done.returncode == 1
    said = [line for line in done.stderr.splitlines() if "touch pwned" in line]
    assert len(said) == 1
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "pwned").exists()


@pytest.mark.slow
@pytest.mark.parametrize("direction", ["pos", "pos;touch pwned #", "$(touch pwned)", "up"])
def test_the_name_of_a_file_asked_for_puts_no_words_into_a_command(direction, tmp_path):
    """Direction alone stands unquoted in commands, since it is one of two words."""
    wanted = f"results/main/ida/W1/GMN_NS_{direction}.csv"
    done = snakemake(tmp_path, "-n", "--", wanted)
    refused = "No rule to produce" in done.stdout + done.stderr
    assert (done.returncode, refused) == ((0, False) if direction == "pos" else (1, True))


def listening(pids):
    """Sockets that listen (TCP) or are bound (UDP) among the open files of processes."""
    inodes = set()
    for table, state in (("tcp", "0A"), ("tcp6", "0A"), ("udp", "07"), ("udp6", "07")):
        for line in Path(f"/proc/net/{table}").read_text().splitlines()[1:]:
            fields = line.split()
            if fields[3] == state:
                inodes.add(f"socket:[{fields[9]}]")
    found = []
    for pid in pids:
        try:
            for handle in Path(f"/proc/{pid}/fd").iterdir():
                if handle.readlink().name in inodes:
                    found.append(pid)
        except OSError:
            continue
    return found


def test_the_probe_for_listening_sockets_sees_one():
    import os
    import socket

    with socket.socket() as server:
        server.bind(("127.0.0.1", 0))
        server.listen()
        assert listening([os.getpid()])


@pytest.mark.yade
@pytest.mark.slow
def test_a_run_listens_on_no_port_and_its_folder_and_files_may_have_hostile_names(tmp_path):
    space = Workspace(tmp_path / "it's a $(touch pwned); `touch pwned` & folder").fill()
    record = tmp_path / "$(touch pwned) 'quoted'; touch pwned.csv"
    lines = "".join(f"{0.01 * i:.2f},{0.5 if 20 < i < 60 else 0.0}\n" for i in range(200))
    record.write_text("time_s,acceleration_m_s2\n" + lines)
    (space.folder / "own.tsv").write_text(f"record\tfile\nBUCAR0\t{record}\n")
    study = yaml.safe_load((space.folder / "study.yaml").read_text())
    study |= {"records_table": "own.tsv", "models": ["W1"]}
    study["ida"]["grid_g"] = [0.03, 0.3]
    (space.folder / "study.yaml").write_text(yaml.safe_dump(study))
    process = space.start(targets=("ida/W1/BUCAR0_neg.csv",))
    seen_yade, looks = False, 0
    while process.poll() is None:
        found = space.processes()
        assert listening([*found, process.pid]) == []
        seen_yade |= any("yade_scripts ida" in line for line in found.values())
        looks += 1
        time.sleep(0.1)  # each look reads the tables of all processes
    assert process.returncode == 0, space.output()[-3000:]
    assert seen_yade
    assert looks > 20
    assert (space.folder / RESULTS / "ida/W1/BUCAR0_neg.csv").is_file()
    assert [p for p in tmp_path.rglob("pwned*")] == []
    shutil.rmtree(space.folder)
