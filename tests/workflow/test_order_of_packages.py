"""The floors of the house: no package stands on one that stands on it, and no file on itself."""

import ast
from collections import defaultdict
from pathlib import Path

TOP = Path(__file__).resolve().parents[2] / "workflow"
APART = {"scripts", "tests", "trials"}  # of a study: run, and imported by nobody
MODULES = {
    ".".join(path.relative_to(TOP).with_suffix("").parts).removesuffix(".__init__"): path
    for package in ("rocking", "studies")
    for path in (TOP / package).rglob("*.py")
    if not APART & {*path.parts} and not path.name.startswith("test_")
}


def imported(name):
    """Modules of the package that one imports, also within its functions."""
    path = MODULES[name]
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in MODULES)
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[: len(package.split(".")) - node.level + 1]
            base = ".".join([*(above if node.level else []), *filter(None, [node.module])])
            for alias in node.names:
                one = f"{base}.{alias.name}"
                found = one if one in MODULES else base
                if found in MODULES and found != name:
                    yield found


STANDS_ON = {name: set(imported(name)) for name in MODULES}


def test_no_pair_of_packages_points_both_ways():
    on = defaultdict(set)
    for name, others in STANDS_ON.items():
        for other in others:
            mine, theirs = (one.split(".")[:-1][:2] for one in (name, other))
            if mine != theirs and len(mine) == len(theirs) == 2:
                on[tuple(mine)].add(tuple(theirs))
    both = {tuple(sorted((a, b))) for a in on for b in on[a] if a in on.get(b, ())}
    assert len(on) >= 10
    assert both == set()


def test_no_file_stands_on_itself():
    def reached(name):
        seen, ahead = set(), [name]
        while ahead:
            for other in STANDS_ON[ahead.pop()] - seen:
                seen.add(other)
                ahead.append(other)
        return seen

    above = {name: reached(name) for name in STANDS_ON}
    cycles = [{b for b in above[a] if a in above[b]} for a in above if a in above[a]]
    assert cycles == []
