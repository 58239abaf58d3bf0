"""The IDA of two records through a real SLURM, one job cancelled half way, against a local run.

    .venv/bin/python tests/trials/slurm/run_study.py

Starts a SLURM of one node (node.sh; installs Debian's slurm-wlm and munge if missing, needs root),
runs the study on it with the profile a user would take, cancels one IDA job while it computes, and
compares every table byte for byte (but for the column wall_s) with a run without SLURM. Everything
is in a temporary folder; the daemons are stopped at the end.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT))

from tests.trials.faults.workspace import Workspace, wait_until  # noqa: E402

HERE = Path(__file__).resolve().parent
# this SLURM keeps no accounts: ask the controller, and often, since the study is short
PROFILE = (
    "--workflow-profile",
    "profiles/slurm",
    "--slurm-status-command",
    "squeue",
    "--slurm-no-account",
    "--seconds-between-status-checks",
    "2",
    "--slurm-init-seconds-before-status-checks",
    "2",
    "--latency-wait",
    "10",
)


def say(text):
    print(text, flush=True)


def cancel_one_ida(space):
    """Cancel the first IDA job that has finished a run; return its SLURM id and the rows kept."""

    def running():
        out = subprocess.run(
            ["squeue", "-h", "-t", "R", "-o", "%i %k"], capture_output=True, text=True, check=True
        ).stdout
        ids = [line.split()[0] for line in out.splitlines() if "rule_ida" in line]
        return ids if space.journal() else []

    found = wait_until(running, 300, 0.3)
    if not found:
        sys.exit("no IDA job was seen running in SLURM")
    rows = space.journal()
    subprocess.run(["scancel", found[0]], check=True)
    return found[0], rows


def main():
    """Run the trial; return 0 if everything held."""
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    top = Path(tempfile.mkdtemp(prefix="rocking-slurm-"))
    node = top / "node"
    say(f"working in {top}")
    subprocess.run([str(HERE / "node.sh"), "up", str(node)], check=True)
    try:
        remote = Workspace(top / "slurm").fill(HERE / "study.yaml")
        process = remote.start(*PROFILE)
        job, kept = cancel_one_ida(remote)
        say(f"cancelled SLURM job {job} with {len(kept)} runs finished in all")
        status = process.wait()
        text = remote.output()
        local = Workspace(top / "local").fill(HERE / "study.yaml")
        local_status, _ = local.run()
        rows = remote.journal()
        checks = {
            "study through SLURM completed": status == 0,
            "local study completed": local_status == 0,
            "cancelled job noticed and submitted again": "Trying to restart job" in text,
            "runs finished before were not repeated": all(rows.get(k) == kept[k] for k in kept),
            "IDA jobs went through SLURM": text.count("has been submitted with SLURM jobid") >= 5,
            "same results": status == 0 and remote.digests() == local.digests(),
        }
    finally:
        subprocess.run([str(HERE / "node.sh"), "down", str(node)], check=True)
    for name, held in checks.items():
        say(f"{'ok  ' if held else 'FAIL'} {name}")
    if not all(checks.values()):
        say(text[-3000:])
        return 1
    say(f"{len(remote.digests())} files equal")
    return 0


if __name__ == "__main__":
    sys.exit(main())
