"""Runs share their motions: one file under many names, whatever else the study has."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml
from forked import snakemake
from rocking.configuration.config import expand_scenarios
from rocking.runs import Shared
from run_script import script

ROOT = Path(__file__).resolve().parents[2]
STUDY = {
    "run": "s",
    "records_table": "config/records.tsv",
    "records": ["BUCAR0"],
    "models": ["W1"],
    "scenarios": {
        "thin": {"facade": {"thickness_m": 0.3}},
        "thick": {"facade": {"thickness_m": 0.4}},
        "soft": {"smdof": {"period_s": 0.5}},
    },
}


@pytest.mark.parametrize(
    ("override", "same"),
    [
        ({"facade": {"height_m": 5.0}, "models": ["W2"], "records": ["RRS228"]}, (True, True)),
        ({"smdof": {"damping_ratio": 0.02}}, (True, False)),
        ({"baseline": {"highpass_hz": 0.1}}, (False, True)),
        ({"seed": 3}, (False, True)),
        ({"vertical_motion": "on"}, (False, True)),
        ({"records_table": "config/suites/recorded_suite.tsv"}, (False, True)),
    ],
)
def test_what_makes_a_motion_decides_where_it_is_kept(override, same):
    study = {**STUDY, "scenarios": {**STUDY["scenarios"], "other": override}}
    keys = Shared(expand_scenarios(study)).keys
    assert tuple(keys["s-thin"][k] == keys["s-other"][k] for k in ("motions", "chain")) == same
    alone = Shared(expand_scenarios({**study, "scenario": "other"})).keys
    assert alone == {"s-other": keys["s-other"]}


def test_runs_alike_are_found_by_the_wildcards_of_a_file():
    shared = Shared(expand_scenarios(STUDY))
    motions, chain = shared.keys["s-thick"].values()
    assert shared.alike({"motions": motions, "record": "A"}) == ["s-thin", "s-thick", "s-soft"]
    assert shared.alike({"motions": motions, "chain": chain}) == ["s-thin", "s-thick"]
    assert shared.label({"motions": motions}) == "s-thin and 2 more"


def printed(folder, *words):
    """Run the study in a folder; return what it printed."""
    done = snakemake(folder, *words)
    assert done.returncode == 0, done.stderr[-3000:]
    return done.stdout + done.stderr


@pytest.mark.slow
def test_a_motion_is_made_once_and_stands_in_every_run(tmp_path):
    """Two runs have the same file, the third its own chain; alone, a run finds all there."""
    (tmp_path / "study.yaml").write_text(yaml.safe_dump(STUDY))
    names = ("records/BUCAR0.json", "smdof/BUCAR0_4dof.csv")
    runs = ("s-thin", "s-thick", "s-soft")
    wanted = [f"results/{run}/{name}" for run in runs for name in names]
    study = ("--configfile", "study.yaml", "--")
    counted = printed(tmp_path, "-n", "--quiet", "rules", *study, *wanted)
    jobs = dict(line.split() for line in counted.splitlines() if len(line.split()) == 2)
    assert (jobs["record"], jobs["floor_motions"], jobs["own_record"]) == ("1", "2", "3")
    printed(tmp_path, *study, *wanted)
    record, motion = ([tmp_path / "results" / run / name for run in runs] for name in names)
    assert len({path.read_bytes() for path in record}) == 1
    assert motion[0].read_bytes() == motion[1].read_bytes() != motion[2].read_bytes()
    again = ("-n", "--config", "scenario=thick", *study[:2])
    assert "Nothing to be done" in printed(tmp_path, *again, "--", wanted[2], wanted[3])
    # what is asked for alone, or deleted, does not date what others compute from
    (shared,) = (tmp_path / "results/.shared").glob("*/records/BUCAR0.json")
    before_ns = shared.stat().st_mtime_ns
    record[0].unlink()
    printed(tmp_path, *study, wanted[0])
    assert record[0].read_bytes() == record[1].read_bytes()
    assert shared.stat().st_mtime_ns == before_ns


@pytest.mark.slow
def test_the_main_job_makes_a_deleted_motion_again(tmp_path):
    """No rule takes a run's own name of a motion as input."""
    folder = tmp_path / "results/s/smdof"
    given = {**STUDY, "models": ["W1"], "directions": ["neg"], "scenarios": {}}
    (tmp_path / "study.yaml").write_text(yaml.safe_dump(given))
    study = ("--configfile", "study.yaml", "--")
    printed(tmp_path, *study, "results/s/tables/shared.csv")
    (made,) = folder.glob("*.csv")
    assert "own_floor_motions" not in printed(tmp_path, "-n", "--quiet", "rules", *study, "all")
    made.unlink()
    planned = printed(tmp_path, "-n", "--quiet", "rules", *study, "all")
    assert re.search(r"own_floor_motions +1", planned)


