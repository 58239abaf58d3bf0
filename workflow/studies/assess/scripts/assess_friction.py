"""What the friction of floors would change: with it where it does not count, else without it.

Of the model that the rate rests on: the code's dynamic check of every mechanism that is shaken, and
collapse under all motions with its rate. No row where no floor holds the façade by friction.
Friction only adds to what holds a mechanism: with it none is followed below where it stands without
it, and one that passes the check without it passes with it. The check of one that no floor rubs is
not made again. Those that fall first as the report has it come first, since a motion that one of
them fells is followed no further.
"""

import json
from pathlib import Path

import numpy as np
import pandas as pd
from rocking import Case, Motion
from rocking.records import load_as, measures
from rocking.runtime.script import run
from rocking.tables import read_frame, read_tables, together, write_table
from studies.assess.collapses import by_part
from studies.assess.dynamic_answer import answer, weakest
from studies.assess.dynamic_check import decided, surely
from studies.assess.shaken import cases, limits_by_part, rubs, settled
from studies.assess.site import hazards_of
from studies.assess.sites import WHOLE_PART
from studies.shared.hazard import read_hazard

CHECK = ["model", "friction", "checked", "not_held"]
STANDS = 0.9  # of where a mechanism falls without the friction, from where it is followed with it


def main(job):
    p, settings = job.params, json.loads(job.params.settings)
    assessment, case = settings["assessment"], Case.read(job.input.case)
    rows = []
    if rubs(case["facade"]):
        other, table = not assessment["floor_friction"], read_frame(job.input.shaken)
        stated = {row.part: part_case for row, part_case in cases(settled(case, assessment), table)}
        changed = settled(case, {**assessment, "floor_friction": other})
        parts = {row.part: part_case for row, part_case in cases(changed, table)}
        falls = _stated(job)["pga_median_g"].fillna(np.inf).groupby("part").median()
        parts = {part: parts[part] for part in falls.sort_values(kind="stable").index}
        alike = {
            part for part, part_case in parts.items() if part_case.sections == stated[part].sections
        }
        records = {name: load_as(settings, name, p.table) for name, _ in p.curves}
        rows = [{"friction": int(other), **_checked(job, parts, alike, records, settings)}]
        rows[0] |= _collapse(job, parts, alike, records, settings)
    write_table(rows, job.output[0], None if rows else CHECK)


def _checked(job, parts, alike, records, settings):
    """Of how many mechanisms the code's dynamic check was made, and how many are not held."""
    known, assessment = limits_by_part(read_frame(job.input.shaken)), settings["assessment"]
    motions = [
        (Motion(records[row.record]), row.pga_g)
        for row in read_frame(job.input.motions).itertuples()
    ]
    turns = [(motion, way) for motion in motions for way in settings["directions"]]
    count, seed, held = assessment["dynamic_realisations"], settings["seed"], []
    before = read_tables(job.input.verdicts)
    for part, case in parts.items() if motions else ():
        stated = bool(surely(before[before["part"] == part]).all())
        if part in alike or stated != assessment["floor_friction"]:
            held.append(stated)
        else:
            about, _ = decided(case.sections, turns, known[part], count, seed)
            held.append(about["holds"])
    return {"checked": len(held), "not_held": len(held) - sum(held)}


def _one_a_station(p):
    """The first curve of each station: half of them tell what friction changes."""
    first: dict[str, tuple] = {}
    for name, direction in p.curves:
        first.setdefault(p.stations[name], (name, direction))
    return list(first.values())


def _collapse(job, parts, alike, records, settings):
    """Collapse under one component a station, as a row of dynamic.csv.

    Where a mechanism that no floor rubs falls, as the report has it, no other is followed beyond.
    """
    p, file = job.params, str(job.input.hazard)
    curves, most_g = _one_a_station(p), settings["ida.max_pga_g"]
    turns = [(Motion(records[name]), direction) for name, direction in curves]
    stated = _stated(job)
    known, below = np.full(len(curves), np.nan), None
    for part in alike:
        medians_g = [stated.at[(part, *curve), "pga_median_g"] for curve in curves]
        known = np.fmin(known, np.array(medians_g, float))
    if not settings["assessment"]["floor_friction"]:
        stood = stated["pga_median_g"].fillna(stated["pga_max_g"])
        below = {part: [STANDS * stood[(part, *curve)] for curve in curves] for part in parts}
    collapses = by_part(parts, turns, most_g, known, below)
    rows = []
    for k, (motion, direction) in enumerate(turns):
        about = {"model": p.model, "record": motion.name, "direction": direction}
        about |= {"record_pga_g": measures(motion.record)["pga_g"]}
        rows += [{"part": part, **about, **crossings[k]} for part, crossings in collapses.items()]
    curve = read_hazard(file, p.period_s, p.site) if file else None
    hazards = hazards_of(settings["assessment"], curve, Path(file).name)
    demand_g = read_frame(job.input.checks)["pga_demand_g"].iloc[0]
    given = p.stations, demand_g, hazards, settings["assessment"]["resamples"], settings["seed"]
    return answer(weakest(pd.DataFrame(rows)), *given)[0]


def _stated(job):
    """Where every mechanism collapses as the report has it, by part and motion."""
    whole = read_frame(job.input.whole).assign(part=WHOLE_PART)
    table = together([whole, read_frame(job.input.parts)])
    return table.set_index(["part", "record", "direction"])


run(main, globals())
