"""What runs have in common: motions and their figures, kept once for equal settings.

`results/.shared/<motions>/` has what a records table, a baseline treatment and a seed make,
`<chain>/` below it what a chain of masses makes of that; both names are hashes of those settings.
So a path does not depend on which other runs there are. A run has each file in a second place
under its own name (`records/…`, `smdof/…`, `figures/…`), a hard link where the file system can.
"""

import hashlib
import json

from rocking.records import TREATMENT


def _key(*settings):
    text = json.dumps(settings, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:12]


class Shared:
    """Keys of the folders in `results/.shared`, by the resolved configuration of each run."""

    def __init__(self, settings):
        """Name the settings of each run."""
        self.settings = settings
        self._alike: dict[tuple, dict] = {}
        self.keys = {
            run: {
                "motions": _key(s["records_table"], self.treatment(run)),
                "chain": _key(s["smdof"]),
            }
            for run, s in settings.items()
        }

    def treatment(self, run):
        """Configuration that a motion depends on, beside its row of the records table."""
        return {key: self.settings[run][key] for key in TREATMENT}

    def alike(self, wildcards) -> list[str]:
        """Runs with the settings behind a file, by its wildcards `motions` and `chain`."""
        asked = dict(wildcards)
        names = tuple(name for name in ("motions", "chain") if name in asked)
        if names not in self._alike:
            self._alike[names] = {}
            for run, keys in self.keys.items():
                known = tuple(keys[name] for name in names)
                self._alike[names].setdefault(known, []).append(run)
        return list(self._alike[names].get(tuple(asked[name] for name in names), []))

    def label(self, wildcards) -> str:
        """Runs alike, in the report."""
        first, *others = self.alike(wildcards)
        return f"{first} and {len(others)} more" if others else first
