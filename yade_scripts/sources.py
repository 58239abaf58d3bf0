"""Which source files a script depends on, read from its import statements.

Rules take them as inputs and journals hash them, so that a change of any module reruns what it
can change, and nothing else; nobody keeps a list.
"""

import ast
import hashlib
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = {
    "yade_scripts": ROOT / "yade_scripts",
    "smdof": ROOT / "smdof",
    "record_files": ROOT / "workflow" / "record_files",
    "reference_solver": ROOT / "workflow" / "reference_solver",
    "rocking": ROOT / "workflow" / "rocking",
    "studies": ROOT / "workflow" / "studies",
}
READ_BESIDE = (".mplstyle", ".j2", ".css", ".html")  # what code reads beside itself


def _file(dotted):
    """File of a module or package of the project; None for anything else."""
    head, *rest = dotted.split(".")
    if head not in PACKAGES:
        return None
    path = PACKAGES[head].joinpath(*rest)
    return next((p for p in (path.with_suffix(".py"), path / "__init__.py") if p.is_file()), None)


def _package(path):
    """Dotted name of the package that a file belongs to; empty outside the project's packages."""
    for name, folder in PACKAGES.items():
        if folder in path.parents:
            return ".".join((name, *path.parent.relative_to(folder).parts))
    return ""


def names(files):
    """Dotted names of those files that are modules of the project, sorted.

    The script of a rule is left out, wherever it lies: to import it would run it.
    """
    modules = []
    for path in map(Path, files):
        package = _package(path)
        if package and path.suffix == ".py" and (path.parent / "__init__.py").is_file():
            modules.append(package if path.stem == "__init__" else f"{package}.{path.stem}")
    return sorted(modules)


def _statements(node):
    """Statements below one, at any depth; no expressions, which are most of a file."""
    for field in ("body", "orelse", "finalbody", "handlers", "cases"):
        for inner in getattr(node, field, ()):
            yield inner
            yield from _statements(inner)


@cache
def imports(path):
    """Project files that one file imports by itself, with the `__init__` of their packages."""
    names: set[str] = set()
    for node in _statements(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            names.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            parts = _package(path).split(".")
            above = parts[: len(parts) - node.level + 1] if node.level else []
            module = ".".join([*above, *([node.module] if node.module else [])])
            names.update(f"{module}.{alias.name}" for alias in node.names)
    files: set[Path | None] = set()
    for name in names:
        parts = name.split(".")
        files.update(_file(".".join(parts[: i + 1])) for i in range(len(parts)))
    return frozenset(files - {None, path})


@cache
def sources(path):
    """Return a script and everything it imports, directly or not, sorted.

    What is no Python but lies beside an imported module and is read by it, such as a figure's style
    sheet, belongs to it.
    """
    todo, seen = [Path(path).resolve()], set()
    while todo:
        file = todo.pop()
        if file not in seen:
            seen.add(file)
            todo.extend(imports(file))
    beside = {
        other
        for folder in {file.parent for file in seen if _package(file)}
        for other in folder.iterdir()
        if other.is_file() and other.suffix in READ_BESIDE
    }
    return tuple(sorted(seen | beside))


def digest(path):
    """Hash of a script and all that it imports, hex."""
    total = hashlib.sha256()
    for file in sources(path):
        total.update(file.relative_to(ROOT).as_posix().encode() + b"\0" + file.read_bytes())
    return total.hexdigest()
