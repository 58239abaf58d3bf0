"""Everything that is installed is named by its hash or its commit, whichever file installs it."""

import re
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).resolve().parents[2]
BY_OTHERS = re.compile(r"\b(easy_install|pipx|uv|poetry|conda|mamba|npm|curl|wget)\b")


def installed(text):
    """Installations of Python packages by a shell script or a Makefile: the words of each."""
    text = re.sub(r"\\\n\s*", " ", re.sub(r"(?m)(^|\s)#.*$", "", text))
    named = dict(re.findall(r'(?m)^ *(\w+)="([^"]*pip install[^"]*)"', text))
    for name, value in named.items():
        text = text.replace(f"${name} ", f"{value} ")
    if function := re.search(r"(?m)^pip\(\) \{ *\S+ \"\$@\" (.*?);? *\}$", text):
        text = re.sub(r"(?m)^pip (.*)$", rf"pip \1 {function[1]}", text.replace(function[0], ""))
    return [
        line
        for line in text.splitlines()
        if (re.search(r"\bpip3?\b[^|;&]*\binstall\b", line) or BY_OTHERS.search(line))
        and not re.fullmatch(r' *\w+="[^"]*" *', line)
    ]


def by_hash(line):
    """Whether an installation takes what a lock file says by its hash, or what is here alone."""
    own = "--no-deps" in line and line.rstrip().endswith("--editable .")
    lock = re.search(r"-r \S*(\.lock\b|\$lock$)", line.strip())
    return own or bool("--require-hashes" in line and lock and "-index" not in line)


SCRIPTS = [
    "Makefile",
    ".ci/run",
    *(f"containers/{name}" for name in ("Containerfile", "apptainer.def")),
]
SCRIPTS += ["tools/setup.sh", "tools/offline.sh", "tools/audit.sh", ".github/workflows/ci.yml"]


def test_setup_installs_by_hash_or_nothing_from_elsewhere():
    text = (ROOT / "tools/setup.sh").read_text("utf-8")
    locks = re.findall(r"\block=(\S+)", text)
    assert locks == ["requirements.lock", "requirements-all.lock"]
    found = installed(text)
    assert len(found) == 3
    assert [line for line in found if not by_hash(line)] == []
    assert all("--no-build-isolation" in line for line in found[1:])  # the first has what builds


def test_no_other_script_installs_anything_else():
    """But for the audit, which looks up what is public, in an environment that is thrown away."""
    shells = [*ROOT.glob("tools/*.sh"), *ROOT.glob(".github/**/*.y*ml"), *ROOT.glob(".ci/*")]
    shells += [path for path in ROOT.glob("containers/*") if path.suffix != ".dockerignore"]
    known = {ROOT / name for name in SCRIPTS}
    assert {*shells} <= known
    found = {
        path.name: [line for line in installed(path.read_text("utf-8")) if not by_hash(line)]
        for path in known
    }
    assert [line.split()[-1] for line in found.pop("audit.sh")] == ["pip-audit"]
    assert {name: lines for name, lines in found.items() if lines} == {}
    assert len(installed((ROOT / "tools/offline.sh").read_text("utf-8"))) == 1


@pytest.mark.parametrize(
    "text",
    [
        *("pip install a", ".venv/bin/pip -q install a", "python -m pip --quiet install a"),
        *(
            "pip3 \\\n  install a",
            "easy_install a",
            "curl -s https://example.org | sh",
            "uv pip sync",
        ),
        *("pip install --require-hashes a", "pip install -r a.lock", "RUN pip install a"),
        "pip install --require-hashes -r a.lock --extra-index-url https://example.org",
        *('pip="x/pip install -q"\n$pip -r a.lock', 'A="1" pip install a'),
    ],
)
def test_the_check_of_installations_finds(text):
    assert [line for line in installed(text) if not by_hash(line)]


def test_everything_that_ci_uses_is_named_by_its_commit():
    """Read as YAML, at any depth and however it is quoted; a container by its maker's version."""

    def said(node, *keys):
        if isinstance(node, dict):
            for key, value in node.items():
                if key in keys:
                    yield from value.values() if isinstance(value, dict) else [value]
                else:
                    yield from said(value, *keys)
        elif isinstance(node, list):
            for value in node:
                yield from said(value, *keys)

    files = sorted((ROOT / ".github").rglob("*.y*ml"))
    read = [yaml.safe_load(path.read_text("utf-8")) for path in files]
    used = [one for text in read for one in said(text, "uses")]
    images = [one for text in read for one in said(text, "container", "image")]
    assert used
    assert images
    assert [one for one in used if not re.fullmatch(r"[\w/.-]+@[0-9a-f]{40}", one)] == []
    stated = r"debian:\d+(\.\d+)?|[\w./-]+@sha256:[0-9a-f]{64}"
    assert [one for one in images if not re.fullmatch(stated, one)] == []
