"""Every command of the tutorial, README and configuration page is run, at least as a dry run."""

import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from forked import run

ROOT = Path(__file__).resolve().parents[2]
BIN = Path(sys.executable).parent
# the same commands on a small workload: two intensities, a coarse step, no perturbed runs
SMALL = """
ida: {mode: grid, grid_g: [0.05, 0.9]}
numerics: {step_fraction: 0.5, after_motion_s: 0}
ensemble: {enabled: "off"}
pushover: {nodes_thickness: 5, step_fraction: 0.4}
"""
BLOCK = re.compile(
    r"^(?P<indent> *)(?:<!-- (?P<mark>\w+) -->\n *)?```sh\n(?P<text>.*?)^ *```$", re.M | re.S
)


def blocks(name):
    """Shell blocks of a page as (mark, text); a mark is an HTML comment in the line before."""
    found = []
    for match in BLOCK.finditer((ROOT / name).read_text("utf-8")):
        lines = match["text"].splitlines()
        found.append((match["mark"], "\n".join(x.removeprefix(match["indent"]) for x in lines)))
    return found


def commands(name):
    """Single commands of a page's blocks, continued lines joined, comments dropped."""
    out = []
    for mark, text in blocks(name):
        if mark is None and name == "docs/tutorial.md":
            continue  # those are run as they are
        for line in text.replace("\\\n", " ").splitlines():
            words = shlex.split(line, comments=True)
            if words:
                out.append(words)
    return out


@pytest.fixture(scope="module")
def clone(tmp_path_factory):
    """The files that Git knows or would, as the set-up leaves them, and a small workload."""
    folder = tmp_path_factory.mktemp("clone") / "rocking-facades"
    listed = subprocess.run(
        ["git", "ls-files", "-zco", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        check=False,
    )
    if listed.returncode:
        pytest.skip("not a Git working tree")
    for name in filter(None, listed.stdout.decode().split("\0")):
        if (ROOT / name).is_file():  # not one that is deleted here and not yet in Git
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)  # with its time, which the compilers compare
    for compiled in ROOT.glob("workflow/**/*.nb[ci]"):
        target = folder / compiled.relative_to(ROOT)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(compiled, target)
    (folder / ".venv").symlink_to(BIN.parent)
    with open(folder / "config/config.yaml", "a") as handle:
        handle.write(SMALL)
    return folder


def shell(folder, text):
    return subprocess.run(
        ["bash", "-euo", "pipefail", "-c", text], cwd=folder, capture_output=True, text=True
    )


def typed(folder, text):
    """Give a block to the shell, but for a Snakemake at its end, which is forked."""
    before, command, words = f"\n{text}".rpartition("\n.venv/bin/snakemake ")
    done = shell(folder, before if command else text)
    return (
        run(folder, "snakemake", *shlex.split(words)) if command and not done.returncode else done
    )


@pytest.mark.yade
@pytest.mark.slow
def test_tutorial_leads_from_a_clone_to_a_report(clone):
    """All blocks in order, as a reader types them; installation apart, long ones as dry runs.

    Snakemake is started by the shell for the first curve, and where the shell asks how it ends.
    """
    marks = [mark for mark, _ in blocks("docs/tutorial.md")]
    assert marks.count("setup") == 1
    assert marks.index("setup") == 0
    for mark, text in blocks("docs/tutorial.md"):
        if mark == "setup":
            assert "make setup" in text
            continue
        if mark == "dry":
            command, *words = shlex.split(text)
            assert command == ".venv/bin/snakemake"
            done = run(clone, "snakemake", "-n", *words)
        elif "run=first" in text or "||" in text:
            done = shell(clone, text)
        else:
            done = typed(clone, text)
        assert done.returncode == 0, f"{text}\n{done.stdout[-1500:]}{done.stderr[-1500:]}"
        if "as it should be" in text:
            assert "did you mean 'facade.height_m'?" in done.stderr
            assert "refused, as it should be" in done.stdout
    results = clone / "results"
    for path in (
        "first/figures/fig09_ida.png",
        "my_facade/figures/fig09_ida.png",
        "my_record/figures/record_MINE.png",
        "my_record/figures/fig09_ida.png",
    ):
        assert (results / path).stat().st_size > 10_000, path
    assert "facade:\n  height_m: 5.2\n" in (results / "my_record/config.yaml").read_text()
    provenance = (results / "my_record/report/provenance.html").read_text()
    assert "my_record.txt" in provenance
    assert "sha256: " in provenance
    report = (clone / "my_report.html").read_text()
    for name in ("my_record/figures/fig09_ida.png", "my_record/report/provenance.html"):
        assert f"results/{name}" in report, name
    assert re.search(r"results/\.shared/\w+/figures/record_MINE\.png", report)  # runs share it


def test_install_is_a_target_of_make():
    pages = commands("README.md") + commands("docs/tutorial.md")
    made = [words for words in pages if words[0] == "make"]
    assert made
    for words in made:
        done = subprocess.run([*words, "-n"], cwd=ROOT, capture_output=True, text=True)
        assert done.returncode == 0, f"{words}: {done.stderr}"


def plans():
    """Snakemake command lines of the pages that need no results.

    Those of the same options are one, which asks for the targets of all.
    """
    found: dict = {}
    for name in ("README.md", "config/README.md", "docs/accuracy.md", "docs/gallery.md"):
        for program, *words in commands(name):
            if Path(program).name == "snakemake" and "--report" not in words:
                end = words.index("--") if "--" in words else len(words)
                targets = words[end + 1 :]
                found.setdefault((*words[:end], bool(targets)), []).extend(targets)
    return [
        [*options, "--", *dict.fromkeys(targets)] if targets else list(options)
        for (*options, _), targets in found.items()
    ]


PLANS = plans()


@pytest.mark.slow
@pytest.mark.parametrize("words", PLANS, ids=[shlex.join(words)[:60] for words in PLANS])
def test_commands_of_the_pages_plan_jobs(clone, words):
    """Each Snakemake command of the pages is accepted and finds its jobs."""
    (clone / "motion.txt").write_text("0.0\n0.1\n-0.2\n0.1\n0.0\n")
    (clone / "my_records.tsv").write_text(
        "record\tfile\tformat\tdt_s\tunits\nMINE\tmotion.txt\t\t0.01\tg\n"
    )
    for program, *files in commands("README.md"):
        if program == "cp":
            shutil.copy2(*(clone / name for name in files))
    other = clone / "results/engines/accuracy/engine_mujoco.csv"  # the line before it writes this
    other.parent.mkdir(parents=True, exist_ok=True)
    other.touch()
    done = run(clone, "snakemake", "-n", *words)
    assert done.returncode == 0, f"{shlex.join(words)}\n{done.stderr[-1500:]}"
    assert "Job stats" in done.stdout + done.stderr
