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
    "rocking": ROOT / "workflow" / "rocking",
}

STUDIES = "rocking.studies"  # modules that compute and draw
MARKING, MARK = "rocking.runtime.drawing", "drawing"  # what only draws there


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
    """Dotted names of those files that are modules of the project, sorted."""
    found = []
    for path in map(Path, files):
        package = _package(path)
        if package and path.suffix == ".py":
            found.append(package if path.stem == "__init__" else f"{package}.{path.stem}")
    return sorted(found)


def _statements(node):
    """Statements below one, at any depth; no expressions, which are most of a file."""
    for field in ("body", "orelse", "finalbody", "handlers", "cases"):
        for inner in getattr(node, field, ()):
            yield inner
            yield from _statements(inner)


def _marked(tree):
    """Functions of a module that are marked as drawing; none where the mark may be another.

    A mark counts that is the only one, and imported from `rocking.runtime.drawing`, which refuses
    calls by what computes. What a function's head evaluates when it is read is part of computing.
    """
    bound = [
        name
        for node in ast.walk(tree)
        for name in (
            getattr(node, "name", None),
            getattr(node, "asname", None),
            getattr(node, "arg", None),
            node.id if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load) else None,
        )
        if name == MARK or name == "*"
    ]
    imported = [
        node
        for node in tree.body
        if isinstance(node, ast.ImportFrom)
        and (node.module, node.level) == (MARKING, 0)
        and MARK in {alias.name for alias in node.names if alias.asname is None}
    ]
    if len(bound) != 1 or len(imported) != 1:
        return []
    return [
        node
        for node in tree.body
        if isinstance(node, ast.FunctionDef)
        and [ast.unparse(mark) for mark in node.decorator_list] == [MARK]
        and not any(
            isinstance(part, ast.Call | ast.Await | ast.NamedExpr)
            for head in (node.args, node.returns)
            if head is not None
            for part in ast.walk(head)
        )
    ]


def computing(text):
    """Text of a study's module without its functions that draw, those marked `@drawing`.

    They import what they draw with themselves: it loads slowly, and sets matplotlib up for files.

    Examples
    --------
    >>> text = "from rocking.runtime.drawing import drawing\\n@drawing\\ndef look():\\n    pass\\n"
    >>> computing(text)
    'from rocking.runtime.drawing import drawing\\n'
    """
    lines = text.splitlines(keepends=True)
    for node in reversed(_marked(ast.parse(text))):
        del lines[node.decorator_list[0].lineno - 1 : node.end_lineno]
    return "".join(lines)


def _text(path, drawn):
    """Text of a file; of a study's module, where drawing does not count, what computes."""
    text = path.read_text("utf-8")
    return computing(text) if not drawn and _package(path) == STUDIES else text


@cache
def imports(path, drawn=True):
    """Project files that one file imports by itself, with the `__init__` of their packages.

    Without `drawn` what a study draws does not count, see `computing`.
    """
    names: set[str] = set()
    for node in _statements(ast.parse(_text(path, drawn))):
        if isinstance(node, ast.Import):
            names.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            parts = _package(path).split(".")
            above = parts[: len(parts) - node.level + 1] if node.level else []
            module = ".".join([*above, *([node.module] if node.module else [])])
            names.update(f"{module}.{alias.name}" for alias in node.names)
    found: set[Path | None] = set()
    for name in names:
        parts = name.split(".")
        found.update(_file(".".join(parts[: i + 1])) for i in range(len(parts)))
    return frozenset(found - {None, path})


@cache
def sources(path, drawn=True):
    """Return a script and everything it imports, directly or not, sorted; `drawn` as of `imports`.

    What is no Python but lies beside an imported module (a figure's style sheet) belongs to it.
    """
    todo, seen = [Path(path).resolve()], set()
    while todo:
        file = todo.pop()
        if file not in seen:
            seen.add(file)
            todo.extend(imports(file, drawn or _package(file) != STUDIES))
    beside = {
        other
        for folder in {file.parent for file in seen if _package(file)}
        for other in folder.iterdir()
        if other.is_file() and other.suffix not in (".py", ".pyc")
    }
    return tuple(sorted(seen | beside))


def digest(path, drawn=True):
    """Hash of a script and all that it imports, hex; arguments as of `sources`."""
    total = hashlib.sha256()
    for file in sources(path, drawn):
        content = _text(file, drawn).encode() if file.suffix == ".py" else file.read_bytes()
        total.update(file.relative_to(ROOT).as_posix().encode() + b"\0" + content)
    return total.hexdigest()
