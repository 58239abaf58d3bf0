"""Error of one-way coupling before many buildings: ratios to two-way coupling, all records."""

from rocking.runtime.script import run
from rocking.studies.assumptions import spread_of
from rocking.tables import read_tables, write_table

KEY = ["record", "direction", "period_s", "damping_ratio"]
MEASURES = ("collapse", "median", "all")


def main(job):
    table = read_tables(job.input.curves)
    driven = table[table["mass_ratio"] == 0.0].set_index(KEY)
    pushed = table[table["mass_ratio"] > 0.0].set_index(KEY)
    for name in MEASURES:
        column = f"pga_{name}_g"
        pushed[f"ratio_{name}"] = driven[column].reindex(pushed.index) / pushed[column]
    by = ["damping_ratio", "period_s", "mass_ratio"]
    columns = [f"ratio_{name}" for name in MEASURES]
    found = spread_of(pushed.reset_index().sort_values(by), columns, by)
    write_table(found, job.output[0], digits="%.4f")


run(main, globals())
