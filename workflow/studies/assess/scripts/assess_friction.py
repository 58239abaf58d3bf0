"""What the friction of floors would change: with it where it does not count, else without it.

Of the model that the rate rests on: the code's dynamic check of every mechanism that is shaken, and
collapse under all motions with its rate. No row where no floor holds the façade by friction.
"""

import json
from pathlib import Path

import pandas as pd
from rocking import Case, Motion
from rocking.records import load_as, measures
from rocking.risk.hazard import read_hazard
from rocking.runtime.script import run
from rocking.tables import read_frame, write_table
from studies.assess.collapses import by_part
from studies.assess.dynamic_answer import answer, weakest
from studies.assess.dynamic_check import checked, surely, verdict
from studies.assess.shaken import cases, limits_by_part, rubs, settled
from studies.assess.site import hazards_of

CHECK = ["model", "friction", "checked", "not_held"]


def main(job):
    p, settings = job.params, json.loads(job.params.settings)
    own, case = settings["assessment"], Case.read(job.input.case)
    rows = []
    if rubs(case["facade"]):
        other = not own["floor_friction"]
        parts = list(
            cases(settled(case, {**own, "floor_friction": other}), read_frame(job.input.shaken))
        )
        records = {name: load_as(settings, name, p.table) for name, _ in p.curves}
        rows = [{"friction": int(other), **_checked(job, parts, records, settings)}]
        rows[0] |= _collapse(job, dict((row.part, one) for row, one in parts), records, settings)
    write_table(rows, job.output[0], None if rows else CHECK)


def _checked(job, parts, records, settings):
    """Of how many mechanisms the code's dynamic check was made, and how many are not held."""
    known, own = limits_by_part(read_frame(job.input.shaken)), settings["assessment"]
    chosen = read_frame(job.input.motions)
    motions = [(Motion(records[row.record]), row.pga_g) for row in chosen.itertuples()]
    rows = []
    for row, one in parts if motions else ():
        given = one.sections, motions, settings["directions"], known[row.part]
        table = checked(*given, own["dynamic_realisations"])
        rows.append(verdict(table, known[row.part], settings["seed"]))
    held = surely(pd.DataFrame(rows)).sum() if rows else 0
    return {"checked": len(rows), "not_held": len(rows) - int(held)}


def _one_a_station(p):
    """The first curve of each station: half of them tell what friction changes."""
    first: dict[str, tuple] = {}
    for name, direction in p.curves:
        first.setdefault(p.stations[name], (name, direction))
    return list(first.values())


def _collapse(job, parts, records, settings):
    """Collapse under one component a station, as a row of dynamic.csv."""
    p, file = job.params, str(job.input.hazard)
    turns = [(Motion(records[name]), direction) for name, direction in _one_a_station(p)]
    found = by_part(parts, turns, settings["ida.max_pga_g"], [float("nan")] * len(turns))
    rows = []
    for k, (motion, direction) in enumerate(turns):
        about = {"model": p.model, "record": motion.name, "direction": direction}
        about |= {"record_pga_g": measures(motion.record)["pga_g"]}
        rows += [{"part": part, **about, **one[k]} for part, one in found.items()]
    curve = read_hazard(file, p.period_s, p.site) if file else None
    hazards = hazards_of(settings["assessment"], curve, Path(file).name)
    demand_g = read_frame(job.input.checks)["pga_demand_g"].iloc[0]
    given = p.stations, demand_g, hazards, settings["assessment"]["resamples"], settings["seed"]
    return answer(weakest(pd.DataFrame(rows)), *given)[0]


run(main, globals())
