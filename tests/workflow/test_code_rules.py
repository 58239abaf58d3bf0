"""No source runs text or loads objects, every value in a shell command is quoted; and traps."""

import ast
import re
import shlex
from pathlib import Path
from types import SimpleNamespace

import pytest
from code_rules import TOPS, as_python, commands, faults, unquoted

ROOT = Path(__file__).resolve().parents[2]
OTHERS = [ROOT / "setup.py", ROOT / "docs" / "conf.py"]
SOURCES = OTHERS + sorted(
    path
    for top in (*TOPS, "docs/drawings", "docs/examples")
    for path in (ROOT / top).rglob("*.py")
    if "__pycache__" not in path.parts
)
RULES = [ROOT / "Snakefile", ROOT / "workflow/Snakefile"]
RULES += sorted((ROOT / "workflow").rglob("*.smk"))
ALLOWED = {
    "workflow/rocking/runtime/run_lock.py": {"socket"},  # asks for the machine's name
    "setup.py": {"runpy"},  # the list of what a wheel has
    "workflow/rocking/runtime/warm.py": {
        "runpy",  # a script of the project, of a rule
        "multiprocessing.connection",  # waits for its own child
    },
    "workflow/rocking/compile_ahead.py": {"importlib.import_module"},  # of a list of its own
    "yade_scripts/engine/library.py": {"sys.modules"},  # an empty one in a prompt's place
    "yade_scripts/engine/memory.py": {"os.execv"},  # itself, with more memory
    "yade_scripts/commands/view.py": {"os.execv"},  # YADE's own program
}
# placeholders in shell commands that need no quoting: each is limited to harmless words elsewhere
UNQUOTED = {
    "params.plan": "empty, or an option quoted where it is made",
    "params.yade": "a constant of the rules, quoted where it is made",
    "params.ensemble": "a constant of the rules",
    "wildcards.direction": "pos|neg",
    "params.gravity": "a number of the rule itself",
    "params.how": "directions and numbers by their schemas, made into options there",
}


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(ROOT)))
def test_no_source_runs_text_or_loads_objects(path):
    text = path.read_text("utf-8")
    allowed = ALLOWED.get(str(path.relative_to(ROOT)), set())
    assert allowed <= set(faults(text))  # and none for nothing
    assert faults(text, allowed) == []


@pytest.mark.parametrize("path", RULES, ids=lambda path: str(path.relative_to(ROOT)))
def test_rules_run_no_text_either(path):
    """Their commands are Snakemake's `shell`, which the tests below look at."""
    assert faults(as_python(path.read_text("utf-8")), {"shell"}) == []


