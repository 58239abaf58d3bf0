"""Compiled functions: a change of what they call is a change of theirs."""

import json
import math
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import pytest
from rocking import compile_ahead
from rocking.runtime.compiled import KeptLoops, looped
from rocking.solver.block import march_blocks

SEEN = """
import json
import sys

import numpy as np
from numba.core.dispatcher import Dispatcher
from rocking import Case, Motion, collapse_curve, collapse_curves, compile_ahead
from rocking.mechanics import column
from rocking.records import Record
from reference_solver.facade import answers


def compiled():
    own = [vars(m) for name, m in sys.modules.items() if name.startswith("rocking.")]
    found = {f for names in own for f in names.values() if isinstance(f, Dispatcher)}
    return sorted([f.__name__, str(types)] for f in found for types in f.signatures)


for function, *words in compile_ahead.JOBS:
    function(*words)
ahead = compiled()
t = np.arange(0.0, 1.0, 0.01)
wave = np.sin(6.0 * t)
short = {"ida.max_pga_g": 0.1, "ida.level_ratio": 0.1, "ida.power": 0.0}
short |= {"smdof.tail_s": 0.0, "numerics.after_motion_s": 0.1}
block = {"facade.courses": 0, "smdof.base_shear_ratio": None}
tie, floor = {"height_m": 6.0, "diameter_mm": 6.0}, {"height_m": 5.0, "anchor_kn": 5.0}
for model, more in (
    ("W1", {"facade.ties": [tie], "facade.floors": [floor]} | block),
    ("W1", {"facade.hinges_m": [3.0]}),
    ("W2", {}),
    ("W2", block),
    ("W2c", {}),
    ("W2m", {}),
    ("W2m", block),
    ("W3", {"w3.course_height_m": 0.648}),
):
    case = Case.configured(model, {**short, **more})
    one, other = (Motion(Record("wave", f * wave, 0.01, "file")) for f in (1.0, 0.9))
    collapse_curve(case, one, "neg", search="crossings")
    several = {"search": "list", "settings": {"pga_g": [0.05, 0.1]}}
    collapse_curves(case, [(one, "neg"), (other, "pos")], **several)
case = Case.configured("W2", block).sections
moving = t, {"ground": wave, **{f"floor{j}": wave for j in range(1, 5)}}
answers(case, moving, "pos", [0.1], nodes=5, tolerance=1e-4)
case = Case.configured("W2", {"facade.courses": 2}).sections
answers(case, moving, "pos", [0.1], nodes=5, tolerance=1e-4)
column.capacity([0.1, 0.2], 0.05, 0.06, column.courses(5))
print(json.dumps([ahead, compiled()]))
"""


