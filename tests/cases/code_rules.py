"""What no source of the project may do, read off its syntax: code from text, objects, sockets.

Names are followed through imports and their aliases, so that `from pickle import loads` and
`p = eval` are found as well as a plain call.
"""

import ast
import io
import re
import tokenize
from types import SimpleNamespace

from yade_scripts.sources import PACKAGES, ROOT

MODULES = {  # that make objects of bytes, open connections, or run other files
    *("pickle", "_pickle", "cPickle", "cloudpickle", "dill", "joblib", "marshal", "shelve"),
    *("socket", "socketserver", "http", "urllib.request", "requests", "xmlrpc", "ftplib"),
    *("smtplib", "telnetlib", "asyncio", "aiohttp", "httpx", "webbrowser", "ssl", "wsgiref"),
    *("imaplib", "poplib", "nntplib", "smtpd", "urllib3", "logging.config"),
    *("multiprocessing.connection", "multiprocessing.managers", "ctypes", "cffi"),
    *("runpy", "code", "codeop", "imp", "pty", "snakemake.shell"),
}
NAMES = {  # also where they are not called: `run = eval`
    *("eval", "exec", "compile", "__import__"),
    *(f"builtins.{name}" for name in ("eval", "exec", "compile", "__import__")),
    *("__builtins__", "sys.modules", "importlib.__import__", "importlib.reload"),
    *("importlib.util.spec_from_file_location", "importlib.util.module_from_spec"),
    *("importlib.machinery.SourceFileLoader", "pkgutil.resolve_name", "pandas.eval"),
    *("os.system", "os.popen", "os.fork", "os.posix_spawn", "os.posix_spawnp"),
    *("subprocess.getoutput", "subprocess.getstatusoutput"),
    *("yaml.unsafe_load", "yaml.full_load", "yaml.unsafe_load_all", "yaml.full_load_all"),
    *("yaml.load", "yaml.load_all", "pandas.read_pickle", "shell"),
}
OF_YAML = re.compile(r"yaml\.(\w+\.)*C?(Unsafe|Full)?(Loader|Constructor)")  # that make objects
STARTS = ("os.exec", "os.spawn")  # os.execv, os.spawnl, …
OFF = ("shell", "allow_pickle")  # keywords that stay False
IMPORT = "importlib.import_module"  # of a text that begins as the project's modules do
OWN = tuple(f"{package}." for package in PACKAGES)
# folders of the project at the top that hold code
TOPS = sorted({folder.relative_to(ROOT).parts[0] for folder in PACKAGES.values()} | {"tools"})
# modules whose names are looked up in the source, not by a text, under no second name
LOOKED_INTO = ("os", "sys", "builtins", "subprocess", "importlib", "yaml")
SHELLS = re.compile(r"(.*/)?(env|(ba|da|z|k|c)?sh|python[\d.]*)")
BY_TEXT = ("eval", "query")  # of a frame: code of pandas' own
LOOKING = ("getattr", "vars", "setattr")
SAFE = "getattr(yaml, 'CSafeLoader', yaml.SafeLoader)"  # libyaml's, which makes no objects either
ASKING = ("hasattr", "dir")
ADDRESS = re.compile(r"(?i)(https?|ftps?|s3|gs)://")
READS = re.compile(r"(read|load|open|get|fetch|url|request)", re.I)