def test_a_run_s_names_are_made_again_where_they_stand_already(tmp_path):
    """A link to the same file, to an older one, and a missing one all end as the shared file."""
    kept = tmp_path / "results/.shared/abc"
    own = tmp_path / "results/r"
    for folder in (kept / "records", kept / "figures", own / "records"):
        folder.mkdir(parents=True)
    files = [kept / "records/A.csv", kept / "records/B.csv", kept / "figures/C.png"]
    for path in files:
        path.write_text(path.name)
    (own / "records/A.csv").write_text("older")
    os.link(files[1], own / "records/B.csv")
    (own / "tables").mkdir()
    named = ",".join(str(path.relative_to(tmp_path)) for path in files)
    script("link_shared", tmp_path, input={"files": named}, output="results/r/tables/s.csv")
    assert (own / "tables/s.csv").read_text().splitlines() == [
        "file,kept_in",
        *(f"{'/'.join(p.parts[-2:])},{p.relative_to(tmp_path).as_posix()}" for p in files),
    ]
    found = sorted(path for path in own.rglob("*.*") if path.parent.name != "tables")
    assert [path.name for path in found] == ["C.png", "A.csv", "B.csv"]
    assert all(a.samefile(b) for a, b in zip(found, [files[2], *files[:2]], strict=True))


def test_the_profile_of_a_portfolio_names_rules_and_limits_each_group_to_one_job_at_a_time():
    profile = yaml.safe_load((ROOT / "workflow/profiles/portfolio/config.yaml").read_text())
    text = "".join(path.read_text() for path in (ROOT / "workflow/rules").rglob("*.smk"))
    assert set(profile["groups"]) == set(profile["set-resources"])
    assert set(profile["groups"]) <= set(re.findall(r"(?m)^rule (\w+):", text))
    assert set(profile["groups"].values()) == set(profile["group-components"])
    local = re.search(r"localrules:\n((?:    \w+,\n)+)", text)[1]
    assert not set(profile["groups"]) & set(re.findall(r"\w+", local))
    assert {r["slot"] for r in profile["set-resources"].values()} == {profile["resources"]["slot"]}
    assert profile["set-resource-scopes"] == {"slot": "local"}


@pytest.mark.slow
def test_what_was_submitted_runs_its_jobs_itself(tmp_path):
    """As SLURM's plugin starts a group; it would start each job anew by srun, which fails here."""
    (tmp_path / "srun").write_text("#!/bin/sh\nexit 1\n")
    (tmp_path / "srun").chmod(0o755)
    wanted = [f"results/main/capacity_reduction/T{t}_below0/GMN_NS.csv" for t in (0.2, 0.3, 0.4)]
    command = [sys.executable, "-m", "snakemake", "--snakefile", str(ROOT / "workflow/Snakefile")]
    how = ("--executor", "slurm-jobstep", "--mode", "remote", "--jobs", "1", "--nolock")
    done = subprocess.run(
        [*command, *how, "--", *wanted],
        cwd=tmp_path,
        env={
            **os.environ,
            "PYTHONPATH": f"{ROOT}:{ROOT / 'workflow'}",
            "PATH": f"{tmp_path}:{os.environ['PATH']}",
        },
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr[-3000:]
    assert all((tmp_path / path).is_file() for path in wanted)
