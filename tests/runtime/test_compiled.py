"""Compiled functions: a change of what they call is a change of theirs."""

import os
import subprocess
import sys

import pytest


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
        done = subprocess.run(
            [sys.executable, "-c", "from outer import f; print(f(10))"],
            cwd=tmp_path,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(("", *sys.path))},
            capture_output=True,
            text=True,
            timeout=120,
        )
        assert done.returncode == 0, done.stderr
        answers.append(int(done.stdout))
    assert answers == [21, 22]
