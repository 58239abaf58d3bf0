"""Faults: each disturbs one run of the study in a workspace and says what it did.

A fault is a function of (space, rng, seconds): a workspace ready to run, a seeded random
generator, and how long an undisturbed run takes. It starts the study itself, breaks
something at a random moment, waits until that run is over, and returns a short text.
"""

import os
import random
import re
import resource
import shutil
import signal
import subprocess
import time

from .workspace import LOCKS, PARTS, RESULTS, ROOT, STUDY, wait_until

PATIENCE_S = 900.0  # longest wait for a disturbed run


def _moment(process, rng, seconds):
    """Wait for a random moment of a run; return it [s]."""
    moment = rng.uniform(0.0, 0.85 * seconds)
    end = time.monotonic() + moment
    while time.monotonic() < end and process.poll() is None:
        time.sleep(0.02)
    return moment


def _ended(process):
    status = process.wait(PATIENCE_S)
    return f"exit {status}"


def _kill_run(number, whole_group):
    def fault(space, rng, seconds):
        process = space.start()
        moment = _moment(process, rng, seconds)
        if process.poll() is None:
            (os.killpg if whole_group else os.kill)(process.pid, number)
        return f"at {moment:.1f} s, {_ended(process)}"

    return fault


def _kill_job(number, word):
    def fault(space, rng, seconds):
        process = space.start()
        wait = rng.uniform(0.0, 4.0)
        jobs = wait_until(lambda: space.jobs(word) or process.poll() is not None, PATIENCE_S)
        time.sleep(wait)
        jobs = space.jobs(word)
        victim = rng.choice(sorted(jobs)) if jobs else None
        if victim:
            try:
                os.kill(victim, number)
            except ProcessLookupError:
                victim = None
        what = f"{wait:.1f} s after it started" if victim else "had ended by itself"
        return f"{what}, {_ended(process)}"

    return fault


def _first_error(space):
    lines = [line.strip() for line in space.output().splitlines()]
    said = [line for line in lines if line.startswith("error:") or "No space" in line]
    return (said or [""])[0][:100]


def _one_line(space, status):
    """First error of a run without room; it names what was to be written, and no line of code."""
    said = _first_error(space)
    assert not status or re.search(r"/|disk", said), f"exit {status} without a word of the file"
    assert "Traceback (most recent" not in space.output(), "a traceback beside the line"
    return said


def full_disk(space, rng, seconds):
    """The whole workspace on a disk that fills up; room is made afterwards."""
    room = round(10.0 ** rng.uniform(0.9, 3.3))  # kB; the study needs some more
    kept = space.folder.with_name(space.folder.name + "-kept")
    space.folder.rename(kept)
    space.folder.mkdir()
    subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=64m,mode=755", "tmpfs", str(space.folder)], check=True
    )
    space.mounts.append(space.folder)
    subprocess.run(["cp", "-a", f"{kept}/.", str(space.folder)], check=True)
    shutil.rmtree(kept)
    ballast = space.folder / "ballast"
    ballast.write_bytes(bytes(shutil.disk_usage(space.folder).free - room * 1024))
    status = space.start().wait(PATIENCE_S)
    ballast.unlink()
    return f"{room} kB left, exit {status}, {_one_line(space, status)}"


def deleted_files(space, rng, seconds):
    """Results deleted, with or without what runs share, then asked for by name."""
    status = space.start().wait(PATIENCE_S)
    assert not status, f"the undisturbed run ended with {status}"
    top, with_shared = space.folder / RESULTS, rng.random() < 0.5
    made = [path for path in space.digests() if path != "config.yaml"]
    gone = rng.sample(sorted(made), rng.randint(1, 5))
    for name in gone:
        (top / name).unlink()
    if with_shared:
        shutil.rmtree(top.parent / ".shared")
    status = space.start(targets=gone).wait(PATIENCE_S)
    missing = [name for name in gone if not (top / name).exists()]
    assert not status, f"exit {status}, {_first_error(space)}"
    assert not missing, f"not made again: {missing}"
    return f"{', '.join(gone)}{' and all that runs share' * with_shared}"


def file_limit(space, rng, seconds):
    """No file may grow beyond a limit, as with a quota."""
    limit = rng.choice([0, 200, 1_000, 3_000, 20_000, 200_000, 800_000])

    def restrict():
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    status = space.start(preexec_fn=restrict).wait(PATIENCE_S)
    return f"files up to {limit} B, exit {status}, {_first_error(space)}"


def read_only(space, rng, seconds):
    """The results become read-only at a random moment, and writable again afterwards."""
    top = space.folder / RESULTS
    top.mkdir(parents=True, exist_ok=True)
    moment = rng.choice([0.0, rng.uniform(0.0, seconds)])
    process = space.start() if moment else None
    time.sleep(moment)
    if os.geteuid() == 0:  # permissions do not stop root; a mount does
        subprocess.run(["mount", "--bind", str(top), str(top)], check=True)
        space.mounts.append(top)
        subprocess.run(["mount", "-o", "remount,ro,bind", str(top)], check=True)
    else:
        subprocess.run(["chmod", "-R", "a-w", str(top)], check=True)
    status = (process or space.start()).wait(PATIENCE_S)
    if os.geteuid() == 0:
        space.unmount()
    else:
        subprocess.run(["chmod", "-R", "u+w", str(top)], check=True)
    return f"from {moment:.1f} s, exit {status}, {_first_error(space)}"


