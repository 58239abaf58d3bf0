"""Targets of the workflow, read off its rule files, and their tables in docs/targets.md.

A target is a rule without output, which a user asks for by name. Its docstring says what it makes,
what that costs, and its page:

    Annual rate and 50-year probability of collapse, with a hazard curve.
    Costs: as `fragility`.
    Page: docs/risk.md

`snakemake --list-target-rules` prints it. A study's targets stand in its keys.md (`docs`), those of
the core in docs/targets.md, where a marker before each table names the targets that stand in it;
those that no marker names stand in the table of `the others`.
"""

import re
from dataclasses import dataclass
from pathlib import Path

from yade_scripts.lists import listed

ROOT = Path(__file__).resolve().parents[3]
PAGE = ROOT / "docs" / "targets.md"
RULE = re.compile(r'^rule (\w+):\n(?:    """([^"]*)"""\n)?((?:(?: {4}.*)?\n)*)', re.M)
DOCSTRING = re.compile(r"(.+?)\.? Costs: (.+?)\.?(?: Page: (\S+))?")
ANOTHER_NAME = re.compile(r"\s*(default_target: True\s*)?input:\s*rules\.\w+\.input,\s*")
TABLE = re.compile(r"(<!-- targets: ([^;]+);[^>]*-->\n).*?(<!-- end of targets -->)", re.S)
OTHERS = "the others"


@dataclass(frozen=True)
class Target:
    """A rule without output: what it makes, what that costs and its page; "" for none."""

    makes: str = ""
    costs: str = ""
    page: str = ""


def targets(root: Path = ROOT, study: str | None = "*") -> dict[str, Target]:
    """Targets of a checkout by name, sorted, without those that are another name of one.

    Those of the core and of all studies; with the name of a study its own, with None the core's. A
    docstring of another form than above leaves what it should say empty.
    """
    by_name = {}
    core = (root / "workflow" / "Snakefile", *root.glob("workflow/rules/**/*.smk"))
    studies = root.glob(f"workflow/studies/{study}/*.smk") if study else ()
    for path in (*(core if study in (None, "*") else ()), *studies):
        for name, docstring, body in RULE.findall(path.read_text("utf-8")):
            if re.search("^    output:", body, re.M) or ANOTHER_NAME.fullmatch(body):
                continue
            said = DOCSTRING.fullmatch(" ".join(docstring.split()))
            by_name[name] = Target(*(word or "" for word in said.groups()) if said else ())
    return dict(sorted(by_name.items()))


def render(page: str, root: Path = ROOT) -> str:
    """Text of docs/targets.md with its tables written anew.

    A ValueError where a target has no docstring of the form above or names a page that is not
    there, where a marker names no target, or where none stands for `the others`.
    """
    there = targets(root, None)
    kept = [names for _, names, _ in TABLE.findall(page)]
    if kept.count(OTHERS) != 1:
        raise ValueError(f"docs/targets.md: expected one marker 'targets: {OTHERS};'")
    named = [name for names in kept if names != OTHERS for name in names.split(", ")]

    def table(match: re.Match) -> str:
        rest = [name for name in there if name not in named]
        names = rest if match[2] == OTHERS else match[2].split(", ")
        rows = [_row(name, there, root) for name in names]
        return "\n".join(
            [match[1], "| target | what it makes | costs |", "|---|---|---|", *rows, "", match[3]]
        )

    return TABLE.sub(table, page)


def _row(name: str, there: dict[str, Target], root: Path) -> str:
    target = there.get(name)
    if target is None:
        raise ValueError(f"docs/targets.md: {name}: expected a target of {listed(there)}")
    if not target.makes:
        raise ValueError(f"rule {name}: expected a docstring: what it makes. Costs: … Page: docs/…")
    page = target.page
    if page and not (page.startswith("docs/") and (root / page).is_file()):
        raise ValueError(f"rule {name}: {page}: expected a page docs/….md")
    link = f" ([page]({page.removeprefix('docs/')}))" if page else ""
    return f"| `{name}` | {target.makes}{link} | {target.costs} |"
