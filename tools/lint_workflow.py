"""Snakemake's own linter, failing on everything but two pieces of advice answered otherwise here.

The linter wants a conda environment or container a rule. Here one lock file with
hashes and Debian's YADE package serve every rule alike; a second description of
the same environment would only drift. It wants functions in a file apart from rules. Here a
target is one file: the few lines that choose its inputs stand beside the rules that take them,
and `common.smk` and `paths.smk` hold what several files use.
"""

import re
import subprocess
import sys
from pathlib import Path

ANSWERED = (
    "Specify a conda environment or container for each rule.",
    "Mixed rules and functions in same snakefile.",
)


def remarks():
    """Yield the linter's remarks as (place, title)."""
    snakemake = str(Path(sys.executable).with_name("snakemake"))
    done = subprocess.run([snakemake, "--lint"], capture_output=True, text=True)
    text = done.stdout + done.stderr
    place = None
    for line in text.splitlines():
        if head := re.match(r"Lints for (.*):$", line):
            place = head[1]
        elif remark := re.match(r"    \* (.*):$", line):
            yield place, remark[1]
    if place is None and "Congratulations" not in text:
        yield "snakemake --lint", text.strip()[-500:]


def main():
    """Print what is left; return the exit status."""
    left = [f"{place}: {title}" for place, title in remarks() if title not in ANSWERED]
    print("\n".join(left) or "snakemake --lint: nothing left")
    return bool(left)


if __name__ == "__main__":
    sys.exit(main())