def two_at_once(space, rng, seconds):
    """The same command twice in the same folder."""
    first = space.start()
    wait = rng.choice([0.0, rng.uniform(0.0, seconds)])
    time.sleep(wait)
    second = space.start(log="second.log")
    statuses = sorted([first.wait(PATIENCE_S), second.wait(PATIENCE_S)])
    refused = any("another run works in" in space.output(log) for log in ("run.log", "second.log"))
    assert statuses[0] == 0, f"neither of two runs completed: exits {statuses}"
    assert refused or statuses == [0, 0], f"exits {statuses} without a word why"
    return f"second {wait:.1f} s later, {'refused in one line' if refused else 'both completed'}"


def clock(space, rng, seconds):
    """Half of the run under one clock; the files' times then moved, past and future."""
    shift = rng.choice(["-400d", "-1d", "-2h", "+2h", "+1d"])
    process = space.start(prefix=("faketime", "-f", shift) if shutil.which("faketime") else ())
    moment = _moment(process, rng, seconds)
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
    process.wait(PATIENCE_S)
    files = [p for p in sorted((space.folder / RESULTS).rglob("*")) if p.is_file()]
    for path in rng.sample(files, len(files) // 2):
        when = time.time() + rng.uniform(-1e6, 1e6)
        os.utime(path, (when, when))
    return f"clock {shift} until {moment:.1f} s, times of {len(files) // 2} files moved"


def torn_journal(space, rng, seconds):
    """A killed run whose journals end in the middle of a line, with old temporary files."""
    process = space.start()
    wait_until(lambda: space.journal() or process.poll() is not None, PATIENCE_S)
    time.sleep(rng.uniform(0.0, 3.0))
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
    process.wait(PATIENCE_S)
    wait_until(lambda: not space.processes(), 20.0)
    cut = 0
    for path in (space.folder / RESULTS / "cache").rglob("*.jsonl"):
        size = rng.randint(0, path.stat().st_size)
        os.truncate(path, size)
        with open(path, "ab") as handle:
            handle.write(rng.randbytes(rng.choice([0, 7, 300])))
        cut += 1
    for folder in ("ida/W1", "ida/W2"):
        table = space.folder / RESULTS / folder / "BUCAR0_neg.csv"
        if not table.exists():  # a finished table has cleared such files away
            table.parent.mkdir(parents=True, exist_ok=True)
            table.with_name(f".{table.name}.1.part").write_text("model,rec")
    return f"{cut} journals cut at a random byte"


def _whole(space):
    """The study done, so that what it made can be damaged."""
    status = space.start().wait(PATIENCE_S)
    assert not status, f"the undisturbed run ended with {status}, {_first_error(space)}"


def _in_place(path, data, rng):
    """Other bytes in the same file, dated as it was or earlier."""
    at = path.stat()
    with open(path, "r+b") as handle:
        handle.write(data)
        handle.truncate()
    earlier_s = rng.choice([0.0, 86400.0])
    os.utime(path, (at.st_atime, at.st_mtime - earlier_s))


def cut_at_a_line_end(space, rng, seconds):
    """A table or a motion cut where a line ends: what is left reads as whole."""
    _whole(space)
    found = [p for p in space.made() if p.suffix in (".csv", ".jsonl")]
    path = rng.choice([p for p in found if p.read_bytes().count(b"\n") > 1])
    lines = path.read_bytes().splitlines(keepends=True)
    left = rng.randint(1, len(lines) - 1)
    _in_place(path, b"".join(lines[:left]), rng)
    return f"{path.relative_to(space.folder)}: {left} of {len(lines)} lines left"


def changed_byte(space, rng, seconds):
    """One digit, or any byte, of one file of the results changed in place."""
    _whole(space)
    path = rng.choice(space.made())
    data = bytearray(path.read_bytes())
    digits = [k for k, byte in enumerate(data) if byte in b"0123456789"]
    place = rng.choice(digits) if digits and rng.random() < 0.7 else rng.randrange(len(data))
    before = data[place]
    others = b"0123456789" if before in b"0123456789" else bytes(range(256))
    data[place] = rng.choice([byte for byte in others if byte != before])
    _in_place(path, bytes(data), rng)
    return f"{path.relative_to(space.folder)}: byte {place} is {data[place]} for {before}"


def missing_notes(space, rng, seconds):
    """Results of other settings whose `.snakemake` is gone; now and then killed half way."""
    study = space.folder / STUDY
    ours = study.read_text()
    other = rng.choice(["facade: {height_m: 5.0}", "smdof: {period_s: 0.4}", "seed: 3", ""])
    study.write_text(f"{ours}{other}\n")
    process = space.start()
    if rng.random() < 0.5:
        _moment(process, rng, seconds)
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
    ended = _ended(process)
    wait_until(lambda: not space.processes(), 20.0)
    study.write_text(ours)
    shutil.rmtree(space.folder / ".snakemake", ignore_errors=True)
    return f"made with {other or 'the same settings'}, {ended}, then without .snakemake"


def older_record(space, rng, seconds):
    """What a record is made of, replaced by a file of an older date."""
    path = space.folder / "config" / "surrogates.yaml"
    ours, at = path.read_text(), path.stat()
    other = ours.replace("rms_m_s2: 0.35, frequency_hz: 1.8", "rms_m_s2: 0.40, frequency_hz: 1.8")
    assert other != ours, "BUCAR0 has another noise in surrogates.yaml"
    path.write_text(other)
    _whole(space)
    path.write_text(ours)
    older_s = rng.choice([0.0, 3600.0, 4e7])
    os.utime(path, (at.st_atime, at.st_mtime - older_s))
    return f"surrogates.yaml with other noise, then as it was, {older_s:.0f} s older"


def interrupted_install(space, rng, seconds):
    """The installation killed at a random moment, then given again."""
    folder = space.folder.with_name("install")
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "tools").mkdir(parents=True)
    shutil.copy2(ROOT / "tools" / "setup.sh", folder / "tools")
    for name in (*LOCKS, "pyproject.toml", "setup.py", "README.md"):
        shutil.copy2(ROOT / name, folder)
    for part in PARTS:  # with what was compiled: to compile is not what is tried here
        shutil.copytree(ROOT / part, folder / part)
    command = ["bash", "tools/setup.sh"]
    process = subprocess.Popen(command, cwd=folder, start_new_session=True)
    moment = rng.uniform(0.0, 30.0)
    try:
        process.wait(moment)
    except subprocess.TimeoutExpired:
        (os.killpg if rng.random() < 0.5 else os.kill)(process.pid, signal.SIGKILL)
        process.wait()
    subprocess.run(command, cwd=folder, check=True)
    python = str(folder / ".venv" / "bin" / "python")
    imports = "import snakemake, scipy, pandas, matplotlib, pytest, hypothesis"
    subprocess.run([python, "-c", imports], check=True)
    subprocess.run([python, "-m", "pip", "check", "-q"], check=True, stdout=subprocess.DEVNULL)
    found = _packages(python)
    always, sometimes = _locked(folder / LOCKS[1])
    assert always <= found, f"packages missing: {always - found}"
    assert found <= always | sometimes, f"packages not locked: {found - always - sometimes}"
    shutil.rmtree(folder)
    return f"killed after {moment:.1f} s, then {len(found)} packages as locked"


