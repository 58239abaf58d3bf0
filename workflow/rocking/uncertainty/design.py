"""The motions under which the sample of an uncertainty study is run."""

from rocking.records import load
from rocking.uncertainty import sampling


def drawn_motions(runs, run):
    """Direction of every motion of a run's design, by record.

    Parameters
    ----------
    runs : rocking.runs.Runs
    run : str

    Returns
    -------
    dict of str to str

    Raises
    ------
    ValueError
        In one line where the sample cannot be drawn, or fewer than three records are short enough.
    """
    resolved = runs.settings[run]
    own = resolved["uncertainty"]
    sampling.scores(own)
    longest = own["max_duration_s"]
    short = [name for name in runs.records[run] if _duration_s(runs, run, name) <= longest]
    if len(short) < 3:
        raise ValueError(
            f"uncertainty: {len(short)} records of at most {longest:g} s; expected 3 or more "
            "(uncertainty.max_duration_s)"
        )
    return sampling.motions(short, resolved["directions"], own)


def _duration_s(runs, run, name):
    """Duration of a record, as its table states it or by reading it."""
    row, resolved = runs.tables[run][name], runs.settings[run]
    if "duration_s" in row.targets:
        return row.targets["duration_s"]
    how = {key: resolved[key] for key in ("baseline", "seed")}
    return load(name, runs.table_path(run), **how).duration_s
