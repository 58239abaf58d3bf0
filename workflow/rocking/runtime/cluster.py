"""Whether the cluster that jobs are to go to is there, asked before any is submitted."""

import shutil
import sys

SUBMITS = {"slurm": "sbatch"}  # by the name of Snakemake's executor


def fault(executor, which=shutil.which):
    """Say in one line what an executor (`--executor`) lacks on this machine; empty: nothing."""
    program = SUBMITS.get(executor)
    if program is None or which(program):
        return ""
    return (
        f"no SLURM on this machine ({program} is not on the path): start where jobs can be"
        " submitted, or leave profiles/slurm out to compute here"
    )


def warning(executor, words=None, which=shutil.which):
    """Say in one line what Snakemake will ask of this SLURM in vain; empty where it has it.

    `words` are the command line, unless given this process's.
    """
    words = sys.argv if words is None else words
    if executor != "slurm" or which("sacct") or "--slurm-no-account" in words:
        return ""
    return (
        "this SLURM keeps no accounts (sacct is not on the path): add --slurm-no-account"
        " --slurm-status-command squeue"
    )
