"""Best variants of each reading with the building's own brick (tables/building_search_best.csv).

The floor load is fitted again; rows of the search and of the finer brick stand together, and
after them the plans that have a file of their own.
"""

from rocking.building.case import read_plan
from rocking.building.search import READINGS, PlanVariant, evaluate
from rocking.runtime.script import run
from rocking.tables import read_frame, write_table


def main(job):
    settings, search = dict(job.params.building), dict(job.params.search)
    plan = read_plan(job.input.plan)
    table = read_frame(job.input.search)
    names = list(PlanVariant.__dataclass_fields__)
    rows, size = [], settings["coarsening"]
    for reading in READINGS:
        mine = table[table["reading"] == reading].nsmallest(search["verified"], "largest_error_s")
        for _, row in mine.iterrows():
            rows.append({**row, "coarsening": search["coarsening"]})
            chosen = PlanVariant(**{name: float(row[name]) for name in names})
            fine = evaluate(chosen.settings(settings), chosen.plan(plan), size).get(reading)
            if fine is not None:
                rows.append({**row, **fine, "stage": "verified", "coarsening": size})
    for path in job.input.plans:
        named = read_plan(path)
        for reading, fine in evaluate(settings, named, size).items():
            rows.append({"stage": named.name, "reading": reading, **fine, "coarsening": size})
    write_table(rows, job.output[0])


run(main, globals())