TRAPS = {
    "from pickle import loads": "pickle",
    "import pickle as p": "pickle",
    "import urllib.request": "urllib.request",
    "from urllib import request": "urllib.request",
    "import http.server": "http",
    "from os import system as run": "os.system",
    "import os\nrun = os.system": "os.system",
    "import os as o\no.popen('ls')": "os.popen",
    "import os\nos.execv('a', [])": "os.execv",
    "run = eval": "eval",
    "import builtins\nbuiltins.exec('1')": "builtins.exec",
    "__import__('pickle')": "__import__",
    "from importlib import import_module as load\nload('pickle')": "importlib.import_module",
    "import importlib as i\ni.import_module(f'{name}.rocking')": "importlib.import_module",
    "from importlib import import_module as load\nread = load": "importlib.import_module",
    "import os\ngetattr(os, 'sys' + 'tem')('ls')": "getattr(os)",
    "import subprocess\nsubprocess.run('ls', shell=True)": "shell=True",
    "import subprocess\nsubprocess.run('ls', shell=given)": "shell=given",
    "from subprocess import getoutput": "subprocess.getoutput",
    "import numpy as np\nnp.load('a', allow_pickle=True)": "allow_pickle=True",
    "import pandas as pd\npd.read_pickle('a')": "pandas.read_pickle",
    "import yaml\nyaml.load('a', yaml.Loader)": "yaml.Loader",
    "from yaml import load": "yaml.load",
    "from yaml import UnsafeLoader as SafeLoader": "yaml.UnsafeLoader",
    "import yaml\nyaml.full_load('a')": "yaml.full_load",
    "import yaml\ngetattr(yaml, 'CUnsafeLoader', yaml.SafeLoader)('a')": "getattr(yaml)",
    "from snakemake.shell import shell": "snakemake.shell",
    "def f():\n    def g():\n        import marshal": "marshal",
    "from os import *\nsystem('ls')": "os.*",
    "import os\nown = os\nown.system('ls')": "os under another name",
    "import os\ndef f(o=os): o.system('ls')": "os under another name",
    "import sys\nsys.modules['os'].system('ls')": "sys.modules",
    "import os\nos.__dict__['system']('ls')": "os.__dict__",
    "__builtins__['eval']('1')": "__builtins__",
    "def f(): pass\nf.__globals__['os'].system('ls')": "f.__globals__",
    "import os\nvars(os)['system']('ls')": "vars(os)",
    "from importlib import import_module\nimport_module(name='pickle')": "importlib.import_module",
    "import importlib\nimportlib.__import__('pickle')": "importlib.__import__",
    "import pkgutil\npkgutil.resolve_name('os:system')('ls')": "pkgutil.resolve_name",
    "import importlib.util as u\nu.spec_from_file_location('a', 'b')": (
        "importlib.util.spec_from_file_location"
    ),
    "import subprocess\nsubprocess.run(['sh', '-c', 'ls'])": "sh -c",
    "import subprocess\nsubprocess.run(('/bin/bash', '-e', '-c', 'ls'))": "/bin/bash -c",
    "import subprocess, sys\nsubprocess.run([sys.executable, '-c', text])": "sys.executable -c",
    "import subprocess\nsubprocess.run(['/usr/bin/python3', '-c', text])": "/usr/bin/python3 -c",
    "import subprocess\nsubprocess.run('ls', **{'shell': True})": "run(**{'shell': True})",
    "import subprocess as s\ns.run('ls', **given)": "run(**given)",
    "import numpy as np\nnp.load('a', None, True)": "allow_pickle by its place",
    "import numpy as np\nnp.load('a', **{'allow_pickle': 1})": "load(**{'allow_pickle': 1})",
    "import pandas as pd\npd.eval(text)": "pandas.eval",
    "def f(table, text): table.query(text)": "query of a text",
    "def f(table, text): table.eval(text)": "eval of a text",
    "from yaml.loader import UnsafeLoader": "yaml.loader.UnsafeLoader",
    "import yaml\nCSafeLoader = yaml.CUnsafeLoader": "yaml.CUnsafeLoader",
    "from multiprocessing.connection import Listener": "multiprocessing.connection",
    "import pandas as pd\npd.read_csv('https://example.org/a')": "read_csv of an address",
    "import ctypes": "ctypes",
}


@pytest.mark.parametrize("text", TRAPS)
def test_the_check_of_sources_finds(text):
    assert TRAPS[text] in faults(text)


@pytest.mark.parametrize(
    "text",
    [
        "import re\nre.compile('a')",
        "import subprocess\nsubprocess.run(['ls'], shell=False)",
        "import yaml\nyaml.safe_load('a')",
        "import numpy as np\nnp.load('a', allow_pickle=False)",
        "class A:\n    def system(self): self.system()",
        "import urllib.parse",
        "from importlib import import_module\nimport_module(f'rocking.studies.{name}')",
        "code = 1\nprint(code)",
        "import os\nprint(os.path.sep, hasattr(os, 'fork'))",
        "def f(table): table.query('a > 1')",
        "import subprocess\nsubprocess.run(['git', '-c', 'a=b'])",
        "NAMESPACE = 'http://example.org/a'\nprint(NAMESPACE)",
        "from yaml import SafeLoader",
        "import yaml\nLOADER = getattr(yaml, 'CSafeLoader', yaml.SafeLoader)",
    ],
)
def test_the_check_of_sources_leaves(text):
    assert faults(text) == []


def test_every_value_in_a_shell_command_is_quoted():
    seen = []
    for path in RULES:
        for command in commands(path.read_text("utf-8")):
            assert command is not None, f"{path.name}: expected a shell command in plain text"
            seen.append(command)
            assert set(unquoted(command)) <= set(UNQUOTED), f"{path.name}: {command}"
    words = sum(len(re.findall(r"(?m)^ +shell:", path.read_text("utf-8"))) for path in RULES)
    assert len(seen) == words > 5
    if any(ROOT.glob("workflow/studies/*/rules.smk")):  # two of them are of studies
        assert {field for command in seen for field in unquoted(command)} == set(UNQUOTED)