def _packages(python):
    # all: else pip leaves out what it may need itself, though the lock file has it
    how = ("--all", "--exclude", "pip", "--exclude-editable", "--disable-pip-version-check")
    command = [python, "-m", "pip", "freeze", *how]
    listed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return {_plain(line) for line in listed.split()}


def _locked(path):
    """Packages of a lock file: those for every machine, and those under a condition."""
    lines = re.findall(r"^([\w.-]+==[\w.+!-]+)( *;)?", path.read_text(), re.M)
    return tuple(
        {_plain(name) for name, mark in lines if bool(mark) == wanted} for wanted in (False, True)
    )


def _plain(requirement):
    """Name and version, the name spelt as packages may not."""
    name, _, version = requirement.partition("==")
    return f"{re.sub('[-_.]+', '-', name).lower()}=={version}"


FAULTS = {
    "SIGKILL run": _kill_run(signal.SIGKILL, False),
    "SIGKILL run and jobs": _kill_run(signal.SIGKILL, True),
    "SIGTERM run": _kill_run(signal.SIGTERM, False),
    "SIGTERM run and jobs": _kill_run(signal.SIGTERM, True),
    "SIGINT run and jobs": _kill_run(signal.SIGINT, True),
    "SIGKILL one YADE": _kill_job(signal.SIGKILL, "yade_scripts ida"),
    "SIGTERM one YADE": _kill_job(signal.SIGTERM, "yade_scripts ida"),
    "SIGKILL one script": _kill_job(signal.SIGKILL, ".snakemake/scripts"),
    "full disk": full_disk,
    "file size limit": file_limit,
    "deleted files": deleted_files,
    "read-only results": read_only,
    "two runs at once": two_at_once,
    "clock change": clock,
    "torn journal": torn_journal,
    "interrupted install": interrupted_install,
    "cut at a line end": cut_at_a_line_end,
    "changed byte": changed_byte,
    "missing .snakemake": missing_notes,
    "older-dated record": older_record,
}
NEEDS_MOUNT = ("full disk",)
TAKES_ROWS = ("torn journal", "cut at a line end", "changed byte")  # out of journals


def available():
    """Names of the faults that this user can inject."""
    return [name for name in FAULTS if name not in NEEDS_MOUNT or os.geteuid() == 0]


def generator(seed, trial):
    """Random generator of one trial."""
    return random.Random(f"{seed}-{trial}")
