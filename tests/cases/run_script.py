"""Run one script of the workflow as it runs without Snakemake."""

import json
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LIMIT_S = 300.0


def script(name, folder, checked=True, **parts):
    """Run a script of workflow/scripts or tools, by its name, in a folder.

    Parameters
    ----------
    name : str
        File name without its ending.
    folder : Path
    checked : bool
        Whether it has to end well.
    **parts : dict
        What `input`, `output`, `params` and `wildcards` hold, by name.

    Returns
    -------
    CompletedProcess
    """
    (found,) = [*(ROOT / "workflow/scripts").glob(f"*/{name}.py"), *ROOT.glob(f"tools/{name}.py")]
    words = [sys.executable, str(found)]
    for part, values in parts.items():
        words.append(f"--{part}")
        words += [f"{k}={v if isinstance(v, str) else json.dumps(v)}" for k, v in values.items()]
    path = os.pathsep.join([str(ROOT), str(ROOT / "workflow")])
    done = subprocess.run(
        words,
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
        env={**os.environ, "PYTHONPATH": path},
    )
    assert done.returncode == 0 or not checked, done.stderr
    return done