def test_the_option_of_a_plan_is_quoted_where_it_is_made():
    """It stands unquoted in a command, since it may be empty."""
    tree = ast.parse(as_python((ROOT / "workflow/rules/common.smk").read_text("utf-8")))
    made = {one.name: one for one in tree.body if isinstance(one, ast.FunctionDef)}
    known = {"shlex": shlex}
    exec(ast.unparse(made["plan_option"]), known)
    for path in ("it's a $(touch pwned); `touch pwned`/a.json", "-rf", "a\nb"):
        option = known["plan_option"](None, SimpleNamespace(plan=path))
        assert option == f"--plan {shlex.quote(path)}"
    assert known["plan_option"](None, SimpleNamespace(plan=[])) == ""


RULE = "rule a:\n    input:\n        'b',\n"
UNSAFE = {
    "below": RULE + '    shell:\n        "rm {input}"\n',
    "on the line": RULE + '    shell: "rm {input}"\n',
    "single quotes": RULE + "    shell:\n        'rm {input}'\n",
    "three quotes": RULE + '    shell:\n        """\n        rm {input}\n        """\n',
    "second line": RULE + '    shell:\n        "rm {input:q}"\n        " {output}"\n',
    "a constant": f'REMOVE = "rm {{input}}"\n\n\n{RULE}    shell:\n        REMOVE\n',
    "a constant in brackets": 'REMOVE = (\n    "rm"\n    " {input}"\n)\n\n\n'
    + f"{RULE}    shell: REMOVE\n",
    "deeper": 'if True:\n\n    rule a:\n        shell:\n            "rm {input}"\n',
    "called": "rule a:\n    run:\n        shell('rm {input}')\n",
    "an item": RULE + '    shell:\n        "rm {input[0]}"\n',
    "after a literal brace": RULE + "    shell:\n        \"awk '{{print}}' {input}\"\n",
    "a value of Python's": RULE + '    shell:\n        "rm {input!s}"\n',
    "a wildcard": RULE + '    shell:\n        "rm {wildcards.run}"\n',
}
NOT_WRITTEN = {
    "a formatted text": RULE + '    shell:\n        f"rm {x}"\n',
    "a sum": RULE + '    shell:\n        "rm " + name\n',
    "a name from elsewhere": RULE + "    shell:\n        COPY\n",
    "a function": RULE + "    shell:\n        command()\n",
    "handed on": "run = shell\n",
}


@pytest.mark.parametrize("name", UNSAFE)
def test_the_check_of_commands_finds_a_value_without_quotes(name):
    (command,) = commands(UNSAFE[name])
    assert unquoted(command)
    safe = re.sub(r"\{([a-z][^{}:!]*?)(!s)?(:q)?\}", r"{\1:q}", UNSAFE[name])
    (quoted,) = commands(safe)
    assert unquoted(quoted) == []


@pytest.mark.parametrize("mark", ["'", '"'])
def test_a_quoted_value_between_marks_ends_them(mark):
    assert unquoted(f"rm {mark}{{input:q}}{mark}") == ["input:q"]
    assert unquoted(f"rm {mark}a{mark} {{input:q}} {mark}b{mark}") == []


@pytest.mark.parametrize("name", NOT_WRITTEN)
def test_the_check_of_commands_wants_them_in_plain_text(name):
    assert commands(NOT_WRITTEN[name]) == [None]


SCRIPTS = [
    path
    for path in sorted((*SOURCES, *(ROOT / "tests" / "trials").rglob("*.py")))
    if '__name__ == "__main__"' in path.read_text("utf-8")
]


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_a_script_finds_the_tests_that_it_takes_from(path):
    """A script has its own folder on the path, and `tests` is no package that is installed."""
    lines = path.read_text("utf-8").splitlines()
    takes = [k for k, line in enumerate(lines) if re.match(r"(from|import) tests\b", line)]
    finds = [k for k, line in enumerate(lines) if "sys.path" in line]
    assert not takes or finds and finds[0] < takes[0]
