"""Entry point: one wall on a shake table, several tests in one YADE process.

Runs under YADE's own Python:

    python3 yade_scripts shake_table --tests tests.json --output histories.npz

The tests file holds a list; each test is one run::

    id       text, unique
    config   sections facade, return_wall, smdof and numerics; facade.gap_m and tilt_deg say how
             the wall stood
    model    "W1" (one-sided) or "free" (two-sided)
    beta_s   β [s]
    motion   path of a motion file with columns time_s, ground_m_s2
    factor   on the motion; its sign is the direction

and may have `observed_m`, the height of d above the base; without it d is the top's.
"""

from yade_scripts.engine import adapter
from yade_scripts.files import write_atomic
from yade_scripts.model import floor_motions, models
from yade_scripts.studies import command, shaking
from yade_scripts.studies.tables import archive

TEST_KEYS = ("id", "config", "model", "beta_s", "motion", "factor")


def run_test(test):
    """Run one test.

    Returns
    -------
    simulate.History
        Displacements are relative to the table and from the upright position, so a tilted
        wall starts at h·sin φ.
    """
    time_s, columns = floor_motions.read(test["motion"])
    own = {key: test[key] for key in ("model", "beta_s", "observed_m") if key in test}
    scene, numerics = models.build_scene({**test["config"], **own}), test["config"]["numerics"]
    return shaking.set_up(scene, numerics, time_s, columns, test["factor"]).retried()


def pack(tests, histories):
    """Archive of the tests: `runs` and, of each, time_s and d_m; see `tables.archive`."""
    runs = [
        {
            "id": test["id"],
            "status": h.status,
            "reason": h.reason,
            "peak_d_over_b": None if h.status == "failed" else h.peak_d_over_b,
            "dt_s": h.dt_s,
            "steps": h.steps,
        }
        for test, h in zip(tests, histories, strict=True)
    ]
    return archive(runs, time_s=[h.time_s for h in histories], d_m=[h.d_m for h in histories])


def main(arguments=None):
    """Parse the command line, run, write the archive; return the exit status."""
    texts = {"tests": "tests (JSON)", "output": "histories to write (.npz)"}
    args = command.parser(__doc__, **texts).parse_args(arguments)
    histories, say = [], command.teller("shake table")
    tests = command.listed(args.tests, "test", TEST_KEYS)
    adapter.load_yade()
    for number, test in enumerate(tests, 1):
        history = run_test(test)
        histories.append(history)
        done = f"test {number} of {len(tests)}: {test['id']}, {history.status}"
        say(f"{done} ({history.wall_s:.1f} s)")
    write_atomic(args.output, pack(tests, histories))
    return 0
