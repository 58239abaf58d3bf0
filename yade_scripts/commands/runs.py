"""Entry point: a list of runs, of any cases under any motions, each at its own intensity.

    python3 yade_scripts runs --list runs.json --journal cache/runs.jsonl --output runs.csv
        [--scene cases/W2.json] [--motion smdof/1ST280_4dof.csv] [--second smdof/…]
        [--record 1ST280] [--direction neg]

The list has `cases`, each with::

    scene      case file, or its content
    motion     floor motions (CSV)
    second     floor motions along the façade (CSV), or none
    record, direction
    changes    sections of the case that differ, or none
    before     {motion, pga_g, pause_s}: a shock before it, in the same direction, or none
    pga_g      intensities [g]
    about      columns that a row begins with
    realisations    true: the realisations of section ensemble at every intensity

What a case leaves out, the command line says for all. `ahead` of the list has the format of the
columns of `about`.
"""

from yade_scripts.commands import command, perturb
from yade_scripts.commands.ensemble import run_realisations
from yade_scripts.commands.journal import Journal
from yade_scripts.commands.runner import Runner
from yade_scripts.commands.tables import KEY, REALISATION, RUN_COLUMNS, TWO_COMPONENTS, to_csv
from yade_scripts.engine import adapter
from yade_scripts.files import read_case, read_json, write_atomic
from yade_scripts.lists import listed
from yade_scripts.model import floor_motions, yielding
from yade_scripts.model.motion import SIGNS, amplitude

GIVEN = ("scene", "motion", "second", "record", "direction")


def motion_of(case, scene):
    """Time and accelerations that shake a case, and the shock before them; None: there is none.

    `scene` is the content of its case file.
    """
    time_s, columns = floor_motions.read(case["motion"])
    if case.get("second"):
        second = floor_motions.read(case["second"])
        time_s, columns = floor_motions.with_second(time_s, columns, *second)
    if not (before := case.get("before")):
        return time_s, columns, None
    first_s, first = floor_motions.read(before["motion"])
    first = yielding.of_case(scene, first_s, first)
    factor = amplitude(first["ground"], case["direction"], before["pga_g"])
    return time_s, columns, (first_s, floor_motions.scaled(first, factor), before["pause_s"])


def run_case(case, journal, say):
    """Rows of one case."""
    scene = read_case(case["scene"]) if isinstance(case["scene"], str) else case["scene"]
    changed = {**scene, **case.get("changes", {})}
    time_s, columns, before = motion_of(case, changed)
    record, direction = case["record"], case["direction"]
    runner = Runner(changed, time_s, columns, record, direction, journal, say, before)
    rows: list[dict] = []
    about = case.get("about", {})
    for pga_g in case["pga_g"]:
        if case.get("realisations"):
            runs = run_realisations(runner, pga_g, perturb.draw_realisations(changed["ensemble"]))
        else:
            runs = [runner.run(pga_g)]
            say(f"{pga_g:.4g} g {runs[0]['status']}")
        rows += [{**about, **row} for row in runs]
    return rows


def main(arguments=None):
    """Parse the command line, run the list, write the table; return the exit status."""
    parser = command.parser(__doc__, "journal", list="runs (JSON)", output="table to write (CSV)")
    for word in GIVEN:
        choices = tuple(SIGNS) if word == "direction" else None
        parser.add_argument(f"--{word}", choices=choices, help="of all cases that state none")
    args = parser.parse_args(arguments)
    asked = read_json(args.list, "cases")
    given = {word: value for word in GIVEN if (value := getattr(args, word))}
    cases = [given | case for case in asked["cases"]]
    for case in cases:
        if missing := [word for word in (*GIVEN, "pga_g") if word not in (*case, "second")]:
            raise ValueError(f"{args.list}: a case has no {listed(missing)}")
    adapter.load_yade()
    journal, rows = Journal(args.journal), []
    for case in cases:
        rows += run_case(case, journal, command.progress(f"{case['record']} {case['direction']}"))
    realisations = REALISATION if any(case.get("realisations") for case in cases) else {}
    both = TWO_COMPONENTS if all(case.get("second") for case in cases) else {}
    ahead = asked.get("ahead", {})
    columns = {**ahead, **KEY, **ahead, **realisations, **RUN_COLUMNS}
    columns |= both
    write_atomic(args.output, to_csv(rows, columns))
    return 0
