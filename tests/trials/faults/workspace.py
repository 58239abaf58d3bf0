"""A copy of the workflow to break, how to run it, and what its results must equal."""

import csv
import hashlib
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
SNAKEMAKE = Path(sys.executable).parent / "snakemake"
LOCKS = ("requirements.lock", "requirements-all.lock")
PARTS = ("profiles", "workflow", "yade_scripts", "smdof", "config")
STUDY = "study.yaml"  # in the workspace, a copy of the one given to `fill`
OVERVIEW = ("tables/ida_collapse.csv", "tables/records.csv")
FIGURES = (
    *OVERVIEW,
    "tables/shared.csv",
    "figures/fig09_ida.png",
    "figures/record_BUCAR0.png",
)
RESULTS = "results/trial"
NOT_COMPARED = "wall_s"  # the one column that is a measurement of this run, not of the façade


class Workspace:
    """A folder of its own with the workflow in it."""

    def __init__(self, folder):
        """Name the folder; `fill` or `copy_of` puts the workflow there."""
        self.folder = Path(folder)
        self.mounts = []  # mounted by a fault, newest last

    def unmount(self):
        """Undo the mounts of a fault."""
        while self.mounts:
            subprocess.run(["umount", "-l", str(self.mounts.pop())], check=True)

    def fill(self, study=ROOT / "tests" / "trials" / "faults" / "study.yaml"):
        """Copy a study and the files of the workflow that it needs; return the workspace.

        What was compiled is copied as well, and half-written files of the compilers are not.
        """
        self.folder.mkdir(parents=True, exist_ok=True)
        shutil.copy2(study, self.folder / STUDY)
        skip = shutil.ignore_patterns(".*", "*.tmp.*", "*.pyc.*")
        for part in PARTS:
            source, target = ROOT / part, self.folder / part
            target.parent.mkdir(parents=True, exist_ok=True)
            if source.is_dir():
                shutil.copytree(source, target, ignore=skip, dirs_exist_ok=True)
            else:
                shutil.copy2(source, target)
        return self

    def copy_of(self, other):
        """Become a copy of another workspace, times of files included; return the workspace."""
        self.folder.mkdir(parents=True, exist_ok=True)
        subprocess.run(["cp", "-a", f"{other.folder}/.", str(self.folder)], check=True)
        return self

    def command(self, *more, targets=OVERVIEW, cores=2):
        """Command line of the study; the same before and after a fault."""
        files = [f"{RESULTS}/{name}" for name in targets]
        more = more if "--cores" in more else ("--cores", str(cores), *more)
        return [str(SNAKEMAKE), *files, "--configfile", STUDY, *more]

    def start(self, *more, prefix=(), log="run.log", **options):
        """Start the study in a session of its own; return the process."""
        targets, extra = options.pop("targets", OVERVIEW), options.pop("extra", {})
        with open(self.folder.parent / f"{self.folder.name}-{log}", "w") as handle:
            return subprocess.Popen(
                [*prefix, *self.command(*more, targets=targets)],
                cwd=self.folder,
                stdout=handle,
                stderr=subprocess.STDOUT,
                start_new_session=True,
                env=environment(self.folder) | extra,
                **options,
            )

    def run(self, *more, log="run.log", **options):
        """Run the study; return its exit status and what it printed."""
        status = self.start(*more, log=log, **options).wait()
        return status, self.output(log)

    def output(self, log="run.log"):
        """What a run printed."""
        return (self.folder.parent / f"{self.folder.name}-{log}").read_text(errors="replace")

    def processes(self):
        """Processes that work in this folder: {pid: command line}."""
        found = {}
        for entry in Path("/proc").iterdir():
            if not entry.name.isdigit() or int(entry.name) == os.getpid():
                continue
            try:
                here = Path(os.readlink(entry / "cwd")) == self.folder
                if here and " Z " not in (entry / "stat").read_text().rpartition(")")[2][:3]:
                    found[int(entry.name)] = (
                        (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode()
                    )
            except OSError:
                continue
        return found

    def jobs(self, word="yade_scripts ida"):
        """Python processes of jobs whose command line has `word`."""
        return [
            pid
            for pid, line in self.processes().items()
            if word in line and Path(line.split()[0]).name.startswith("python")
        ]

    def journal(self):
        """Complete rows of all journals, by key."""
        rows = {}
        for path in sorted((self.folder / RESULTS / "cache").rglob("*.jsonl")):
            for line in path.read_text(errors="replace").splitlines():
                try:
                    entry = json.loads(line)
                    rows[entry["key"]] = entry["row"]
                except (ValueError, KeyError, TypeError):
                    continue
        return rows

    def made(self):
        """Files that hold results, of this run and of those that runs share, in order."""
        top = self.folder / RESULTS
        kept = (".csv", ".json", ".jsonl", ".png")
        files = [p for folder in (top, top.parent / ".shared") for p in sorted(folder.rglob("*"))]
        return [p for p in files if p.suffix in kept and p.stat().st_size]

    def digests(self):
        """Digest of every table, record, scene and PNG of the results, by path."""
        top = self.folder / RESULTS
        out = {}
        for path in sorted(top.rglob("*")):
            name = str(path.relative_to(top))
            if path.suffix in (".csv", ".json", ".png", ".yaml") and not name.startswith("."):
                out[name] = hashlib.sha256(comparable(path)).hexdigest()
        return out

    def leftovers(self):
        """Temporary files among the results."""
        top = self.folder / RESULTS
        return [str(p.relative_to(top)) for p in top.rglob(".*") if p.is_file()] + [
            str(p.relative_to(top)) for p in top.rglob("*.tmp")
        ]


def environment(folder=ROOT):
    """Environment of a run of the workflow in `folder`.

    Its packages come from there and not from where the virtual environment points to; settings
    of a run that this one may be part of are left out.
    """
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("ROCKING_", "SNAKEMAKE"))}
    return kept | {"PYTHONPATH": f"{folder}:{folder}/workflow"}


def comparable(path):
    """Bytes of a result, less the column that holds wall times."""
    data = Path(path).read_bytes()
    if Path(path).suffix != ".csv" or NOT_COMPARED.encode() not in data.partition(b"\n")[0]:
        return data
    rows = list(csv.reader(data.decode().splitlines()))
    drop = rows[0].index(NOT_COMPARED)
    return "\n".join(",".join(r[:drop] + r[drop + 1 :]) for r in rows).encode()


def wait_until(condition, seconds, interval=0.02):
    """Wait until `condition()` is true; return its value, false when time is up."""
    end = time.monotonic() + seconds
    while not (value := condition()) and time.monotonic() < end:
        time.sleep(interval)
    return value
