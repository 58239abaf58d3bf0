"""Configuration files that would run code or stall are refused in one line before they are read."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
import yaml
from forked import snakemake
from rocking import Case
from rocking.configuration import config, refusals
from rocking.configuration.files import check_files, check_text, read_yaml, refuse_harmful
from rocking.configuration.schema import ConfigError
from rocking.start import guard

ROOT = Path(__file__).resolve().parents[2]
RUNS = '__use_yte__: true\nrun: ?open("ran", "w").write("x") and "mine"\n'
NINES = "a0: &a0 {k: 1}\n" + "".join(
    f"a{k}: &a{k}\n  <<: [{', '.join([f'*a{k - 1}'] * 9)}]\n" for k in range(1, 9)
)
HARMFUL = {
    "template": (RUNS, "__use_yte__"),
    "template by a merge": ("b: &b {__use_yte__: true}\n<<: *b\nrun: ?1\n", "__use_yte__"),
    "template by a list of merges": (
        "b: &b {__use_yte__: true}\nc: &c {k: 1}\n<<: [*c, *b]\nrun: ?1\n",
        "__use_yte__",
    ),
    "template by a merge of a merge": (
        "a: &a {__use_yte__: true}\nb: &b {<<: *a}\n<<: *b\nrun: ?1\n",
        "__use_yte__",
    ),
    "template as JSON": ('{"__use_yte__": true, "run": "x"}', "__use_yte__"),
    "template, untrue": ("__use_yte__: 0\nrun: x\n", "__use_yte__"),
    "merges of merges": (NINES, "values with all aliases"),
    "lists of lists": (NINES.replace("<<:", "k:"), "values with all aliases"),
    "itself": ("a: &a [*a]\n", "line 1: stands within itself"),
    "much": ("".join(f"k{k}: {k}\n" for k in range(30_000)), "larger than 250000 bytes"),
    "digits": (f"run: a\nseed: {'7' * 4000}\n", "line 2: a number of 4000 characters"),
    "base 60 with a fraction": (
        f"seed: {'1' + ':59' * 4000}.5\n",
        "line 1: a number of 12003 characters",
    ),
    "base 60": (f"seed: {'1' + ':59' * 4000}\n", "line 1: a number of 12001 characters"),
}


@pytest.mark.parametrize("name", HARMFUL)
@pytest.mark.parametrize("read", [refuse_harmful, read_yaml, lambda path: check_files([path])])
def test_a_file_that_runs_code_or_stalls_is_refused_in_one_line(tmp_path, name, read):
    text, said = HARMFUL[name]
    path = tmp_path / "theirs.yaml"
    path.write_text(text)
    with pytest.raises(ConfigError) as caught:
        read(path)
    line = str(caught.value)
    assert said in line
    assert str(path) in line
    assert "\n" not in line


def test_no_more_is_read_of_a_file_than_a_configuration_may_have(tmp_path):
    path = tmp_path / "vast.yaml"
    with open(path, "wb") as handle:
        handle.truncate(50 * 2**30)  # without blocks of its own
    for read in (refuse_harmful, read_yaml):
        with pytest.raises(ConfigError, match="larger than 250000 bytes"):
            read(path)


def test_what_is_no_file_is_not_waited_for(tmp_path):
    """A pipe that nobody writes to, and a device without an end."""
    os.mkfifo(tmp_path / "pipe.yaml")
    for path in (tmp_path / "pipe.yaml", "/dev/zero"):
        for read in (refuse_harmful, read_yaml):
            with pytest.raises(ConfigError, match="neither a file nor a link to one"):
                read(path)


def test_bytes_that_yaml_does_not_take_are_told_in_one_line():
    with pytest.raises(ConfigError, match="own.yaml: not readable as YAML") as caught:
        check_text("run: a\0b\n", "own.yaml")
    assert "\n" not in str(caught.value)


def test_a_key_as_long_as_a_page_is_compared_with_no_other(monkeypatch):
    """The nearest of all keys takes a time that grows with the square of the length."""
    lengths = []
    monkeypatch.setattr(
        refusals.difflib, "get_close_matches", lambda word, *_: lengths.append(len(word)) or []
    )
    for key in ("hight_m", "k" * 5000):
        with pytest.raises(ConfigError, match="unknown key 'facade"):
            config.resolve({"facade": {key: 1}})
    assert set(lengths) == {len("hight_m")}


def test_aliases_that_people_write_are_read():
    check_text("a: &a {x: 1}\nb: {<<: *a, y: 2}\nc: [*a, *a]\n", "own.yaml")


def test_a_case_of_a_template_is_refused(tmp_path):
    path = tmp_path / "theirs.yaml"
    path.write_text(RUNS)
    with pytest.raises(ValueError, match="theirs.yaml: __use_yte__ would run code"):
        Case.configured("W1", path)
    with pytest.raises(ValueError, match="__use_yte__"):
        Case.configured("W1", {"__use_yte__": True})


def test_the_folder_s_own_file_runs_no_code_under_n_either(tmp_path):
    (tmp_path / "config").mkdir()
    (tmp_path / "config" / "config.yaml").write_text(RUNS)
    done = snakemake(tmp_path, "-n", "--", "check")
    assert done.returncode
    (line,) = [one for one in done.stderr.splitlines() if one.startswith("error: ")]
    assert "config/config.yaml: __use_yte__ would run code" in line
    assert not (tmp_path / "ran").exists()


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda path: None, "theirs.yaml: No such file or directory"),
        (lambda path: path.mkdir(), "theirs.yaml: Is a directory"),
        (lambda path: path.symlink_to(path), "theirs.yaml: Too many levels of symbolic links"),
        (lambda path: path.write_bytes(b"run: \xff\n"), "theirs.yaml: not UTF-8 text at byte 5"),
        (lambda path: path.write_text(""), "theirs.yaml: expected keys at the top level"),
        (lambda path: path.write_text("- a\n"), "theirs.yaml: expected keys at the top level"),
        (lambda path: path.write_text("run: a\n b: [\n"), "theirs.yaml line 2"),
        (lambda path: path.write_text("run: a\nrun: b\n"), "line 2: key 'run' stands twice"),
    ],
)
def test_what_is_no_configuration_ends_in_one_line(tmp_path, monkeypatch, make, said):
    from snakemake.common import configfile

    monkeypatch.setattr(configfile, "_load_configfile", configfile._load_configfile)
    guard()
    path = tmp_path / "theirs.yaml"
    make(path)
    with pytest.raises(SystemExit) as caught:
        configfile.load_configfile(str(path))
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


PROFILES = [f"--workflow-profile={ROOT}/profiles/{kind}" for kind in ("slurm", "portfolio")]


@pytest.mark.parametrize(
    "start", [["rocking.start"], ["snakemake"], *(["snakemake", one] for one in PROFILES)]
)
def test_what_configfile_names_is_looked_at_before_snakemake_reads_it(tmp_path, start):
    """By the command that `make setup` writes and by any other, however the option is spelt."""
    (tmp_path / "theirs.yaml").write_text(RUNS)
    module, *profile = start
    words = [module, "-s", str(ROOT / "workflow/Snakefile"), *profile, "-n", "--cores", "1"]
    done = subprocess.run(
        [sys.executable, "-m", *words, "--configfiles=theirs.yaml", "--", "check"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1] == (
        "error: config: theirs.yaml: __use_yte__ would run code of the file; expected plain values"
    )
    assert not (tmp_path / "ran").exists()


def test_every_profile_of_ours_looks_first_and_the_command_of_the_setup_too():
    asks = [yaml.safe_load(path.read_text("utf-8")) for path in ROOT.glob("profiles/*/config.yaml")]
    assert len(asks) == 3
    assert all(one["__use_yte__"] is True for one in asks)
    assert len({str(one["__definitions__"]) for one in asks}) == 1
    setup = (ROOT / "tools/setup.sh").read_text("utf-8")
    assert "from rocking.start import main" in setup
    assert '__name__ == "__main__"' in setup  # a server of scripts reads that file again


def test_a_folder_that_cannot_be_made_is_told_by_any_snakemake(tmp_path):
    (tmp_path / "file").touch()
    words = [
        "-s",
        str(ROOT / "workflow/Snakefile"),
        "-n",
        "--directory",
        "file/below",
        "--",
        "check",
    ]
    done = subprocess.run(
        [sys.executable, "-m", "snakemake", "--cores", "1", *words],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1].startswith("error: --directory file/below: ")
    assert "Traceback" not in done.stderr