def faults(text, allowed=frozenset()):
    """What a Python source does that none may, as sorted texts; `allowed` modules and names.

    A loader of YAML that is made here is judged by what it is made of.
    """
    tree = ast.parse(text)
    found, known = set(), {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                found |= _module(alias.name)
                known[alias.asname or alias.name.partition(".")[0]] = (
                    alias.name if alias.asname else alias.name.partition(".")[0]
                )
        elif isinstance(node, ast.ImportFrom) and not node.level:
            for alias in node.names:
                whole = f"{node.module}.{alias.name}"
                found |= _module(whole) | _name(whole) | ({whole} if alias.name == "*" else set())
                known[alias.asname or alias.name] = whole
    roots = {name.partition(".")[0] for name in known.values()}
    called = {id(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)}
    looked_into = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    for call in ast.walk(tree):  # `getattr(os, …)`, which `_call` names
        if isinstance(call, ast.Call) and _dotted(call.func, known) in (*LOOKING, *ASKING):
            looked_into |= {id(one) for one in call.args}
    for node in ast.walk(tree):
        if isinstance(node, ast.Name | ast.Attribute) and isinstance(node.ctx, ast.Load):
            name = _dotted(node, known)
            found |= _name(name) if name.partition(".")[0] in roots else {name} & NAMES
            found |= {IMPORT} if name == IMPORT and id(node) not in called else set()
            if name in LOOKED_INTO and name in known.values() and id(node) not in looked_into:
                found.add(f"{name} under another name")
            if name.endswith((".__dict__", ".__builtins__", ".__globals__", ".__subclasses__")):
                found.add(name)
        if isinstance(node, ast.Call):
            found |= _call(node, known)
        if isinstance(node, ast.List | ast.Tuple):
            found |= _started(node, known)
    return sorted(found - allowed)


def used(text):
    """Dotted names that a source uses or imports, as far as its imports tell what they are."""
    tree, known = ast.parse(text), {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            known |= {one.asname: one.name for one in node.names if one.asname}
        elif isinstance(node, ast.ImportFrom) and not node.level:
            known |= {one.asname or one.name: f"{node.module}.{one.name}" for one in node.names}
    every = [node for node in ast.walk(tree) if isinstance(node, ast.Name | ast.Attribute)]
    return {*known.values(), *(_dotted(node, known) for node in every)}


def imports(text, own=""):
    """Dotted names that a source imports: late, relative to its package `own`, or by a text.

    What a module is asked for stands behind its name. Without `own` no relative one counts.
    """
    tree, loaders = ast.parse(text), {"import_module", "__import__"}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (one.name for one in node.names)
        elif isinstance(node, ast.ImportFrom):
            loaders |= {one.asname for one in node.names if one.name in loaders and one.asname}
            above = own.split(".")[: own.count(".") + 2 - node.level] if node.level else []
            base = [*above, *filter(None, [node.module])]
            if own or not node.level:
                yield from (".".join([*base, one.name]) for one in node.names)
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and ast.unparse(node.func).rpartition(".")[2] in loaders:
            every = (getattr(one, "value", None) for one in ast.walk(node))
            yield from (said for said in every if isinstance(said, str))


def _module(name):
    return {one for one in MODULES if name == one or name.startswith(f"{one}.")}


def _name(name):
    whole = name in NAMES or name.startswith(STARTS) or OF_YAML.fullmatch(name)
    return {name} if whole else _module(name)


def _started(node, known):
    """A command that hands a text to a shell or to Python: `["sh", "-c", text]`."""
    if not node.elts or "-c" not in [getattr(one, "value", None) for one in node.elts]:
        return set()
    first = node.elts[0]
    named = first.value if isinstance(first, ast.Constant) else _dotted(first, known)
    own = named == "sys.executable" or SHELLS.fullmatch(str(named))
    return {f"{named} -c"} if own else set()


def _dotted(node, known):
    """Name of what an expression stands for, as far as imports tell; "" where they do not."""
    if isinstance(node, ast.Name):
        return known.get(node.id, node.id)
    if isinstance(node, ast.Attribute):
        return f"{base}.{node.attr}" if (base := _dotted(node.value, known)) else ""
    return ""


def _call(node, known):
    found = set()
    name = _dotted(node.func, known)
    last = getattr(node.func, "attr", name)
    for keyword in node.keywords:
        said = ast.unparse(keyword.value)
        if keyword.arg in OFF and said != "False":
            found.add(f"{keyword.arg}={said}")
        if keyword.arg is None and (name.startswith("subprocess.") or any(o in said for o in OFF)):
            found.add(f"{last}(**{said})")
    first = [*node.args, *(word.value for word in node.keywords if word.arg == "name")][:1]
    if name == IMPORT and not (first and _beginning(first[0]).startswith(OWN)):
        found.add(IMPORT)
    if name == "numpy.load" and len(node.args) > 2:
        found.add("allow_pickle by its place")
    if not node.args:
        return found
    what = _dotted(node.args[0], known)
    if name in LOOKING and what in LOOKED_INTO and ast.unparse(node) != SAFE:
        found.add(f"{name}({what})")
    if last in BY_TEXT and isinstance(node.func, ast.Attribute) and not _beginning(node.args[0]):
        found.add(f"{last} of a text")
    if READS.search(last) and ADDRESS.match(_beginning(node.args[0])):
        found.add(f"{last} of an address")
    return found


def _beginning(node):
    """Text that an expression is, or begins with; "" of any other."""
    node = node.values[0] if isinstance(node, ast.JoinedStr) and node.values else node
    value = node.value if isinstance(node, ast.Constant) else ""
    return value if isinstance(value, str) else ""


def as_python(text):
    """Rules of Snakemake as the Python that they are made into."""
    from snakemake.parser import parse

    path = SimpleNamespace(get_path_or_uri=lambda secret_free: "rules")
    cache = SimpleNamespace(open=lambda _: io.StringIO(text))
    return parse(path, SimpleNamespace(sourcecache=cache), {})[0]


def commands(text):
    """Shell commands of rules: the text of each, or None of one that is not written out.

    After `shell:`, on its line or below it at any depth, or in a call of `shell`. Constants are
    those of the same file.
    """
    skipped = (tokenize.COMMENT, tokenize.NL)
    every = tokenize.generate_tokens(io.StringIO(text).readline)
    tokens = [token for token in every if token.type not in skipped]
    constants = _constants(text)
    found = []
    for k, token in enumerate(tokens[:-1]):
        if token.string != "shell" or token.type != tokenize.NAME or tokens[k - 1].string == ".":
            continue
        if tokens[k + 1].string == ":":
            found.append(_written(_block(tokens, k + 2), constants))
        elif tokens[k + 1].string == "(":
            found.append(_written(_brackets(tokens, k + 2), constants))
        else:  # handed on under another name
            found.append(None)
    return found


def _constants(text):
    """Texts that a file gives a name at its left edge, by name."""
    found = {}
    for name, value in re.findall(r"(?ms)^([A-Z_]\w*) = (.+?)\n(?=[^\s)]|\s*\Z)", text):
        try:
            value = ast.literal_eval(value)
        except (ValueError, SyntaxError):
            continue
        if isinstance(value, str):
            found[name] = value
    return found


def _block(tokens, k):
    """Tokens of a directive: of its line, or of the block below it."""
    found, depth = [], 0
    if tokens[k].type != tokenize.NEWLINE:
        while tokens[k].type != tokenize.NEWLINE:
            found.append(tokens[k])
            k += 1
        return found
    for token in tokens[k + 1 :]:
        depth += (token.type == tokenize.INDENT) - (token.type == tokenize.DEDENT)
        if not depth:
            return found
        found.append(token)
    return found


def _brackets(tokens, k):
    found, depth = [], 1
    for token in tokens[k:]:
        depth += (token.string in ("(", "[")) - (token.string in (")", "]"))
        if not depth:
            return found
        found.append(token)
    return found


def _written(tokens, constants):
    """The text of strings and constants one after another; None where there is anything else."""
    out = []
    for token in tokens:
        if token.type in (tokenize.NEWLINE, tokenize.INDENT):
            continue
        if token.type == tokenize.STRING and not re.match(r"\w*[fF]", token.string):
            out.append(ast.literal_eval(token.string))
        elif token.type == tokenize.NAME and token.string in constants:
            out.append(constants[token.string])
        else:
            return None
    return "".join(out)


def unquoted(command):
    """Fields of a command that the shell would split or read.

    Those without `:q`, and those with it between quotation marks, which theirs would end.
    """
    found, before = [], ""
    for text, field in re.findall(r"((?:[^{]|\{\{)*)(?:\{([^{}]+)\})?", command):
        before += text
        inside = before.count("'") % 2 or before.count('"') % 2
        if field and (inside or not field.endswith(":q")):
            found.append(field)
    return found
