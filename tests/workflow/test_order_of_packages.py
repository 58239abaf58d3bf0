"""The floors of the house: no package stands on one that stands on it, and no file on itself."""

from collections import defaultdict

from code_rules import imports

from yade_scripts.sources import PACKAGES

ROOMS = 16  # packages of the core, in the first two levels
APART = {"scripts", "tests", "trials"}  # of a study: run, and imported by nobody
MODULES = {
    ".".join(path.relative_to(folder.parent).with_suffix("").parts).removesuffix(".__init__"): path
    for folder in PACKAGES.values()
    for path in folder.rglob("*.py")
    if not APART & {*path.parts} and not path.name.startswith("test_")
}


def package_of(name):
    """Package of a module, two levels deep at most; that of a package itself is its own."""
    parts = name.split(".")
    return tuple((parts if MODULES[name].name == "__init__.py" else parts[:-1])[:2])


def imported(name):
    """Modules of the package that one imports, also within its functions."""
    path = MODULES[name]
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    for one in imports(path.read_text("utf-8"), package):
        found = one if one in MODULES else one.rpartition(".")[0]
        if found in MODULES and found != name and not one.endswith("."):  # a text's beginning
            yield found


STANDS_ON = {name: set(imported(name)) for name in MODULES}


def test_no_pair_of_packages_points_both_ways():
    on = defaultdict(set)
    for name, others in STANDS_ON.items():
        for other in others:
            mine, theirs = package_of(name), package_of(other)
            if mine != theirs and len(mine) == len(theirs) == 2:
                on[mine].add(theirs)
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


def room(name):
    """Package of the core in which a module lies, by two names at most; "" of what is beside."""
    parts = name.split(".") if MODULES[name].name == "__init__.py" else name.split(".")[:-1]
    inner = ".".join(parts[:2])
    return "" if inner in ("rocking", "yade_scripts") or parts[0] == "studies" else inner


def test_rooms_are_few_and_every_import_goes_down():
    """Rooms can be laid on floors: each imports of those below alone.

    What lies beside the rooms of a package, such as `rocking.tables`, is in none of them.
    """
    below = defaultdict(set)
    for name, others in STANDS_ON.items():
        below[room(name)] |= {room(other) for other in others} - {room(name), ""}
    below.pop("")
    assert 10 < len(below) <= ROOMS
    while below:
        floor = {name for name, others in below.items() if not others & {*below}}
        assert floor, f"imports in a circle among {sorted(below)}"
        below = {name: others for name, others in below.items() if name not in floor}
