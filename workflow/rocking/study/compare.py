"""Runs side by side: those of the configuration, and finished ones that it names."""

import csv
import itertools
from pathlib import Path

import yaml

TABLE = "tables/ida_collapse.csv"


def flat(settings, prefix=""):
    """Configuration by dotted key."""
    out: dict = {}
    for key, value in settings.items():
        if isinstance(value, dict):
            out |= flat(value, f"{prefix}{key}.")
        else:
            out[f"{prefix}{key}"] = value
    return out


def differences(configurations):
    """What differs between configurations.

    Parameters
    ----------
    configurations : dict of str to dict
        Resolved configuration of each run.

    Returns
    -------
    dict of str to dict
        By run, the dotted keys that are not the same in all, with their value there (None where an
        older run lacks the key).
    """
    own = {run: flat(settings) for run, settings in configurations.items()}
    keys = list(dict.fromkeys(itertools.chain.from_iterable(own.values())))
    keys = [
        key
        for key in keys
        if key not in ("run", "compare")
        and any(values.get(key) != next(iter(own.values())).get(key) for values in own.values())
    ]
    return {run: {key: values.get(key) for key in keys} for run, values in own.items()}


class Compare:
    """Files of the target `compare`, in `results/<run>/compare/`."""

    def __init__(self, study, results="results"):
        """Keep the study."""
        self.study, self.results = study, results

    @property
    def runs(self) -> list[str]:
        """Runs side by side: those of a study of several, and the finished ones that are named."""
        named = next(iter(self.study.runs.values()))["compare"]
        several = list(self.study.runs) if len(self.study.runs) > 1 or not named else []
        return list(dict.fromkeys([*several, *named]))

    def tables(self, wildcards=None) -> list[str]:
        """Collapse tables of the runs; a finished run without one ends the workflow in one line."""
        for run in self.runs:
            path = Path(self.results, run, TABLE)
            if run not in self.study.runs and not (path.is_file() and self._file(run).is_file()):
                there = sorted(p.parent.parent.name for p in Path(self.results).glob(f"*/{TABLE}"))
                raise SystemExit(
                    f"error: compare: no finished run '{run}' ({path}); "
                    f"there are {', '.join(there) or 'none'}"
                )
        if len(self.runs) < 2:
            raise SystemExit(
                "error: compare: one run only; give a grid, scenarios, or finished runs, as in "
                "--config compare=main,tall -- compare"
            )
        return [f"{self.results}/{run}/{TABLE}" for run in self.runs]

    def facts(self, wildcards=None) -> list[str]:
        """Provenance files of the runs' records; of a finished run those that it still has."""
        found = []
        for run in self.runs:
            if run in self.study.runs:
                found += self.study.facts_of(run)
                continue
            with open(f"{self.results}/{run}/{TABLE}", encoding="utf-8", newline="") as handle:
                names = dict.fromkeys(row["record"] for row in csv.DictReader(handle))
            paths = (Path(self.results, run, "records", f"{name}.json") for name in names)
            found += [str(path) for path in paths if path.is_file()]
        return list(dict.fromkeys(found))

    def _file(self, run):
        return Path(self.results, run, "config.yaml")

    def differing(self, wildcards=None):
        """See `differences`."""
        return differences(
            {
                run: self.study.runs[run]
                if run in self.study.runs
                else yaml.safe_load(self._file(run).read_text("utf-8"))
                for run in self.runs
            }
        )
