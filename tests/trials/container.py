"""The steps of containers/Containerfile in an empty Debian 12, where no base image can be had.

    python tests/trials/container.py --folder /var/tmp/image [--share /etc/pip.conf …]

Root, with debootstrap (Debian's package). The root folder stands for the base image, the files of
this revision for what COPY brings; RUN's words are read from the file and run there. Then
ENTRYPOINT runs one curve as a user without rights, the image read-only and nothing but the working
folder writable, as `podman run --read-only` would. What this does not try is said at its end.
"""

import argparse
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FILE = ROOT / "containers" / "Containerfile"
PROJECT = "opt/rocking-facades"
USER = "65534:65534"  # nobody: Snakemake asks for a name
CURVE = ["records=GMN_NS", "directions=neg", "models=W1", "run=try"]
MADE = ("results/try/tables/ida_collapse.csv", "results/try/figures/fig09_ida.png")
UNTRIED = "Not tried: the base image, and how podman and Apptainer read their files."
LIMIT_S = 3600


def instructions(text):
    """Instructions of a Containerfile by name, continued lines joined."""
    joined = re.sub(r"\\\n", " ", re.sub(r"^\s*#.*\n", "", text, flags=re.M))
    found = [line.partition(" ") for line in joined.splitlines() if line.strip()]
    return {name: words.strip() for name, _, words in found}


def inside(root, words, *, user=None, read_only=False, room=None):
    """Run a shell's words in the root folder, in a namespace of its own."""
    steps = ["set -e", f"mount --bind {root} {root}"]
    steps += [f"mount -t proc proc {root}/proc", f"mount --rbind /dev {root}/dev"]
    if room:
        steps.append(f"mount --bind {room} {root}/work")
    if read_only:
        steps += [f"mount -o remount,bind,ro {root}", f"mount -t tmpfs tmpfs {root}/tmp"]
        steps.append(f"chmod 1777 {root}/tmp")
    change = f"--userspec={user} " if user else ""
    clean = '/usr/bin/env -i PATH="$PATH" LANG=C.UTF-8 HOME=/tmp'
    steps.append(f'exec chroot {change}{root} {clean} bash -c "$0"')
    command = ["unshare", "--mount", "bash", "-c", "\n".join(steps), words]
    return subprocess.run(command, timeout=LIMIT_S, check=False).returncode


def base(root, mirror):
    """An empty Debian, and the network's settings of this machine."""
    given = [mirror] if mirror else []
    subprocess.run(["debootstrap", "--variant=minbase", "bookworm", root, *given], check=True)
    shutil.copy("/etc/resolv.conf", root / "etc" / "resolv.conf")
    (root / "work").mkdir()


def copied(root):
    """What COPY brings: the files of this revision."""
    target = root / PROJECT
    target.mkdir(parents=True)
    archive = subprocess.run(
        ["git", "-C", ROOT, "archive", "HEAD"], check=True, capture_output=True, timeout=60
    )
    subprocess.run(["tar", "-x", "-C", target], input=archive.stdout, check=True, timeout=60)


def main():
    """Build and run; the exit status is 1 where a step failed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--folder", type=Path, required=True, help="where image and results stand")
    parser.add_argument("--mirror", help="of Debian's packages; debootstrap's own by default")
    shared = "files and folders of this machine that its network asks for"
    parser.add_argument("--share", nargs="*", type=Path, default=[], help=shared)
    given = parser.parse_args()
    root, room = given.folder / "root", given.folder / "work"
    if not root.exists():
        root.mkdir(parents=True)
        base(root, given.mirror)
    for path in given.share:
        target = root / path.relative_to("/")
        target.parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if path.is_dir() else shutil.copy)(path, target)
    about = instructions(FILE.read_text("utf-8"))
    if not (root / PROJECT).exists():
        copied(root)
    if not (root / PROJECT / ".venv" / ".installed").exists() and inside(root, about["RUN"]):
        return "RUN failed: give the same command again, which goes on"
    shutil.rmtree(room, ignore_errors=True)
    room.mkdir()
    subprocess.run(["chown", USER, room], check=True)
    entry = " ".join(re.findall(r'"([^"]+)"', about["ENTRYPOINT"]))
    curve = f"cd {about['WORKDIR']} && {entry} --cores 1 --config {' '.join(CURVE)}"
    if inside(root, curve, user=USER, read_only=True, room=room):
        return "ENTRYPOINT failed"
    missing = [name for name in MADE if not (room / name).is_file()]
    if missing:
        return f"not made: {', '.join(missing)}"
    print(f"built, and one curve run read-only by {USER}\n{UNTRIED}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
