"""What runs of a study have in common: motions and their figures, kept once for equal settings.

`results/.shared/<motions>/` has what a records table, a baseline treatment and a seed make,
`<chain>/` below it what a chain of masses makes of that; both names are hashes of those settings.
So a path does not depend on which other runs the study has. A run has each file in a second place
under its own name (`records/…`, `smdof/…`, `figures/…`), a hard link where the file system can.
"""

import hashlib
import json
from pathlib import PurePosixPath
from types import SimpleNamespace

FOLDER = "results/.shared"
TREATMENT = ("baseline", "seed", "vertical_motion")  # what is done to a row of the records table
OF_MOTION = ("records/{}.csv", "records/{}.json", "figures/record_{}.png", "figures/record_{}.pdf")
OF_CHAIN = ("figures/floor_motions_{}.png", "figures/floor_motions_{}.pdf")


def _key(*settings):
    text = json.dumps(settings, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:12]


class Shared:
    """Files in `results/.shared`.

    Parameters
    ----------
    runs : dict of str to dict
        Resolved configuration of each run.
    """

    def __init__(self, runs):
        """Name the settings of each run."""
        self.runs = runs
        self.keys = {
            run: {
                "motions": _key(s["records_table"], self.treatment(run)),
                "chain": _key(s["smdof"]),
            }
            for run, s in runs.items()
        }

    def treatment(self, run):
        """Configuration that a motion depends on, beside its row of the records table."""
        return {key: self.runs[run][key] for key in TREATMENT}

    def alike(self, wildcards) -> list[str]:
        """Runs with the settings behind a file, by its wildcards `motions` and `chain`."""
        wanted = {k: v for k, v in dict(wildcards).items() if k in ("motions", "chain")}
        return [run for run, keys in self.keys.items() if wanted.items() <= keys.items()]

    def of(self, function):
        """Input or params function of one of the runs alike, from one that takes its wildcards."""
        return lambda w: function(SimpleNamespace(run=self.alike(w)[0], record=w.record))

    def label(self, wildcards) -> str:
        """Runs alike, in the report."""
        first, *others = self.alike(wildcards)
        return f"{first} and {len(others)} more" if others else first

    def path(self, run, name) -> str:
        """Return where a file of a run is kept; `name` is its own, below the run's folder."""
        keys, place = self.keys[run], PurePosixPath(FOLDER) / self.keys[run]["motions"]
        of_chain = name.startswith(("smdof/", "figures/floor_motions_"))
        return str(place / keys["chain"] / name if of_chain else place / name)

    def floor_motions(self, run, record) -> str:
        """Floor motions of a record."""
        return self.path(run, f"smdof/{record}_{self.runs[run]['smdof']['n_dof']}dof.csv")

    def all_of(self, run, records) -> list[str]:
        """Every file that a run shares."""
        names = [name.format(record) for record in records for name in (*OF_MOTION, *OF_CHAIN)]
        motions = [self.floor_motions(run, record) for record in records]
        return [*(self.path(run, name) for name in names), *motions]