def printed(folder, words):
    """What a Python of its own prints that runs some words in a folder.

    It keeps no bytecode, which would hide a change of a file within the same second.
    """
    done = subprocess.run(
        [sys.executable, "-B", "-c", words],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(("", *sys.path))},
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.slow
def test_the_set_up_compiles_what_runs_call():
    """Whatever the façade has, no loop is compiled again: types and layouts are those of runs."""
    done = subprocess.run(
        [sys.executable, "-c", SEEN],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    ahead, called = json.loads(done.stdout.splitlines()[-1])
    assert called == ahead
    assert {name for name, _ in called} >= {
        "march_block",
        "march_blocks",
        "march_stack",
        "march_stacks",
    }


@pytest.mark.slow
def test_a_change_in_the_file_beside_is_seen(tmp_path):
    """numba's own cache would give the first answer twice."""
    own = "from rocking.runtime.compiled import compiled\n"
    (tmp_path / "outer.py").write_text(
        own + "from inner import added\n@compiled\ndef f(x):\n    return x + added(x)\n"
    )
    answers = []
    for step in (1, 2):
        (tmp_path / "inner.py").write_text(
            own + f"@compiled\ndef added(x):\n    return x + {step}\n"
        )
        answers.append(int(printed(tmp_path, "from outer import f; print(f(10))")))
    assert answers == [21, 22]


@pytest.mark.slow
def test_what_was_compiled_of_types_of_a_module_that_is_gone_is_made_anew(tmp_path):
    """As after an update that renames modules."""
    typed = "from typing import NamedTuple\nclass Pair(NamedTuple):\n    x: float\n    y: float\n"
    own = "from rocking.runtime.compiled import compiled\n"
    own += "@compiled\ndef added(p):\n    return p.x + p.y\n"
    (tmp_path / "sums.py").write_text(own)
    answers = []
    for name, more in (("former", 1.0), ("present", 2.0)):
        (tmp_path / f"{name}.py").write_text(typed)
        said = f"from sums import added; from {name} import Pair; print(added(Pair(10.0, {more})))"
        answers.append(float(printed(tmp_path, said)))
        (tmp_path / f"{name}.py").unlink()
    assert answers == [11.0, 12.0]


def test_without_a_folder_for_its_cache_a_function_is_compiled_alike():
    given = {}
    exec("def over(x):\n    return 1.0 / x\n", given)  # of no file: numba finds no folder
    over = looped(given["over"])
    assert over(0.0) == math.inf
    assert over.stats.cache_path is None
    assert march_blocks.stats.cache_path is not None
    assert over.targetoptions == march_blocks.targetoptions


@pytest.mark.slow
def test_what_is_given_functions_is_kept_in_the_cache_of_what_gives_them(tmp_path):
    """Within a loop alone, and as Python where Python calls."""
    (tmp_path / "outer.py").write_text(
        "from rocking.runtime.compiled import inlined, looped\n"
        "@inlined\ndef more(x):\n    return x + 1\n"
        "@inlined\ndef twice(f, x):\n    return f(f(x))\n"
        "@looped\ndef g(x):\n    return twice(more, x)\n"
        "print(g(10), sum(g.stats.cache_hits.values()), twice(more, 10))\n"
    )
    answers = [printed(tmp_path, "import outer").split() for _ in range(2)]
    assert answers == [["12", "0", "12"], ["12", "1", "12"]]


KILLED = """
import os
from rocking.runtime import compiled
{cls}._save_{what} = lambda *_: os._exit(0)
from outer import f
f({given})
"""


@pytest.mark.slow
@pytest.mark.parametrize("what", ["data", "index"])
@pytest.mark.parametrize("given", [10, 10.0])
def test_a_process_killed_as_it_keeps_leaves_no_old_code_behind(tmp_path, what, given):
    """The source changed, and whoever compiled it anew was killed between the cache's two files."""
    answers = []
    for step in (1, 2):
        (tmp_path / "outer.py").write_text(
            "from rocking.runtime.compiled import compiled\n"
            f"@compiled\ndef f(x):\n    return x + {step}\n"
        )
        if step > 1:
            killed = KILLED.format(cls="compiled.KeptLoops", what=what, given=given)
            printed(tmp_path, killed)
        answers.append(printed(tmp_path, "from outer import f; print(int(f(10)))").strip())
    assert answers == ["11", "12"]


@pytest.mark.slow
def test_code_of_sources_before_is_cleared_and_that_of_other_types_kept(tmp_path):
    for step in (1, 2):
        (tmp_path / "outer.py").write_text(
            "from rocking.runtime.compiled import compiled\n"
            f"@compiled\ndef f(x):\n    return x + {step}\n"
        )
        printed(tmp_path, "from outer import f; f(10); f(10.0)")
        assert len(list(tmp_path.rglob("*.nbc"))) == 2
    hits = "from outer import f; f(10); f(10.0); print(sum(f.stats.cache_hits.values()))"
    assert printed(tmp_path, hits).strip() == "2"


def test_what_one_process_compiles_another_waits_for_and_reads(tmp_path):
    """A second cache of the same files, as of another process: it waits until the first keeps."""

    def kept():
        found = KeptLoops(str(tmp_path), "f", ("stamp",))
        found.source = __file__
        return found

    first, second = kept(), kept()
    assert first.load("types") is None  # its turn
    assert first.load("types") is None  # which it has already
    with ThreadPoolExecutor(1) as pool:
        waits = pool.submit(second.load, "types")
        assert kept().load("other types") is None  # nothing is compiled for them
        with pytest.raises(TimeoutError):
            waits.result(timeout=0.5)
        first.save("types", [1, 2])
        assert waits.result(timeout=60) == [1, 2]
    assert len(list(tmp_path.glob("*.lock"))) == 1  # of the other types


def test_a_process_that_ended_as_it_compiled_is_not_waited_for(tmp_path):
    first = KeptLoops(str(tmp_path), "f", ("stamp",))
    assert first.load("types") is None
    for held in first._turns.values():
        os.close(held)  # as the system does
    assert KeptLoops(str(tmp_path), "f", ("stamp",)).load("types") is None


@pytest.mark.slow
def test_a_killed_compiler_is_one_line(capsys):
    assert compile_ahead.main(jobs=[(os._exit, 9)]) == 1
    assert capsys.readouterr().err.startswith("error: a process that compiled a solver was killed")
