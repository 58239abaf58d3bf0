"""Run one script of the workflow as it runs without Snakemake."""

import json

from forked import ROOT, run


def script(name, folder, checked=True, **parts):
    """Run a script of workflow/scripts, of a study or of tools, by its name, in a folder.

    Parameters
    ----------
    name : str
        File name without its ending.
    folder : Path
    checked : bool
        Whether it has to end well.
    **parts : dict or str
        What `input`, `output`, `params` and `wildcards` hold, by name; one value has none.

    Returns
    -------
    CompletedProcess
    """
    places = ("workflow/scripts/*", "workflow/studies/*/scripts", "tools")
    (found,) = [path for place in places for path in ROOT.glob(f"{place}/{name}.py")]
    words = [str(found)]
    for part, values in parts.items():
        words.append(f"--{part}")
        if isinstance(values, str):
            words.append(values)
            continue
        words += [f"{k}={v if isinstance(v, str) else json.dumps(v)}" for k, v in values.items()]
    done = run(folder, *words)
    assert done.returncode == 0 or not checked, done.stderr
    return done
