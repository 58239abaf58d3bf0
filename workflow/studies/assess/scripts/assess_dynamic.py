"""The dynamic answer for one façade: fragility of each model with its bands, rate of collapse.

A motion fells the façade where it fells one of its mechanisms, so of those that were shaken the
least PGA counts; each mechanism's own answer stands in a table beside.
"""

import json
from pathlib import Path

import pandas as pd
from rocking.runtime.script import run
from rocking.tables import read_frame, read_tables, together, write_table
from studies.assess import building_first
from studies.assess.dynamic_answer import CURVES, LEFT_OUT, RATES, answer, left_out, weakest
from studies.assess.site import hazards_of
from studies.assess.sites import WHOLE_PART
from studies.shared.hazard import read_hazard
from studies.shared.rates import probability_within


def main(job):
    p, file = job.params, str(job.input.hazard)
    curve = read_hazard(file, p.period_s, p.site) if file else None
    hazards = hazards_of(json.loads(p.settings)["assessment"], curve, Path(file).name)
    demand_g = read_frame(job.input.checks)["pga_demand_g"].iloc[0]
    given = (p.stations, demand_g, hazards, p.resamples, p.seed)
    whole = read_tables(job.input.collapse).assign(part=WHOLE_PART)
    every = together([whole, read_tables(job.input.parts)])
    by_model = every.groupby("model", sort=False)
    answers = [answer(weakest(rows), *given) for _, rows in by_model]
    counts = by_model["part"].nunique()
    rows = [{**row, "mechanisms": counts[row["model"]]} for row, *_ in answers]
    write_table(rows, job.output.table)
    curves = [curve for _, curve, _ in answers if curve is not None]
    write_table(pd.concat(curves) if curves else [], job.output.curves, CURVES)
    rates = [{**row, "years": p.years} for *_, rows in answers for row in rows]
    for row in rates:
        row["probability"] = probability_within(row["annual_rate"], p.years)
    write_table(rates, job.output.rates, [*RATES, "years", "probability"])
    by_part = every.groupby(["part", "model"], sort=False)
    parts = [{"part": part, **answer(rows, *given)[0]} for (part, _), rows in by_part]
    write_table(parts, job.output.parts)
    table = read_frame(job.input.shaken)
    write_table(left_out(pd.DataFrame(parts), table, hazards), job.output.left_out, LEFT_OUT)
    least = pd.concat([weakest(rows) for _, rows in every.groupby("model", sort=False)])
    first = building_first.answers(whole, least, p.stations, demand_g, p.resamples, p.seed)
    write_table(first, job.output.first, building_first.COLUMNS)


run(main, globals())
