"""PGA of 10 and 50 % collapse of one model under the motions of the run, by the planar solver.

Of the whole façade; with a table of mechanisms, of the parts that are shaken instead. With the
whole façade's table beside it a part is followed no further than tells (`collapses.by_part`).
Of a building that yields also the PGA at which a storey of it comes to its drift.
"""

import json

from rocking import Case, Motion
from rocking.collapse.building import falls_at
from rocking.records import load_as, measures
from rocking.runtime.script import run
from rocking.tables import read_frame, write_table
from studies.assess.collapses import by_part
from studies.assess.shaken import cases_of, settled, settled_by

from yade_scripts.model.chain import yields

COLUMNS = ["model", "record", "direction", "record_pga_g", "pga_p10_g", "pga_median_g"]
COLUMNS += ["pga_max_g", "runs_planar"]
BUILDING = ["pga_building_g", "building_max_g"]  # where the building falls, and up to where tried


def main(job):
    settings, shaken = json.loads(job.params.settings), getattr(job.input, "shaken", None)
    case = settled(Case.read(job.input.case), settled_by(settings))
    motions = {
        name: Motion(load_as(settings, name, job.params.table)) for name, _ in job.params.curves
    }
    turns = [(motions[name], direction) for name, direction in job.params.curves]
    whole = getattr(job.input, "whole", None)
    known = read_frame(str(whole))["pga_median_g"] if whole else None
    collapses = by_part(cases_of(case, shaken), turns, settings["ida.max_pga_g"], known)
    rows, most_g = [], settings["ida.max_pga_g"]
    weak = not shaken and case.kind.chain and yields(case["smdof"])
    for k, (motion, direction) in enumerate(turns):
        about = {"model": case.model, "record": motion.name, "direction": direction}
        about |= {"record_pga_g": measures(motion.record)["pga_g"]}
        if weak:
            about |= {"pga_building_g": falls_at(case, motion, direction, most_g)}
            about |= {"building_max_g": most_g}
        rows += [{"part": part, **about, **crossings[k]} for part, crossings in collapses.items()]
    write_table(rows, job.output[0], ["part", *COLUMNS] if shaken else [*COLUMNS, *BUILDING])


run(main, globals())
